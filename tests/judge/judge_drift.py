# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges how much of the time surface is called stable, and its drift speed, at every
step of a run."""

import argparse

import numpy as np

from results import Run, Verdict


def stable_share(t, margin):
    """By area, of what did not leave the domain, the unit cube, and is this far inside."""
    inside = np.all((t.points >= margin) & (t.points <= 1 - margin), axis=1)
    inside &= t["stability"] != 3
    areas = t.point_areas()
    return areas[inside & (t["stability"] == 0)].sum() / areas[inside].sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case")
    parser.add_argument("--stable-at-least", type=float, default=0)
    parser.add_argument("--stable-at-most", type=float, default=1)
    parser.add_argument("--margin", type=float, default=0, help="from the sides, left out [m]")
    parser.add_argument("--drift", type=float, help="median of driftSpeed on M and T [m/s]")
    parser.add_argument("--within", type=float, default=0.01, help="of the drift, relative")
    options = parser.parse_args()

    run, verdict = Run(options.case), Verdict()
    shares = []
    for index in range(1, len(run)):
        t = run.surface("timeSurface", index)
        distance = t["distance"][t["stability"] != 3]
        shares.append(stable_share(t, options.margin))
        print(
            f"  step {index}: stable share of T {shares[-1]:.5f}, "
            f"distance {distance.min():.6g} to {distance.max():.6g} m"
        )
    verdict.at_least("stable share of T, lowest", min(shares), options.stable_at_least)
    verdict.at_most("stable share of T, highest", max(shares), options.stable_at_most)
    if options.drift is not None:
        for family in ("interface", "timeSurface"):
            medians = [np.median(run.surface(family, i)["driftSpeed"]) for i in range(1, len(run))]
            wrong = max(medians, key=lambda median: abs(median - options.drift))
            verdict.check(
                f"driftSpeed of {family}",
                abs(wrong - options.drift) <= options.within * abs(options.drift),
                f"median {wrong:.6g} m/s, wanted {options.drift:g} m/s",
            )
    verdict.leave()


if __name__ == "__main__":
    main()
