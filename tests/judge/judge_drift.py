# SPDX-License-Identifier: GPL-3.0-or-later
# Part of interfaceStability, an extension of OpenFOAM.
"""Judges how much of the time surface is called stable, at every step of a run."""

import argparse

from results import Run, Verdict


def stable_share(t):
    """By area, of what did not leave the domain."""
    areas = t.point_areas()
    return areas[t["stability"] == 0].sum() / areas[t["stability"] != 3].sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case")
    parser.add_argument("--stable-at-least", type=float, default=0)
    parser.add_argument("--stable-at-most", type=float, default=1)
    options = parser.parse_args()

    run, verdict = Run(options.case), Verdict()
    shares = []
    for index in range(1, len(run)):
        t = run.surface("timeSurface", index)
        distance = t["distance"][t["stability"] != 3]
        shares.append(stable_share(t))
        print(
            f"  step {index}: stable share of T {shares[-1]:.5f}, "
            f"distance {distance.min():.6g} to {distance.max():.6g} m"
        )
    verdict.at_least("stable share of T, lowest", min(shares), options.stable_at_least)
    verdict.at_most("stable share of T, highest", max(shares), options.stable_at_most)
    verdict.leave()


if __name__ == "__main__":
    main()
