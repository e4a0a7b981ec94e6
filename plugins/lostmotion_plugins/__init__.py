"""The built-in plugins: names only, so that listing them imports neither NumPy nor numba."""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_plugins"


@hookimpl
def lostmotion_models() -> dict[str, str]:
    """Return the built-in models."""
    return {
        "lin_backlash": f"{_HERE}.models.lin:LinBacklash",
        "linear_oscillator": f"{_HERE}.models.basic:LinearOscillator",
        "rigid_drive": f"{_HERE}.models.basic:RigidDrive",
        "robot_joint": f"{_HERE}.models.joint:RobotJoint",
    }


@hookimpl
def lostmotion_terms() -> dict[str, str]:
    """Return the built-in terms, under the names of the mechanisms that a diagnosis says."""
    return {
        "asymmetric_gap": f"{_HERE}.terms.contact:AsymmetricGap",
        "contact_damping": f"{_HERE}.terms.contact:ContactDamping",
        "coulomb_friction": f"{_HERE}.terms.friction:CoulombFriction",
        "cubic_stiffness": f"{_HERE}.terms.elastic:CubicStiffness",
        "gravity_pendulum": f"{_HERE}.terms.elastic:GravityPendulum",
        "linear_stiffness": f"{_HERE}.terms.elastic:LinearStiffness",
        "lugre_friction": f"{_HERE}.terms.friction:LuGreFriction",
        "offset_force": f"{_HERE}.terms.elastic:OffsetForce",
        "quadratic_damping": f"{_HERE}.terms.viscous:QuadraticDamping",
        "stribeck_friction": f"{_HERE}.terms.friction:StribeckFriction",
        "viscous_damping": f"{_HERE}.terms.viscous:ViscousDamping",
    }
