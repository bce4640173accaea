# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges a run on a sphere that moves through cyclic patches.

By the same bounds as judge_rotatingSphere.py, and by what both halves of a patch must
have in common. Needs nothing but the .vtp files.
"""

import numpy as np

from judge_rotatingSphere import PERIOD, RADIUS, Motion, judge_rotation, parser_of
from results import Run, Verdict


class Images(Motion):
    """Of all points that the patches make one, that which the sphere had at the start."""

    def turned_back(self, points, time):
        candidates = self.images_of(self.moved_back(points, time))
        distances = [np.linalg.norm(x - self.centre, axis=1) for x in candidates]
        nearest = np.argmin(distances, axis=0)
        return np.choose(nearest[:, None], candidates)


class Translation(Images):
    """Of a box of the size 1 whose sides in x are one."""

    def __init__(self, centre, velocity):
        super().__init__(centre, [0, 0, 1])
        self.velocity = np.array(velocity)

    def moved_back(self, points, time):
        return points - time * self.velocity

    def images_of(self, points):
        return [points + np.array([n, 0, 0]) for n in range(-2, 3)]

    @staticmethod
    def halves(points):
        """Distances of the points from the two halves, and what moves the first onto the
        second."""
        return points[:, 0], 1 - points[:, 0], lambda x: x + np.array([1, 0, 0])


class Quarters(Images):
    """Of a quarter about the z axis."""

    def __init__(self, centre):
        super().__init__(centre, [0, 0, 1])

    def moved_back(self, points, time):
        return about_z(points, -2 * np.pi * time / PERIOD)

    def images_of(self, points):
        return [about_z(points, n * np.pi / 2) for n in range(4)]

    @staticmethod
    def halves(points):
        return points[:, 1], points[:, 0], lambda x: about_z(x, np.pi / 2)


def about_z(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T


def rim_points(triangles):
    """Those of edges with one triangle."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, counts = np.unique(edges, axis=0, return_counts=True)
    return np.unique(edges[counts == 1])


def judge_halves(run, motion, options, verdict):
    """Where the surface goes through the patch both of its ends are the same."""
    worst = steps = several = 0
    areas = []
    for index in range(len(run)):
        m = run.surface("interface", index)
        # Along seams of p the file has every point twice.
        points, places = np.unique(m.points, axis=0, return_inverse=True)
        rim = points[rim_points(places.reshape(-1)[m.triangles])]
        at_first, at_second, onto = motion.halves(rim)
        near_first = np.abs(at_first) < np.abs(at_second)
        first, second = onto(rim[near_first]), rim[~near_first]
        areas.append(m.triangle_areas().sum())
        several = max(several, len(np.unique(m["component"])))
        if len(first) + len(second) == 0:
            continue
        steps += 1
        if len(first) != len(second):
            worst = np.inf
            continue
        for x, others in [(first, second), (second, first)]:
            gaps = np.linalg.norm(x[:, None] - others[None], axis=2).min(axis=1)
            worst = max(worst, gaps.max())
    verdict.at_least("interfaces that go through the patch", steps, 5)
    verdict.at_most("gap between both ends of the surface [m]", worst, options.gap)
    verdict.at_most("components of the surface", several, 1)
    exact = 4 * np.pi * RADIUS**2
    verdict.at_most(
        "relative error of the area, any step", max(abs(a / exact - 1) for a in areas), 0.03
    )


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--velocity", nargs=3, type=float, help="of a translation [m/s]")
    parser.add_argument("--uncrossed", action="store_true", help="there is no patch")
    parser.add_argument("--gap", type=float, default=1e-12, help="allowed there [m]")
    options = parser.parse_args()
    run, verdict = Run(options.case), Verdict()
    motion = (
        Translation(options.centre, options.velocity)
        if options.velocity
        else Quarters(options.centre)
    )
    judge_rotation(run, options, verdict, motion)
    if not options.uncrossed:
        judge_halves(run, motion, options, verdict)
    verdict.leave()


if __name__ == "__main__":
    main()
