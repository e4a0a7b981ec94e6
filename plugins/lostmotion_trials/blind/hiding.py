"""Converts hidden effects to the parameters of the integrator that simulates the machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from lostmotion_trials.blind.mechanisms import Effect
from lostmotion_trials.blind.simulator import BlindMachine, Disturbances
from lostmotion_trials.integrators.hidden import BOUC_WEN, DAHL, LUGRE, Hidden

Numbers = Mapping[str, float]


def _make_memory_friction(kind: float, p: Numbers, place: float) -> dict[str, float]:
    """Return the parameters of friction with a memory state."""
    return {
        "memory": kind,
        "memory_force": p["force"],
        "memory_excess": p.get("excess", 0.0),
        "memory_velocity": p.get("velocity", 1.0),
        "memory_travel": p["deflection"] if "deflection" in p else p["travel"],
        "memory_place": place,
    }


_INSIDE: Mapping[str, Callable[[Numbers, float, float], dict[str, float]]] = {
    "coulomb_friction": lambda p, place, _w: {"friction": p["force"], "friction_place": place},
    "stribeck_friction": lambda p, place, _w: {
        "friction": p["force"], "excess": p["excess"], "velocity": p["velocity"], "friction_place": place,
    },
    "dahl_friction": lambda p, place, _w: _make_memory_friction(DAHL, p, place),
    "lugre_friction": lambda p, place, _w: _make_memory_friction(LUGRE, p, place),
    "bouc_wen_hysteresis": lambda p, place, _w: _make_memory_friction(BOUC_WEN, p, place),
    "viscous_damping": lambda p, place, _w: {"drag": p["coefficient"], "drag_place": place},
    "quadratic_damping": lambda p, place, _w: {"square": p["coefficient"], "square_place": place},
    "contact_damping": lambda p, _place, _w: {"contact_drag": p["coefficient"]},
    "linear_stiffness": lambda p, place, _w: {"spring": p["coefficient"], "spring_place": place},
    "cubic_stiffness": lambda p, place, _w: {"cube": p["coefficient"], "cube_place": place},
    "asymmetric_gap": lambda p, _place, _w: {"shift": p["shift"]},
    "backlash": lambda p, _place, _w: {"play": p["gap"]},
    "end_stop": lambda p, _place, _w: {"stop": p["stiffness"], "stop_travel": p["travel"], "stop_side": p["side"]},
    "hunt_crossley_contact": lambda p, _place, _w: {"crush": p["coefficient"]},
    "hertz_contact": lambda p, _place, _w: {"hertz": p["coefficient"]},
    "bilinear_stiffness": lambda p, _place, _w: {"fold": 0.5 * p["difference"]},
    "quadratic_stiffness": lambda p, _place, _w: {"bow": p["coefficient"]},
    "hidden_mode": lambda p, _place, _w: {
        "mode_mass": p["mass"],
        "mode_stiffness": p["mass"] * (2.0 * math.pi * p["frequency"]) ** 2,
        "mode_drag": 4.0 * math.pi * p["mass"] * p["damping"] * p["frequency"],
    },
    "directional_friction": lambda p, place, _w: {
        "friction": p["forward"], "friction_back": p["backward"], "friction_place": place,
    },
    "position_dependent_friction": lambda p, place, _w: {
        "friction": p["force"], "wave": p["wave"], "wave_length": p["pitch"], "wave_phase": p["phase"],
        "friction_place": place,
    },
    "load_dependent_friction": lambda p, place, _w: {"load": p["coefficient"], "friction_place": place},
    "friction_drift": lambda p, place, _w: {
        "friction": p["force"], "warm": p["change"], "warm_time": p["time"], "friction_place": place,
    },
    "directional_damping": lambda p, _place, _w: {"slant": 0.5 * p["difference"]},
    "damping_drift": lambda p, _place, _w: {"aging": p["rate"]},
    "cogging": lambda p, _place, _w: {
        "ripple": p["force"], "ripple_length": p["pitch"], "ripple_phase": p["phase"],
    },
    "inertia_change": lambda p, _place, _w: {"added": p["change"], "added_from": p["time"]},
    "gap_drift": lambda p, _place, _w: {"drift": p["rate"]},
    "offset_force": lambda p, _place, _w: {"push": p["force"]},
    "parametric_stiffness": lambda p, _place, w: {"depth": p["depth"], "pace": p["ratio"] * w, "phase": p["phase"]},
    "wave over position that narrows": lambda p, _place, _w: {
        "ripple": p["force"], "ripple_length": p["length"], "ripple_chirp": p["chirp"],
    },
    "friction that depends on position": lambda p, place, _w: {
        "rough": p["force"], "rough_length": p["length"], "friction_place": place,
    },
    "bump at one position": lambda p, _place, _w: {
        "bump": p["force"], "bump_middle": p["middle"], "bump_width": p["width"],
    },
    "drag that grows with position": lambda p, _place, _w: {"mixed": p["coefficient"]},
}  # fmt: skip
_OUTSIDE: Mapping[str, Callable[[Disturbances, Numbers, float], Disturbances]] = {
    "excitation_harmonic": lambda m, p, w: replace(m, harmonic=(p["amplitude"], p["ratio"] * w, p["phase"])),
    "excitation_delay": lambda m, p, _w: replace(m, excitation_delay=p["delay"]),
    "excitation_gain": lambda m, p, _w: replace(m, excitation_gain=p["error"]),
    "actuator_lag": lambda m, p, _w: replace(m, actuator_time=p["time"]),
    "sensor_lag": lambda m, p, _w: replace(m, sensor_time=p["time"]),
    "position_ripple": lambda m, p, _w: replace(m, ripple=(p["size"], p["pitch"], p["phase"])),
    "drive_saturation": lambda m, p, _w: replace(m, limit=p["limit"]),
    "drive_dead_zone": lambda m, p, _w: replace(m, dead=p["width"]),
    "sensor_delay": lambda m, p, _w: replace(m, sensor_delay=p["delay"]),
    "sensor_gain": lambda m, p, _w: replace(m, sensor_gain=p["error"]),
    "sensor_quantisation": lambda m, p, _w: replace(m, step=p["step"]),
    "random_force": lambda m, p, _w: replace(m, rms=p["rms"]),
}


def convert_effects(rig: BlindMachine, effects: Sequence[Effect]) -> tuple[Hidden, Disturbances]:
    """Return the effects as parameters of the integrator: forces on the body, and errors of drive and sensor."""
    inside: dict[str, float] = {}
    outside = Disturbances()
    for effect in effects:
        name, omega = effect.what or effect.mechanism, rig.signal.omega
        if name in _INSIDE:
            inside.update(_INSIDE[name](effect.parameters, float(effect.at == "base"), omega))
        else:
            outside = _OUTSIDE[name](outside, effect.parameters, omega)
    return Hidden(**inside), outside
