"""The built-in models, terms, noises, simulators and readers: names only, so that listing them imports no NumPy."""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_plugins"


@hookimpl
def lostmotion_models() -> dict[str, str]:
    """Return the built-in models."""
    return {
        "backlash_slider": f"{_HERE}.models.slider:BacklashSlider",
        "clearance_chain": f"{_HERE}.models.clearance_chain:ClearanceChain",
        "current_motor": f"{_HERE}.models.dc_motor:CurrentMotor",
        "dc_motor": f"{_HERE}.models.dc_motor:DcMotor",
        "duffing": f"{_HERE}.models.duffing:Duffing",
        "gear_mesh": f"{_HERE}.models.gear_mesh:GearMesh",
        "gear_pair": f"{_HERE}.models.gear_pair:GearPair",
        "impact_oscillator": f"{_HERE}.models.impact_oscillator:ImpactOscillator",
        "lin_backlash": f"{_HERE}.models.lin:LinBacklash",
        "linear_oscillator": f"{_HERE}.models.basic:LinearOscillator",
        "rigid_drive": f"{_HERE}.models.basic:RigidDrive",
        "robot_joint": f"{_HERE}.models.joint:RobotJoint",
    }


@hookimpl
def lostmotion_terms() -> dict[str, str]:
    """Return the built-in terms, under the names that a diagnosis uses for the mechanisms."""
    return {
        "actuator_lag": f"{_HERE}.terms.lag:ActuatorLag",
        "asymmetric_gap": f"{_HERE}.terms.contact:AsymmetricGap",
        "backlash": f"{_HERE}.terms.play:Backlash",
        "bilinear_stiffness": f"{_HERE}.terms.elastic:BilinearStiffness",
        "bouc_wen_hysteresis": f"{_HERE}.terms.memory:BoucWenHysteresis",
        "cogging": f"{_HERE}.terms.periodic:Cogging",
        "contact_damping": f"{_HERE}.terms.contact:ContactDamping",
        "coulomb_friction": f"{_HERE}.terms.friction:CoulombFriction",
        "cubic_stiffness": f"{_HERE}.terms.elastic:CubicStiffness",
        "dahl_friction": f"{_HERE}.terms.memory:DahlFriction",
        "damping_drift": f"{_HERE}.terms.viscous:DampingDrift",
        "directional_damping": f"{_HERE}.terms.viscous:DirectionalDamping",
        "directional_friction": f"{_HERE}.terms.friction_kinds:DirectionalFriction",
        "drive_dead_zone": f"{_HERE}.terms.drive:DriveDeadZone",
        "drive_saturation": f"{_HERE}.terms.drive:DriveSaturation",
        "end_stop": f"{_HERE}.terms.play:EndStop",
        "excitation_delay": f"{_HERE}.terms.drive:ExcitationDelay",
        "excitation_gain": f"{_HERE}.terms.drive:ExcitationGain",
        "excitation_harmonic": f"{_HERE}.terms.drive:ExcitationHarmonic",
        "friction_drift": f"{_HERE}.terms.friction_kinds:FrictionDrift",
        "friction_drift_travel": f"{_HERE}.terms.friction_kinds:FrictionDriftTravel",
        "friction_drift_twice": f"{_HERE}.terms.friction_kinds:FrictionDriftTwice",
        "gap_drift": f"{_HERE}.terms.changing:GapDrift",
        "gravity_pendulum": f"{_HERE}.terms.elastic:GravityPendulum",
        "hertz_contact": f"{_HERE}.terms.contact:HertzContact",
        "hidden_mode": f"{_HERE}.terms.bodies:HiddenMode",
        "hunt_crossley_contact": f"{_HERE}.terms.contact:HuntCrossleyContact",
        "inertia_change": f"{_HERE}.terms.bodies:InertiaChange",
        "linear_stiffness": f"{_HERE}.terms.elastic:LinearStiffness",
        "load_dependent_friction": f"{_HERE}.terms.friction_kinds:LoadDependentFriction",
        "lugre_friction": f"{_HERE}.terms.memory:LuGreFriction",
        "offset_force": f"{_HERE}.terms.elastic:OffsetForce",
        "parametric_stiffness": f"{_HERE}.terms.changing:ParametricStiffness",
        "position_ripple": f"{_HERE}.terms.sensor:PositionRipple",
        "position_dependent_friction": f"{_HERE}.terms.periodic:PositionDependentFriction",
        "quadratic_damping": f"{_HERE}.terms.viscous:QuadraticDamping",
        "quadratic_stiffness": f"{_HERE}.terms.elastic:QuadraticStiffness",
        "sensor_delay": f"{_HERE}.terms.sensor:SensorDelay",
        "sensor_gain": f"{_HERE}.terms.sensor:SensorGain",
        "sensor_lag": f"{_HERE}.terms.lag:SensorLag",
        "sensor_offset": f"{_HERE}.terms.sensor:SensorOffset",
        "sensor_quantisation": f"{_HERE}.terms.sensor:SensorQuantisation",
        "stribeck_friction": f"{_HERE}.terms.friction:StribeckFriction",
        "viscous_damping": f"{_HERE}.terms.viscous:ViscousDamping",
    }


@hookimpl
def lostmotion_noises() -> dict[str, str]:
    """Return the built-in noises; the first three are parts of the framework itself."""
    at = f"{_HERE}.noises"
    return {
        "ar1": "lostmotion.noises:AR1",
        "quantised": "lostmotion.noises:Quantised",
        "white": "lostmotion.noises:White",
        "drift": f"{at}.drift:DriftingZero",
        "flicker": f"{at}.flicker:Flicker",
        "hum": f"{at}.hum:Hum",
        "hum60": f"{at}.hum:Hum60",
        "jitter": f"{at}.jitter:Jitter",
    }


@hookimpl
def lostmotion_simulators() -> dict[str, str]:
    """Return the built-in simulators, under the keys that name their files in a case."""
    at = f"{_HERE}.simulators.mujoco"
    return {"mujoco": f"{at}:MujocoSimulator", "urdf": f"{at}:UrdfSimulator"}


@hookimpl
def lostmotion_readers() -> dict[str, tuple[str, str]]:
    """Return the readers of formats whose libraries are extras; they are parts of the framework itself."""
    at = "lostmotion.recording.readers"
    sheet = (f"{at}.spreadsheets:read_sheet", "lostmotion[xlsx]")
    bag = (f"{at}.bags:read_bag", "lostmotion[rosbag]")
    mdf = (f"{at}.mdf:read_mdf", "lostmotion[mf4]")
    uff = (f"{at}.uff:read_uff", "lostmotion[uff]")
    return {
        **dict.fromkeys(("xlsx", "xlsm", "xlsb", "xls", "ods"), sheet),
        **dict.fromkeys(("mf4", "mdf"), mdf),
        **dict.fromkeys(("bag", "db3"), bag),
        **dict.fromkeys(("uff", "unv"), uff),
        "mcap": (f"{at}.bags:read_mcap", "lostmotion[mcap]"),
        "parquet": (f"{at}.parquet:read_parquet", "lostmotion[parquet]"),
        "tdms": (f"{at}.tdms:read_tdms", "lostmotion[tdms]"),
    }
