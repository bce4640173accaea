# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges the files of any run: their arrays, meshes, tables and histories.

Everything is opened with VTK's reader; areas, edges and classes are counted again and
compared with the tables.
"""

import argparse
import json

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from chart import Locator
from results import FAMILIES, Run, Verdict, generator

# name: (components, integer)
ARRAYS = {
    "interface": {
        "TCoords": (2, False),
        "parameter": (2, False),
        "origin": (3, False),
        "vertex": (1, True),
        "stability": (1, True),
        "cellSize": (1, False),
        "distance": (1, False),
        "driftSpeed": (1, False),
        "confidence": (1, False),
        "thin": (1, True),
        "subGrid": (1, True),
        "nearWall": (1, True),
        "fromOutside": (1, True),
        "preimageCount": (1, True),
        "component": (1, True),
    },
    "timeSurface": {
        "parameter": (2, False),
        "vertex": (1, True),
        "stability": (1, True),
        "cellSize": (1, False),
        "distance": (1, False),
        "driftSpeed": (1, False),
        "confidence": (1, False),
        "thin": (1, True),
        "subGrid": (1, True),
        "nearWall": (1, True),
        "fromOutside": (1, True),
    },
    "particles": {
        "id": (1, True),
        "detachmentTime": (1, False),
        "age": (1, False),
        "parameter": (2, False),
        "origin": (3, False),
        "detachmentPosition": (3, False),
        "component": (1, True),
        "weight": (1, False),
        "nearWall": (1, True),
        "fromOutside": (1, True),
        "state": (1, True),
    },
}
CLASSES = {"interface": {0, 1, 4}, "timeSurface": {0, 2, 3}}
TABLES = ("stability.dat", "survival.dat", "droplets.dat", "timing.dat")
MAY_BE_CONSTANT = {"cellSize", "component", "fromOutside", "preimageCount", "state", "subGrid", "thin"}


class Findings:
    """Problems by check: the first few are told, all are counted."""

    def __init__(self):
        self.problems = {}

    def open(self, check):
        self.problems.setdefault(check, [])

    def add(self, check, text):
        self.problems.setdefault(check, []).append(text)

    def require(self, check, passed, text):
        self.open(check)
        if not passed:
            self.add(check, text)

    def report(self, verdict):
        for check, texts in self.problems.items():
            more = f" (and {len(texts) - 3} more)" if len(texts) > 3 else ""
            verdict.check(check, not texts, "; ".join(texts[:3]) + more)


class Variation:
    """Does an array ever take a second value over the run?"""

    def __init__(self):
        self.low, self.high = {}, {}

    def see(self, family, surface):
        for name, values in surface.arrays.items():
            if len(values):
                key = family, name
                low, high = values.min(axis=0), values.max(axis=0)
                self.low[key] = np.minimum(self.low.get(key, low), low)
                self.high[key] = np.maximum(self.high.get(key, high), high)

    def constant(self):
        return [
            f"{name} of {family}"
            for (family, name), low in sorted(self.low.items())
            if name not in MAY_BE_CONSTANT and np.any(low == self.high[family, name])
        ]


def check_arrays(findings, family, surface):
    name = surface.path.name
    if surface.n == 0:
        return
    for array, (components, integer) in ARRAYS[family].items():
        values = surface.arrays.get(array)
        findings.require("arrays are present", values is not None, f"{name} lacks {array}")
        if values is None:
            continue
        shape = (surface.n,) if components == 1 else (surface.n, components)
        wanted = ("int",) if integer else ("double",)
        findings.require(
            "arrays have their types",
            values.shape == shape and surface.types[array] in wanted,
            f"{array} of {name} is {values.shape} {surface.types[array]}",
        )
        findings.require(
            "arrays are finite", np.all(np.isfinite(values)), f"{array} of {name} is not"
        )
    extra = set(surface.arrays) - set(ARRAYS[family])
    findings.require("arrays are documented", not extra, f"{name} has {sorted(extra)}")
    findings.require("points are double", surface.pointType == "double", name)
    findings.require(
        "points are finite", np.all(np.isfinite(surface.points)), f"{name} has other points"
    )
    p = surface["parameter"]
    outside = np.sum(np.any((p < 0) | (p > 1), axis=1) & ~np.all(p == -1, axis=1))
    findings.require(
        "p lies in the unit square", outside == 0, f"{outside} points of {name} have other p"
    )
    classes = CLASSES.get(family)
    if classes:
        found = set(np.unique(surface["stability"]))
        findings.require("classes are known", found <= classes, f"{name} has {found}")


def check_weld(findings, surface):
    """`vertex` joins only points at the same place with the same values."""
    ids = surface["vertex"]
    first = np.full(ids.max() + 1, -1)
    first[ids[::-1]] = np.arange(surface.n)[::-1]
    twins = first[ids]
    same = np.array_equal(surface.points, surface.points[twins])
    for array in ARRAYS["interface"]:
        if array in surface.arrays and array not in ("TCoords", "parameter", "origin"):
            same = same and np.array_equal(surface[array], surface[array][twins])
    findings.require("vertex welds equal points", same, surface.path.name)
    if "origin" in surface.arrays:
        p, origin = surface["parameter"], surface["origin"]
        jumps = np.any(origin != origin[twins], axis=1) & np.all(p == p[twins], axis=1)
        findings.require("the origin jumps only where p does", not jumps.any(), surface.path.name)


def edges_of(triangles):
    """Directed edges, and for each the number of its undirected edge."""
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    low, high = directed.min(axis=1), directed.max(axis=1)
    _, number = np.unique(low * (triangles.max() + 1) + high, return_inverse=True)
    return directed, number


def on_same_side(a, b, box):
    """Do both ends of these edges lie on one and the same side of a box?"""
    tolerance = 1e-9 * np.max(box[1] - box[0])
    within = np.all(
        (a >= box[0] - tolerance)
        & (a <= box[1] + tolerance)
        & (b >= box[0] - tolerance)
        & (b <= box[1] + tolerance),
        axis=1,
    )
    result = np.zeros(len(a), dtype=bool)
    for axis in range(3):
        for side in box[:, axis]:
            result |= (abs(a[:, axis] - side) < tolerance) & (abs(b[:, axis] - side) < tolerance)
    return result & within


def check_edges(findings, surface, boxes):
    triangles = surface.welded()
    if not len(triangles):
        return
    name = surface.path.name
    degenerate = np.sum(
        (triangles[:, 0] == triangles[:, 1])
        | (triangles[:, 1] == triangles[:, 2])
        | (triangles[:, 2] == triangles[:, 0])
    )
    findings.require("triangles have three vertices", degenerate == 0, f"{degenerate} of {name}")
    directed, number = edges_of(triangles)
    uses = np.bincount(number)
    crowded = np.sum(uses > 2)
    findings.require(
        "edges have at most two triangles", crowded == 0, f"{crowded} edges of {name}"
    )
    sense = np.bincount(number, np.sign(directed[:, 1] - directed[:, 0]))
    twisted = np.sum((uses == 2) & (sense != 0))
    findings.require("triangles are oriented alike", twisted == 0, f"{twisted} edges of {name}")
    if boxes:
        place = np.zeros((surface["vertex"].max() + 1, 3))
        place[surface["vertex"]] = surface.points
        rim = directed[uses[number] == 1]
        a, b = place[rim[:, 0]], place[rim[:, 1]]
        at_home = np.any([on_same_side(a, b, box) for box in boxes], axis=0)
        loose = np.sum(~at_home)
        where = f", first at {a[~at_home][0]}" if loose else ""
        findings.require(
            "boundary edges lie on the domain boundary",
            loose == 0,
            f"{loose} of {len(rim)} boundary edges of {name}{where}",
        )


class Texture:
    """The swatch that attached triangles wear."""

    def __init__(self, path):
        reader = vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        image = reader.GetOutput()
        nx, ny, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars())
        self.pixels = pixels.reshape(ny, nx, -1)[:, :, :3].astype(int)

    def colours(self, uv):
        ny, nx, _ = self.pixels.shape
        i = np.clip((uv * [nx, ny]).astype(int), 0, [nx - 1, ny - 1])
        return self.pixels[i[:, 1], i[:, 0]]


def check_texture_coordinates(findings, surface, texture):
    """Tracked triangles wear their parameter, all others black."""
    name = surface.path.name
    corners = surface.triangles
    tracked = np.all((surface.has_p() & (surface["stability"] == 0))[corners], axis=1)
    worn, p = surface["TCoords"][corners], surface["parameter"][corners]
    findings.require(
        "TCoords are p where the interface is tracked",
        np.array_equal(worn[tracked], p[tracked]),
        name,
    )
    entered = np.any((surface["fromOutside"] == 1)[corners], axis=1)
    entered &= ~np.any((surface["stability"] == 1)[corners], axis=1)
    for part, colour, why in (
        (~tracked & ~entered, (0, 0, 0), "attached and mixed triangles are black"),
        (~tracked & entered, (120, 80, 40), "triangles that entered are brown"),
    ):
        if np.any(part):
            off = np.abs(texture.colours(worn[part].reshape(-1, 2)) - np.array(colour)).max()
            findings.require(why, off < 8, f"{name}: off by {off}")
    if np.any(tracked):
        centres = worn[tracked].mean(axis=1)
        darkest = texture.colours(centres).max(axis=1).min()
        findings.require("no tracked triangle is black", darkest > 8, f"{name}: {darkest}")


def check_row(findings, row, m, t, cloud):
    """A row of stability.dat, from the files of its time."""

    def agrees(column, value, scale):
        findings.require(
            "stability.dat agrees with the files",
            abs(row[column] - value) <= 2e-5 * max(abs(scale), 1e-300),
            f"{column} at {row['Time']:g} s is {row[column]:g}, not {value:g}",
        )

    of_m, area = m.point_areas(), m.triangle_areas().sum()
    of_t, t_area = t.inside_areas(), t.triangle_areas().sum()
    detached = t["stability"] == 2
    near = t["nearWall"] == 1
    with_p = np.all(m.has_p()[m.triangles], axis=1)
    agrees("Time", m.time, m.time)
    agrees("vertices", len(np.unique(m["vertex"])), 1)
    agrees("triangles", len(m.triangles), 1)
    agrees("area", area, area)
    attached = m["stability"] == 1
    if row["enteredArea"] == 0:
        by_wall = m["nearWall"] == 1
        tiny = (m["thin"] == 1) | (m["subGrid"] == 1)
        agrees("stableArea", of_m[m["stability"] == 0].sum(), area)
        agrees("attachedArea", of_m[attached].sum(), area)
        agrees("attachedNearWalls", of_m[attached & by_wall].sum(), area)
        agrees("attachedThin", of_m[attached & ~by_wall & tiny].sum(), area)
        agrees("attachedResolved", of_m[attached & ~by_wall & ~tiny].sum(), area)
    agrees("area", row["stableArea"] + row["attachedArea"] + row["enteredArea"], area)
    agrees("detachedNearWalls", of_t[detached & near].sum(), t_area)
    agrees("detachedElsewhere", of_t[detached & ~near].sum(), t_area)
    small = (t["thin"] == 1) | (t["subGrid"] == 1)
    agrees("detachedThin", of_t[detached & ~near & small].sum(), t_area)
    agrees("detachedResolved", of_t[detached & ~near & ~small].sum(), t_area)
    told = row["detachedNearWalls"] + row["detachedThin"] + row["detachedResolved"]
    findings.require(
        "what detached is by walls, thin or resolved",
        abs(told - of_t[detached].sum()) <= 2e-5 * max(t_area, 1e-300),
        f"{told:g} m2 at {row['Time']:g} s",
    )
    findings.require(
        "what left has an area",
        row["leftArea"] == 0 or np.any(t["stability"] == 3),
        f"{row['leftArea']:g} m2 at {row['Time']:g} s, but no point left",
    )
    if of_t.sum() > 0:
        agrees("keptFraction", of_t[t["stability"] == 0].sum() / of_t.sum(), 1)
    if area > row["enteredArea"]:
        agrees("stableFraction", row["stableArea"] / (area - row["enteredArea"]), 1)
        agrees("coverage", m.triangle_areas()[with_p].sum() / area, 1)
    agrees("particles", cloud.n, 1)


def check_drift(findings, m, t, row, interval):
    """Drift speeds are distances over the interval, and the table has their quantiles."""
    for surface in (m, t):
        if surface.n:
            told = np.abs(surface["driftSpeed"]) * interval
            wanted = surface["distance"] if interval else 0 * surface["distance"]
            wrong = np.sum(np.abs(told - wanted) > 1e-9 * np.max(surface["distance"]))
            still = not interval and np.any(surface["driftSpeed"])
            findings.require(
                "driftSpeed is distance over interval",
                not wrong and not still,
                f"{wrong} in {surface.path.name}",
            )
    areas = np.where(t["stability"] == 5, 0, t.inside_areas()) if t.n else np.zeros(0)
    sizes = np.abs(t["driftSpeed"]) if t.n else np.zeros(0)
    for percent in (50, 90, 99):
        value = row[f"driftSpeed{percent}"]
        below = areas[sizes < value * (1 - 1e-9)].sum()
        up_to = areas[sizes <= value * (1 + 1e-9)].sum()
        wanted = percent / 100 * areas.sum()
        findings.require(
            "quantiles of driftSpeed agree with the files",
            below <= wanted * (1 + 1e-9) and up_to >= wanted * (1 - 1e-9),
            f"{percent} % at {row['Time']:g} s: {value:g} m/s",
        )


def check_confidence(findings, m, t, row, cells):
    """How far each point is from epsilon, in noise floors; cells of one size."""
    for surface in (m, t):
        if surface.n:
            uneven = np.abs(surface["cellSize"] / cells - 1).max()
            findings.require(
                "cellSize is that of the cells",
                uneven < 1e-9,
                f"{surface.path.name} is off by {uneven:.3g}",
            )
            floor = row["noiseFloor"] * cells
            off = np.abs(surface["distance"] - row["epsilon"])
            wanted = np.minimum(off / max(floor, 1e-300), 1000)
            wrong = np.sum(np.abs(surface["confidence"] - wanted) > 1e-5 * np.maximum(wanted, 1))
            findings.require(
                "confidence is the way to epsilon over the noise floor",
                wrong == 0,
                f"{wrong} in {surface.path.name}",
            )


def check_droplets(findings, m, droplets, time):
    """droplets.dat has a row for each component that is sub-grid, and its points."""
    here = np.isclose(droplets["Time"], time, rtol=0, atol=1e-12 * max(1, abs(time)))
    told = {
        int(c): int(n) for c, n in zip(droplets["component"][here], droplets["points"][here])
    }
    flagged = {}
    if m.n:
        small = m["subGrid"] == 1
        for component in np.unique(m["component"][small]):
            of_it = m["component"] == component
            flagged[int(component)] = len(np.unique(m["vertex"][of_it]))
            findings.require(
                "components are sub-grid as wholes", np.all(small[of_it]), m.path.name
            )
    findings.require(
        "droplets.dat agrees with the files", told == flagged, f"{told}, not {flagged}"
    )
    findings.require(
        "droplets are below 1.5 cells",
        np.all((droplets["radius"][here] > 0) & (droplets["radius"][here] < 1.5)),
        f"at {time:g} s",
    )


class Particles:
    """What a particle remembers must never change; what is seeded weighs half of the
    detached points and half of the triangles around them."""

    MEMORIES = ("detachmentTime", "parameter", "origin", "detachmentPosition",
                "component", "weight", "nearWall")

    def __init__(self):
        self.memory = {}
        self.ids = np.zeros(0, dtype=int)
        self.ever = 0

    def check(self, findings, cloud, t):
        name = cloud.path.name
        if cloud.n:
            self._check_states(findings, cloud, name)
            self._check_memory(findings, cloud, name)
        new = np.zeros(0)
        if cloud.n:
            new = cloud["weight"][~np.isin(cloud["id"], self.ids)]
            self.ids = cloud["id"].copy()
        detached = t["stability"] == 2
        tracked = np.all((t["stability"] != 5)[t.triangles], axis=1)
        around = np.any(detached[t.triangles], axis=1) & tracked
        expected = t.inside_areas()[detached].sum() / 2 + t.triangle_areas()[around].sum() / 2
        findings.require(
            "new particles weigh what detached",
            abs(new.sum() - expected) <= 1e-9 * max(expected, 1e-12),
            f"{name}: {new.sum():g} m2, not {expected:g} m2",
        )

    def _check_states(self, findings, cloud, name):
        for state, word in ((2, "stuck"), (3, "lost")):
            count = np.sum(cloud["state"] == state)
            findings.require(f"no particle is {word}", count == 0, f"{count} in {name}")
        findings.require(
            "ids are unique", len(np.unique(cloud["id"])) == cloud.n, f"not in {name}"
        )
        age = cloud.time - cloud["detachmentTime"]
        findings.require(
            "age counts from the detachment",
            np.allclose(cloud["age"], age, rtol=0, atol=1e-9 * max(1, cloud.time)),
            f"not in {name}",
        )

    def _check_memory(self, findings, cloud, name):
        order = np.argsort(cloud["id"])
        old = np.isin(cloud["id"][order], self.ids)
        findings.require(
            "particles drift to the end of the run",
            np.sum(old) == len(self.ids),
            f"{len(self.ids) - np.sum(old)} vanished before {name}",
        )
        for array in self.MEMORIES:
            values = cloud[array][order]
            before = self.memory.get(array)
            findings.require(
                "particles keep their memory",
                before is None or np.array_equal(before, values[old]),
                f"{array} changed in {name}",
            )
            self.memory[array] = values


def check_distances(findings, m, t, cells):
    """VTK's own closest points: none nearer than `distance` tells, up to 3 cells."""
    for one, other in ((m, t), (t, m)):
        if not one.n or not len(other.triangles):
            continue
        _, _, plain = Locator(other.points, other.triangles).closest(one.points)
        told = one["distance"]
        plain = np.minimum(plain, 3 * cells)
        left = one["stability"] == 3
        # The normal gate may pass over the nearest triangle, never invent a nearer.
        nearer = np.sum((told < plain - 1e-9 * cells) & ~left)
        findings.require(
            "distances are no less than VTK's", nearer == 0, f"{nearer} in {one.path.name}"
        )
        equal = np.mean(np.abs(told - plain)[~left] < 1e-9 * cells) if np.any(~left) else 1
        findings.require(
            "distances mostly equal VTK's", equal > 0.8, f"{equal:.3f} of {one.path.name}"
        )


def check_band(findings, surface, epsilon):
    inside = surface["distance"] < epsilon
    stable = surface["stability"] == 0
    left = surface["stability"] == 3
    wrong = np.sum((inside != stable) & ~left)
    findings.require("stable is nearer than epsilon", wrong == 0, f"{wrong} in {surface.path.name}")


def check_generator(findings, name, told):
    findings.require(
        "files tell what made them", told == generator(), f"{name}: {told}, not {generator()}"
    )


def check_series(findings, run):
    counts = {family: len(run.paths(family)) for family in FAMILIES}
    findings.require(
        "families have the same files", len(set(counts.values())) == 1, f"{counts}"
    )
    for family in FAMILIES:
        try:
            files = run.series(family)
        except (OSError, json.JSONDecodeError, KeyError) as error:
            findings.add("series list the files", f"{family}: {error}")
            continue
        names = [entry["name"] for entry in files]
        wanted = [f"{family}_{i:06d}.vtp" for i in range(counts[family])]
        findings.require("series list the files", names == wanted, f"{family}: {names[:3]} ...")
        times = [entry["time"] for entry in files]
        findings.require(
            "series' times rise", all(b > a for a, b in zip(times, times[1:])), family
        )
    leftover = [p.name for p in run.folder.iterdir() if p.suffix in (".tmp", ".part", "~")]
    findings.require("no temporary file is left", not leftover, f"{leftover[:3]}")


def judge(run, options, verdict):
    findings, variation, particles = Findings(), Variation(), Particles()
    check_series(findings, run)
    for name in TABLES:
        check_generator(findings, name, run.table_generator(name))
    rows = run.table("stability.dat")
    texture = Texture(run.folder / "texture.png")
    times = {family: [e["time"] for e in run.series(family)] for family in FAMILIES}
    findings.require(
        "tables have a row per time",
        len(rows["Time"]) == len(run) == len(run.table("survival.dat")["Time"]),
        f"{len(rows['Time'])} rows, {len(run)} times",
    )
    told = min(len(run), len(rows["Time"]), *(len(times[family]) for family in FAMILIES))
    for index in range(told):
        surfaces = {family: run.surface(family, index) for family in FAMILIES}
        for family, surface in surfaces.items():
            check_arrays(findings, family, surface)
            check_generator(findings, surface.path.name, surface.generator)
            variation.see(family, surface)
            findings.require(
                "files know their time",
                surface.time is not None and abs(surface.time - times[family][index]) < 1e-9,
                f"{surface.path.name}: {surface.time}, {times[family][index]} in the series",
            )
        m, t, cloud = (surfaces[family] for family in FAMILIES)
        for surface, boxes in ((m, options.boxes), (t, None)):
            if surface.n:
                check_weld(findings, surface)
                check_edges(findings, surface, boxes)
        if m.n:
            check_texture_coordinates(findings, m, texture)
        row = {k: v[index] for k, v in rows.items()}
        if m.n and t.n:
            check_row(findings, row, m, t, cloud)
        check_droplets(findings, m, run.table("droplets.dat"), row["Time"])
        check_drift(findings, m, t, row, row["Time"] - rows["Time"][index - 1] if index else 0)
        if t.n:
            particles.check(findings, cloud, t)
        if options.band and index:
            check_band(findings, m, options.band)
            check_band(findings, t, options.band)
        if options.cells and index % options.every == 0:
            check_distances(findings, m, t, options.cells)
            check_confidence(findings, m, t, row, options.cells)
    if options.varied:
        constant = variation.constant()
        findings.require("arrays vary over the run", not constant, ", ".join(constant))
    print(f"  {len(run)} times, {len(particles.ids)} particles at the end")
    findings.report(verdict)


def box_of(text):
    values = np.array([float(value) for value in text.split()])
    return values.reshape(2, 3)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case")
    parser.add_argument("--box", dest="boxes", type=box_of, action="append", default=[],
                        metavar="'X0 Y0 Z0 X1 Y1 Z1'",
                        help="a box whose sides are domain boundary (the tank, the obstacle)")
    parser.add_argument("--band", type=float, help="epsilon [m] where it is one for all")
    parser.add_argument("--cells", type=float, help="size of the cells [m]: judges `distance`")
    parser.add_argument("--every", type=int, default=10, help="judge `distance` every n times")
    parser.add_argument("--varied", action="store_true", help="no array may be constant")
    options = parser.parse_args()
    verdict = Verdict()
    judge(Run(options.case), options, verdict)
    verdict.leave()


if __name__ == "__main__":
    main()
