# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges that a sphere which goes out of the domain leaves, and nothing comes back by it."""

import sys

from results import Run, Verdict

run, verdict = Run(sys.argv[1]), Verdict()
t = run.surface("timeSurface", len(run) - 1)
gone = t.point_areas()[t["stability"] == 3].sum() / t.point_areas().sum()
verdict.at_least("share of T that leaves at the last step", gone, 0.01)
verdict.at_most("largest x of T [m]", t.points[:, 0].max(), 1 + 1e-9)
verdict.leave()
