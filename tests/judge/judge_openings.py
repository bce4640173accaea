# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges what enters and leaves: judge_openings.py CASE level|ball

level: a plane with the normal (0.05 0.07 1), carried 0.1375 m at each time along x through a
box of 1.25 x 1 x 1 m3. ball: a sphere of radius 0.24 that goes out of it as a whole."""

import sys

import numpy as np

from results import Run, Verdict

run, verdict = Run(sys.argv[1]), Verdict()
rows = run.table("stability.dat")
first = {name: values[1:] for name, values in rows.items()}
verdict.at_most("attached area [m2]", rows["attachedArea"].max(), 0)
detached = rows["detachedNearWalls"] + rows["detachedElsewhere"]

if sys.argv[2] == "level":
    exact = 0.1375 * np.sqrt(1 + 0.05**2 + 0.07**2)
    for name in ("enteredArea", "leftArea"):
        verdict.at_most(f"{name}: error", np.abs(first[name] / exact - 1).max(), 0.01)
    verdict.at_most("detached area [m2]", detached.max(), 0)
    for name in ("stableFraction", "keptFraction"):
        verdict.at_least(name, rows[name].min(), 1 - 1e-9)
    m = run.surface("interface", len(run) - 1)
    came = m["fromOutside"] == 1
    # All that came in since the start, without p, and nothing else.
    front = 3 * 0.1375
    verdict.at_most("what came in: x [m]", m.points[came, 0].max(), front + 0.03)
    verdict.at_least("the rest: x [m]", m.points[~came, 0].min(), front - 0.13)
    behind = m.points[:, 0] < front - 0.13
    verdict.check("what came in has no p", not m.has_p()[behind].any(), "")
    verdict.check("some entered just now", np.any(m["stability"] == 4), "")
else:
    area = 4 * np.pi * 0.24**2
    verdict.at_most("area that left: error", abs(rows["leftArea"].sum() / area - 1), 0.02)
    verdict.at_most("detached area [m2]", detached.max(), 2e-3 * area)
    verdict.at_most("keptFraction when all is gone", rows["keptFraction"][-1], 0)
    verdict.at_least("keptFraction before", rows["keptFraction"][0], 1)
    verdict.at_most("stableFraction of nothing", rows["stableFraction"][-1], 0)
verdict.leave()
