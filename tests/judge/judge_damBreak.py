# SPDX-License-Identifier: GPL-3.0-or-later
# Part of interfaceStability, an extension of OpenFOAM.
"""Judges runs on the dam break over an obstacle.

walls:  the detached area of a run with `wallVelocity slip` against `noSlip`
series: the areas of a run on 32^3 cells against those recorded
"""

import argparse

import numpy as np

from results import Run, Verdict

# Sums over all intervals of 0.02 s to the end time, epsilon 0.5 cells, isoAlpha, slip
# walls. There is no truth for them: they tell that something changed, and the reason
# has to be known before they may be. {end time: {quantity: value}}
RECORDED = {
    0.5: {
        "mean area of the interface [m2]": 0.7833,
        "detached near walls, sum [m2]": 0.02293,
        "detached elsewhere, sum [m2]": 0.09608,
        "detached fraction beyond 1 cell, sum": 0.01478,
        "attached area, sum [m2]": 0.009583,
        "coverage at the end": 0.8795,
        "particles at the end": 4130,
    },
    2.5: {
        "mean area of the interface [m2]": 0.8943,
        "detached near walls, sum [m2]": 0.4666,
        "detached elsewhere, sum [m2]": 0.2241,
        "detached fraction beyond 1 cell, sum": 0.07405,
        "attached area, sum [m2]": 0.08282,
        "coverage at the end": 0.5935,
        "particles at the end": 28970,
    },
}


def detached(run):
    """Detached area [m2] of each time: near walls, and in all, from the files of T."""
    near, whole = [], []
    for index in range(1, len(run)):
        t = run.surface("timeSurface", index)
        areas = t.point_areas()
        out = t["stability"] == 2
        near.append(areas[out & (t["nearWall"] == 1)].sum())
        whole.append(areas[out].sum())
    return np.array(near), np.array(whole)


def judge_walls(options, verdict):
    slip_near, slip_whole = detached(Run(options.slip))
    free_near, free_whole = detached(Run(options.noSlip))
    print(f"  slip:   {slip_near.sum():.4g} m2 near walls, {slip_whole.sum():.4g} m2 in all")
    print(f"  noSlip: {free_near.sum():.4g} m2 near walls, {free_whole.sum():.4g} m2 in all")
    verdict.check("noSlip detaches near walls", free_near.sum() > 0, f"{free_near.sum():.4g} m2")
    verdict.at_most(
        "slip over noSlip, detached near walls",
        slip_near.sum() / max(free_near.sum(), 1e-300),
        1 / 3,
    )
    verdict.at_most(
        "all that slip detaches over what noSlip detaches near walls",
        slip_whole.sum() / max(free_near.sum(), 1e-300),
        1 / 3,
    )


def sums(run):
    near, whole = detached(run)
    rows = run.table("stability.dat")
    survival = run.table("survival.dat")
    return {
        "mean area of the interface [m2]": rows["area"].mean(),
        "detached near walls, sum [m2]": near.sum(),
        "detached elsewhere, sum [m2]": whole.sum() - near.sum(),
        "detached fraction beyond 1 cell, sum": survival["detached(1)"].sum(),
        "attached area, sum [m2]": rows["attachedArea"].sum(),
        "coverage at the end": rows["coverage"][-1],
        "particles at the end": rows["particles"][-1],
    }


def judge_series(options, verdict):
    run = Run(options.case)
    values = sums(run)
    expected = round(options.end / 0.02) + 1
    last = run.table("stability.dat")["Time"][-1]
    verdict.check(
        "all times are there",
        len(run) == expected and abs(last - options.end) < 1e-9,
        f"{len(run)} of {expected}, the last at {last:g} s",
    )
    recorded = RECORDED.get(options.end)
    for name, value in values.items():
        if not recorded:
            print(f'        "{name}": {value:.4g},')
        else:
            reference = recorded[name]
            verdict.check(
                name,
                abs(value - reference) <= 0.2 * reference,
                f"{value:.4g}, recorded {reference:g}",
            )
    if not recorded:
        verdict.check("series", False, f"nothing is recorded for {options.end} s")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(required=True)
    walls = commands.add_parser("walls")
    walls.add_argument("slip")
    walls.add_argument("noSlip")
    walls.set_defaults(judge=judge_walls)
    series = commands.add_parser("series")
    series.add_argument("case")
    series.add_argument("--end", type=float, help="end time [s]")
    series.set_defaults(judge=judge_series)
    options = parser.parse_args()
    verdict = Verdict()
    options.judge(options, verdict)
    verdict.leave()


if __name__ == "__main__":
    main()
