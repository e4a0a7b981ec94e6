"""What first light has to show, as tables: `python benchmarks/first_light.py [table|short|...|all]`.

Ours stands beside the figures of the prototype and of the rivals. The recordings come from an integrator that shares
nothing with the framework: leapfrog in 100 steps a sample, with friction that is set-valued and truly sticks.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

from studies import FORCE, FRICTION, ROOT, TRUE, Study, command, rms, several, track_for, z_scores


def show(title, head, rows):
    """Print a markdown table."""
    print(f"\n### {title}\n\n| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for row in rows:
        print(f"| {' | '.join(str(cell) for cell in row)} |")
    sys.stdout.flush()


def span(result, stage, key, truth=None):
    """Return a parameter as text: median, interval, and whether the truth is inside."""
    i = result["intervals"].get(stage, {}).get(key)
    if i is None:
        return "not fitted"
    text = f"{i['median']:.4g} ({i['low']:.4g} to {i['high']:.4g})"
    return text if truth is None else f"{text} {'yes' if i['low'] <= truth <= i['high'] else 'NO'}"


def best_wrong(result):
    """Return the best log-likelihood gained by one wrong term: neither friction in any form nor damping."""
    right = (FRICTION, "stribeck_friction", "lugre_friction", "quadratic_damping")
    fitted = {k: g for k, g in result["gains"].items() if k and "+" not in k and k not in right}
    tested = {k: g for k, g in result["promised"].items() if k not in right and k not in fitted}
    name, gain = max({**tested, **fitted}.items(), key=lambda pair: pair[1], default=("-", 0.0))
    return f"{gain:.1f} ({name})"


PROTOTYPE = {
    3.0: ("13.0", "3.008", "7.98", "2003 / 797 / <16"),
    1.0: ("9.6", "0.998", "8.00", "957 / 392 / <13"),
    0.0: ("8.00", "-0.004", "-", "<4 for all"),
}


def table(args):
    """The three rows of the prototype table: 100 training periods at 1 % noise."""
    seeds = range(1, 1 + args.records)
    studies = [Study(force, seed, 143, gap=False, predict=force > 0) for force in PROTOTYPE for seed in seeds]
    results = several(studies, args)
    head = ("hidden", "named", "c ignoring it: prototype / ours", "friction in N: prototype / ours, truth inside?")
    head += ("c with it: prototype / ours", "gains: prototype", "gains: ours", "time")
    title = "Case 1, 100 training periods, 1 % noise; gains by Coulomb / quadratic / best wrong term"
    show(title, head, [table_row(r) for r in results])


def table_row(r):
    ignored, force, c, theirs = PROTOTYPE[r["hidden"]]
    gains = {**r["promised"], **r["gains"]}
    ours = [f"{gains[k]:.0f}" for k in (FRICTION, "quadratic_damping")]
    return [
        f"{r['hidden']:g} N",
        names(r),
        f"{ignored} / {span(r, 'before', 'c')}",
        f"{force} / {span(r, 'friction', FORCE, r['hidden'])}",
        f"{c} / {span(r, 'after', 'c', 8.0)}",
        theirs,
        f"{' / '.join(ours)} / {best_wrong(r)}",
        f"{r['seconds']:.0f} s",
    ]


def names(result):
    """Return what was found, in words."""
    return ", ".join(result["verdict"]) or "adequate"


RIVALS = {
    (3.0, 0.01): "filter prototype 3.018 +- 0.012; weak SINDy (gap given) 2.88 +- 0.02",
    (1.0, 0.01): "filter prototype 1.013 +- 0.013; weak SINDy 3 of 4 named",
    (0.3, 0.01): "filter prototype 0.290 (60 periods); weak SINDy 0 of 4 named",
    (0.0, 0.01): "filter prototype 0.004 +- 0.013, 0 of 10 false alarms",
    (3.0, 0.1): "filter prototype 2.97 (60 periods); weak SINDy fails",
}


def ensemble(title, groups, args):
    """Print a row for each (hidden force, noise): mean, scatter, coverage, z-scores, names and false alarms."""
    rows = []
    for hidden, noise in groups:
        found = several([Study(hidden, args.first + s, noise=noise) for s in range(args.seeds)], args)
        rows.append(ensemble_row(found, hidden, noise))
    head = ("hidden, noise", "rival or prototype", "found: mean +- scatter", "worst miss", "in interval")
    head += ("z rms (c, x0, k0)", "named right", "else", "seconds each")
    show(title, head, rows)


def ensemble_row(found, hidden, noise):
    fitted = [r for r in found if FORCE in r["intervals"].get("friction", {})]
    spans = [r["intervals"]["friction"][FORCE] for r in fitted]
    force = np.array([i["median"] for i in spans])
    inside = sum(i["low"] <= hidden <= i["high"] for i in spans)
    right = [FRICTION] if hidden else []
    wrong = [names(r) for r in found if r["verdict"] != right]
    fits = f"{force.mean():.4f} +- {force.std(ddof=1):.4f}" if len(force) > 1 else "not fitted"
    worst = f"{np.abs(force - hidden).max():.3f}" if len(force) else "-"
    keys = ([FORCE] if hidden else []) + ["c", "x0", "k0"]
    z = [f"{k.split('.')[-1]} {rms(z_scores(found, k, hidden)):.2f}" for k in keys]
    return [
        f"{hidden:g} N, {noise:.0%}",
        RIVALS.get((hidden, noise), "-"),
        fits,
        worst,
        f"{inside} of {len(fitted)}",
        ", ".join(z),
        f"{len(found) - len(wrong)} of {len(found)}",
        "; ".join(wrong) or "-",
        f"{np.mean([r['seconds'] for r in found]):.1f}",
    ]


def short(args):
    """Twenty training periods, the gap and its stiffness unknown too."""
    title = "20 training periods, c, x0 and k0 unknown over two decades each"
    ensemble(title, [(3.0, 0.01), (1.0, 0.01), (0.3, 0.01), (0.0, 0.01)], args)


def noise(args):
    ensemble("The same at 10 % noise", [(3.0, 0.1), (0.0, 0.1)], args)


def clean(args):
    """Nothing hidden: the verdict has to be "adequate"."""
    studies = [Study(0.0, 500 + i, n, noise=s) for n in (29, 143) for i, s in enumerate((0.01, 0.05, 0.1))]
    rows = []
    for r in several(studies, args):
        place = (f"{r['periods']}", f"{r['noise']:.0%}", names(r), f"{r['nothing']:.3f}")
        values = [span(r, "after", k, TRUE[k]) for k in ("c", "x0", "k0")]
        rows.append((*place, best_wrong(r), *values, f"{r['seconds']:.0f} s"))
    head = ("periods", "noise", "verdict", "P(nothing)", "best term gains", "c", "x0", "k0", "time")
    show("Clean recordings", head, rows)


def horizon(args):
    """How long free predictions hold on held-out starts."""
    rows = []
    for r in several([Study(3.0, 700 + s, 143, gap=False, predict=True) for s in range(min(args.seeds, 3))], args):
        times, errors = r["valid"], r["nrmse"]
        ours = [f"{times[k]:.2f}" for k in times]
        rows.append(
            [r["seed"], names(r), *ours, f"{r['exponents']['after']:.2f}", *(f"{errors[k]:.2%}" for k in errors)]
        )
    rows.append(("prototype", FRICTION, "2.00", "6.76", "6.65", "5.4", "-", "-", "-"))
    head = ("record", "named", "before", "after", "truth", "exponent (1/s)")
    head += ("error over half a time: before", "after", "truth")
    show("Valid prediction of held-out data in Lyapunov times, median of 150 starts, 3 N hidden", head, rows)


EMPS = """title = "EMPS"
[[recordings]]
file = "{folder}/DATA_EMPS.mat"
time = "t"
hold = "step"
excitation = {{ column = "vir", quantity = "force", unit = "N", factor = 35.15065 }}
response = {{ column = "qm", quantity = "position", unit = "m" }}
[[recordings]]
file = "{folder}/DATA_EMPS_PULSES.mat"
time = "t"
hold = "step"
excitation = {{ column = "vir", quantity = "force", unit = "N", factor = 35.15065 }}
response = {{ column = "qm", quantity = "position", unit = "m" }}
[model]
name = "rigid_drive"
[model.estimate]
m = {{ low = 10.0, high = 1000.0, scale = "log" }}
c = {{ low = 1.0, high = 10000.0, scale = "log" }}
"""
PUBLISHED = {"m": 95.1089, "c": 203.5034, FORCE: 20.3935, "offset_force.force": 3.1648}


def emps(args):
    """A real machine: the published identification beside ours, and pulses that no fit has seen."""
    data = args.shared / "data" / "emps"
    if not data.is_dir():
        print(f"\n### EMPS\n\nskipped: {data} is absent")
        return
    with tempfile.TemporaryDirectory() as folder:
        seen, taken = command(EMPS.format(folder=data.resolve()), Path(folder))
    rows = []
    for key, value in PUBLISHED.items():
        i = seen["parameters"]["after"].get(key)
        ours = f"{i['median']:.5g} ({i['low']:.5g} to {i['high']:.5g})" if i else "not found"
        rows.append((key, f"{value:.5g}", ours, f"{i['median'] / value - 1.0:+.2%}" if i else "-"))
    found = ", ".join(f"{f['mechanism']} (P = {f['probability']:.3f})" for f in seen["found"])
    show(f"EMPS: {found}; {taken:.0f} s", ("parameter", "published", "ours", "difference"), rows)
    fit, valid = seen["fit"], seen["valid_prediction_time"]
    rows = []
    for k in ("before", "after"):
        error, score = fit[k]["heldout_nrmse"], fit[k]["heldout_log_score"]
        rows.append((k, f"{error:.3%}", f"{score:.3f}", f"{valid[k]:.3g} s", f"{force_left(seen, k):.2%}"))
    head = ("model", f"free-running error over {fit['after']['horizon']:g} {fit['horizon_unit']}")
    show(
        "DATA_EMPS_PULSES, seen by no fit",
        (*head, "log score a sample", "valid for", "force unexplained, of the drive"),
        rows,
    )


def force_left(seen, stage):
    """Return the rms of the force that is unexplained on the held-out recording, as a share of the drive."""
    return seen["unexplained" if stage == "after" else "unexplained_before"]["share_of_drive"]


CASE = """title = "speed"
[[recordings]]
file = "recording.csv"
time = "time"
excitation = { column = "force", quantity = "force", unit = "N" }
response = { column = "position", quantity = "position", unit = "m" }
[model]
name = "lin_backlash"
[model.known]
m = 1.0
k0 = 40000.0
k1 = 0.0
[model.estimate]
c = { low = 0.8, high = 80.0, scale = "log" }
x0 = { low = 5e-4, high = 5e-2, scale = "log" }
"""


def speed(args):
    """24,000 samples, two unknowns, all terms: the command from start to end."""
    rows = []
    for hidden in (3.0, 0.0):
        observation = track_for(Study(hidden, 900, 120))
        with tempfile.TemporaryDirectory() as name:
            columns = np.stack([observation.time, observation.inputs[:, 0], observation.response], axis=1)
            np.savetxt(Path(name) / "recording.csv", columns, "%.12g", ",", header="time,force,position", comments="")
            seen, taken = command(CASE, Path(name))
        found = ", ".join(f["mechanism"] for f in seen["found"]) or "adequate"
        rows.append((f"{hidden:g} N", found, "60 s", f"{taken:.1f} s"))
    show("`lostmotion diagnose`, 24,000 samples, two unknowns", ("hidden", "named", "wanted below", "taken"), rows)


PARTS = {f.__name__: f for f in (table, short, noise, clean, horizon, emps, speed)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="*", default=["all"], help=" ".join([*PARTS, "all"]))
    parser.add_argument("--seeds", type=int, default=10, help="records of each kind")
    parser.add_argument("--records", type=int, default=1, help="long records of each row of the table")
    parser.add_argument("--first", type=int, default=100, help="seed of the first short record")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="folder of the real recordings")
    parser.add_argument("--keep", type=Path, help="file that every single result is added to, as a line of JSON")
    args = parser.parse_args()
    chosen = list(PARTS) if "all" in args.part else args.part
    if unknown := [part for part in chosen if part not in PARTS]:
        parser.error(f"no part {unknown[0]!r}: there are {', '.join(PARTS)} and all")
    for part in chosen:
        PARTS[part](args)


if __name__ == "__main__":
    main()
