"""The plugins of this package, by name only, so that a list of all plugins imports none of them."""

from lostmotion.hookspecs import hookimpl

_HERE = "lostmotion_template"


@hookimpl
def lostmotion_models() -> dict[str, str]:
    """Return the models of this package."""
    return {"driven_pendulum": f"{_HERE}.models:DrivenPendulum"}


@hookimpl
def lostmotion_dynamics() -> dict[str, str]:
    """Return the machines of this package that are stepped, which a case names: `dynamics = "two_joint_arm"`."""
    return {"two_joint_arm": f"{_HERE}.dynamics:TwoJointArm"}


@hookimpl
def lostmotion_terms() -> dict[str, str]:
    """Return the terms of this package."""
    return {"maxwell_element": f"{_HERE}.terms:MaxwellElement"}


@hookimpl
def lostmotion_simulators() -> dict[str, str]:
    """Return the simulators of this package, under the keys that name their files in a case."""
    return {"two_link": f"{_HERE}.simulators:TwoLink"}


@hookimpl
def lostmotion_commands() -> dict[str, tuple[str, str]]:
    """Return the commands of this package, each with its line in `lostmotion --help`."""
    return {"crest": (f"{_HERE}.commands:crest", "Tell how far the peaks of a recording reach beyond its rms.")}


@hookimpl
def lostmotion_noises() -> dict[str, str]:
    """Return the noises of this package, which a case names: `noise = "flicker_noise"`."""
    return {"flicker_noise": f"{_HERE}.noises:FlickerNoise"}


@hookimpl
def lostmotion_screens() -> dict[str, tuple[str, str]]:
    """Return the screens that this package adds to the page of `lostmotion app`."""
    return {"readings": (f"{_HERE}.screens:draw_readings", "How often each sensor reads which value.")}


@hookimpl
def lostmotion_sections() -> dict[str, tuple[str, str]]:
    """Return the sections that this package adds to the page of a diagnosis."""
    return {"power": (f"{_HERE}.sections:make_power_section", "The power of the missing force over the recording.")}
