# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges a run on the rotating sphere by the motion that was planted in its data.

What the run wrote is compared with the rigid rotation: the material point of a vertex
is the vertex, turned back by the angle. Needs nothing but the .vtp files.
"""

import argparse

import numpy as np

from chart import Chart
from results import Run, Verdict

THROUGH = np.array([0.5, 0.5, 0.5])
RADIUS = 0.15
PERIOD = 1.0


class Motion:
    """A sphere around `centre` at the time 0 turns about the axis through THROUGH."""

    def __init__(self, centre, axis):
        self.centre = np.array(centre)
        self.axis = np.array(axis) / np.linalg.norm(axis)

    def turned_back(self, points, time):
        """Where the rotation had these points at the time 0 (Rodrigues)."""
        angle = -2 * np.pi * time / PERIOD
        arms = points - THROUGH
        along = np.outer(arms @ self.axis, self.axis)
        across = arms - along
        turned = np.cos(angle) * across + np.sin(angle) * np.cross(self.axis, across)
        return THROUGH + along + turned

    def arc(self, x, y):
        """Distance of two points along the sphere at the time 0: what they differ by
        radially is the reconstruction's error and no error of p."""
        x = (x - self.centre) / np.linalg.norm(x - self.centre, axis=1)[:, None]
        y = (y - self.centre) / np.linalg.norm(y - self.centre, axis=1)[:, None]
        return RADIUS * np.arctan2(
            np.linalg.norm(np.cross(x, y), axis=1), np.einsum("ij,ij->i", x, y)
        )


class Errors:
    """Tangential errors of one step, in cells. Means are by area: along seams there are
    many small triangles."""

    def __init__(self, interface, chart, motion, h):
        exact = motion.turned_back(interface.points, interface.time)
        areas = interface.point_areas()
        stable = interface["stability"] == 0
        tracked = stable & interface.has_p()
        origin = motion.arc(exact, interface["origin"])[stable] / h
        self.origin_mean = np.average(origin, weights=areas[stable])
        self.origin_max = origin.max(initial=0)
        places, outside = chart.place(interface["parameter"][tracked])
        p = motion.arc(exact[tracked], places) / h
        near = outside <= 0.5 * h
        self.p_mean = np.average(p[near], weights=areas[tracked][near])
        self.p_max = p[near].max(initial=0)
        self.strays = areas[tracked][~near].sum() / areas[stable].sum()
        self.wrong_share, self.blank_share = self._triangles(
            interface, chart, motion, h, stable
        )

    @staticmethod
    def _triangles(interface, chart, motion, h, stable):
        """Shares of the stable area whose p is wrong (its centroid maps more than a
        cell from where it was, or into no chart), and that has no p."""
        corners = interface.triangles
        inside = np.all(stable[corners], axis=1)
        corners = corners[inside]
        areas = interface.triangle_areas()[inside]
        whole = np.all(interface.has_p()[corners], axis=1)
        centres = interface.points[corners].mean(axis=1)
        exact = motion.turned_back(centres, interface.time)
        parameters = interface["parameter"][corners].mean(axis=1)
        wrong = np.zeros(len(corners), dtype=bool)
        if np.any(whole):
            places, outside = chart.place(parameters[whole])
            wrong[whole] = (outside > 1e-9) | (motion.arc(exact[whole], places) > h)
        total = max(areas.sum(), 1e-300)
        return areas[wrong].sum() / total, areas[~whole].sum() / total


def shares(run, index):
    """Detached share of T, attached share of M, both by area."""
    t = run.surface("timeSurface", index)
    m = run.surface("interface", index)
    of_t, of_m = t.point_areas(), m.point_areas()
    detached = of_t[t["stability"] == 2].sum() / of_t.sum()
    attached = of_m[m["stability"] == 1].sum() / of_m.sum()
    return detached, attached, m


def judge_still(run, verdict):
    """U was set to zero in the data: what cannot fail is no test."""
    detached = [shares(run, i)[0] for i in range(1, len(run))]
    verdict.at_least("half of T detaches at every step", min(detached), 0.5)
    print(f"  detached share of T: {min(detached):.3f} to {max(detached):.3f}")


def table_head():
    print("  step   f_det     f_att     origin mean/max     p mean/max       wrong    no p")


def judge_distances(run, options, verdict):
    """Shares of T farther from M than so many cells."""
    surfaces = [run.surface("timeSurface", index) for index in range(1, len(run))]
    for cells, allowed in options.detached:
        farther = [t.share_beyond(cells / options.cells) for t in surfaces]
        print(f"  detached beyond {cells:g} cells: largest {max(farther):.4%}")
        verdict.at_most(f"detached beyond {cells:g} cells, mean", np.mean(farther), allowed)


def judge_rotation(run, options, verdict, motion):
    h = 1.0 / options.cells
    chart = Chart(run.surface("timeSurface", 0))
    verdict.check("the chart is one-to-one oriented", chart.flipped == 0, f"{chart.flipped} flips")
    table_head()
    worst_detached = worst_attached = largest_origin = largest_p = strays = 0
    for index in range(len(run)):
        detached, attached, interface = shares(run, index)
        errors = Errors(interface, chart, motion, h)
        largest_origin = max(largest_origin, errors.origin_max)
        largest_p = max(largest_p, errors.p_max)
        strays = max(strays, errors.strays)
        if index:
            worst_detached = max(worst_detached, detached)
            worst_attached = max(worst_attached, attached)
        if index % 5 == 0 or index == len(run) - 1:
            print(
                f"  {index:4d} {detached:9.2e} {attached:9.2e}"
                f"   {errors.origin_mean:.4f} {errors.origin_max:.4f}"
                f"   {errors.p_mean:.4f} {errors.p_max:.4f}"
                f"   {errors.wrong_share:.5f} {errors.blank_share:.5f}"
            )

    steps = len(run) - 1
    verdict.check(
        f"{options.transfers} transfers", steps == options.transfers, f"{steps} transfers"
    )
    verdict.at_most("detached share of T, any step", worst_detached, 0)
    if options.attached:
        verdict.at_most("attached share of M, any step", worst_attached, 0)
    judge_distances(run, options, verdict)
    # The last interface of the loop is that after the full turn.
    verdict.at_most("mean error of origin [cells]", errors.origin_mean, options.mean)
    verdict.at_most("mean error of p [cells]", errors.p_mean, options.mean)
    if options.largest:
        verdict.at_most("largest error of origin, any step [cells]", largest_origin, options.largest)
        verdict.at_most(
            "largest error of p after the turn [cells]",
            errors.p_max,
            options.p_end or options.largest,
        )
        # At single vertices of a seam, now and then.
        verdict.at_most("largest error of p, any step [cells]", largest_p, options.p_any)
    if options.quarter:
        # Most of the noise of the surface is smaller than a quarter of a cell.
        survival = run.table("survival.dat")
        for kind in "detached", "attached":
            worst = survival[f"{kind}(0.25)"][1:].max()
            verdict.at_most(f"{kind} at a quarter of a cell, any step", worst, options.quarter)
    verdict.at_most("area with p off the charts, any step", strays, 0.005)
    verdict.at_most(
        "stable area with wrong or no p", errors.wrong_share + errors.blank_share, 0.005
    )


def parser_of(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("case")
    parser.add_argument("--cells", type=int, default=32, help="along each side of the cube")
    parser.add_argument("--transfers", type=int, default=40)
    parser.add_argument("--mean", type=float, default=0.1, help="allowed mean error [cells]")
    parser.add_argument("--largest", type=float, help="allowed error of any vertex [cells]")
    parser.add_argument("--p-end", type=float, help="the same of p after the turn, if another")
    parser.add_argument("--p-any", type=float, default=0.5,
                        help="allowed error of p of any vertex at any step [cells]")
    parser.add_argument("--centre", nargs=3, type=float, default=[0.726, 0.393, 0.508],
                        help="of the sphere at the start [m]")
    parser.add_argument("--axis", nargs=3, type=float, default=[1, 2, 3])
    parser.add_argument("--detached", nargs=2, type=float, action="append", default=[],
                        metavar=("CELLS", "SHARE"),
                        help="allowed share of T farther from M than so many cells")
    parser.add_argument("--quarter", type=float,
                        help="allowed share farther away than a quarter of a cell")
    parser.add_argument("--no-attached", dest="attached", action="store_false",
                        help="do not judge what attached")
    return parser


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--still", action="store_true", help="U is zero: T must detach")
    options = parser.parse_args()

    run, verdict = Run(options.case), Verdict()
    if options.still:
        judge_still(run, verdict)
    else:
        judge_rotation(run, options, verdict, Motion(options.centre, options.axis))
    verdict.leave()


if __name__ == "__main__":
    main()
