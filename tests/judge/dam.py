# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts of the surfaces of the dam break are resolved, by its fields: a cell of
water and one of air lie within 2.4 cells, and no wall within one."""

from pathlib import Path

import numpy as np

TANK = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])  # open at y = 1
OBSTACLE = np.array([[0.375, 0.375, 0.0], [0.625, 0.625, 0.25]])
DISTANCES = (0.05, 0.1, 0.25, 0.5, 1.0)  # in cells


def field(path, components):
    """Internal values of a binary field."""
    content = Path(path).read_bytes()
    head = content.index(b"internalField   nonuniform")
    start = content.index(b"(", head)
    n = int(content[head:start].split()[-1])
    values = np.frombuffer(content, dtype=float, count=n * components, offset=start + 1)
    return values.reshape(n, components).squeeze()


def wall_distance(x):
    to_sides = np.minimum(x - TANK[0], TANK[1] - x)
    to_sides[:, 1] = x[:, 1]
    outside = np.maximum(np.maximum(OBSTACLE[0] - x, x - OBSTACLE[1]), 0)
    return np.minimum(to_sides.min(axis=1), np.linalg.norm(outside, axis=1))


class Resolution:
    """Which cells have water and air near; the case holds cell centres in 0/C."""

    def __init__(self, case, cells):
        self.case, self.cells = Path(case), cells
        self.index = self.cell_of(field(self.case / "0" / "C", 3))

    def cell_of(self, x):
        return tuple(np.clip((x * self.cells).astype(int), 0, self.cells - 1).T)

    def both_near(self, time):
        """Over the whole lattice of the tank."""
        alpha = field(self.case / f"{time:g}" / "alpha.water", 1)
        near = np.ones((self.cells,) * 3, dtype=bool)
        for of_phase in (alpha > 0.95, alpha < 0.05):
            lattice = np.zeros(near.shape, dtype=bool)
            lattice[self.index] = of_phase
            near &= spread(lattice)
        return near


def spread(lattice):
    """To all within the root of 6, which is about 2.4 cells."""
    n = lattice.shape[0]
    padded = np.pad(lattice, 2)
    result = np.zeros(lattice.shape, dtype=bool)
    offsets = range(-2, 3)
    for i, j, k in ((i, j, k) for i in offsets for j in offsets for k in offsets):
        if i * i + j * j + k * k <= 6:
            result |= padded[2 + i : 2 + i + n, 2 + j : 2 + j + n, 2 + k : 2 + k + n]
    return result


class Survival:
    """Mean shares of T that lie farther from M than DISTANCES, and the mean area of M:
    over the classified times with these indices."""

    def __init__(self, run, resolution, indices):
        sums = {part: np.zeros(len(DISTANCES)) for part in ("resolved", "all")}
        areas = dict.fromkeys(sums, 0.0)
        self.area = 0.0
        for index in indices:
            t, m = run.surface("timeSurface", index), run.surface("interface", index)
            self.area += m.triangle_areas().sum() / len(indices)
            present = np.where(t["stability"] == 5, 0, t.inside_areas())
            for part, mask in self._parts(run, resolution, index, t):
                of_part = present[mask]
                areas[part] += of_part.sum()
                farther = t["distance"][mask][:, None] * resolution.cells > DISTANCES
                sums[part] += of_part @ farther
        self.resolved = sums["resolved"] / areas["resolved"]
        self.all = sums["all"] / areas["all"]
        self.resolved_share = areas["resolved"] / areas["all"]

    @staticmethod
    def _parts(run, resolution, index, t):
        before = run.surface("interface", index - 1)
        start = np.zeros((before["vertex"].max() + 1, 3))
        start[before["vertex"]] = before.points
        h = 1 / resolution.cells
        free = (wall_distance(t.points) >= h) & (wall_distance(start[t["vertex"]]) >= h)
        both = resolution.both_near(t.time)[resolution.cell_of(t.points)]
        return ("resolved", free & both), ("all", np.ones(t.n, dtype=bool))

    def __str__(self):
        def row(shares):
            return " ".join(f"{share:7.3%}" for share in shares)

        return (
            f"resolved ({self.resolved_share:.0%}) {row(self.resolved)}"
            f" | all {row(self.all)} | area {self.area:.4f} m2"
        )
