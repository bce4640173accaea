# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges a run on a sphere that LeVeque's flow deforms: how much of the time surface is
how far from the interface, and how far the interface is from the truth.

The truth is found by tracing points back to the time 0 in the exact velocity, where the
surface was a sphere.
"""

import argparse

import numpy as np

from results import Run, Verdict

CENTRE = np.array([0.35, 0.35, 0.35])
RADIUS = 0.15
PERIOD = 3.0


def velocity(x, time):
    once, twice = np.sin(np.pi * x) ** 2, np.sin(2 * np.pi * x)
    u = 2 * once[:, 0] * twice[:, 1] * twice[:, 2]
    v = -twice[:, 0] * once[:, 1] * twice[:, 2]
    w = -twice[:, 0] * twice[:, 1] * once[:, 2]
    return np.cos(np.pi * time / PERIOD) * np.column_stack([u, v, w])


def traced_back(x, time, steps=60):
    """Where these points were at the time 0, by Runge-Kutta of fourth order."""
    dt = -time / steps
    for i in range(steps):
        t = time + i * dt
        k1 = velocity(x, t)
        k2 = velocity(x + dt / 2 * k1, t + dt / 2)
        k3 = velocity(x + dt / 2 * k2, t + dt / 2)
        k4 = velocity(x + dt * k3, t + dt)
        x = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return x


def level(x, time):
    return np.linalg.norm(traced_back(x, time) - CENTRE, axis=1) - RADIUS


def distance_from_truth(x, time, step):
    """To first order: level over its gradient, taken over twice the step."""
    gradient = np.column_stack(
        [
            (level(x + offset, time) - level(x - offset, time)) / (2 * step)
            for offset in step * np.eye(3)
        ]
    )
    return np.abs(level(x, time)) / np.linalg.norm(gradient, axis=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case")
    parser.add_argument("--cells", type=int, required=True, help="along each side of the cube")
    parser.add_argument("--detached", nargs=2, type=float, action="append", default=[],
                        metavar=("CELLS", "SHARE"),
                        help="allowed share of T farther from M than so many cells")
    parser.add_argument("--rms", type=float, help="allowed error of M [cells]")
    options = parser.parse_args()

    run, verdict, h = Run(options.case), Verdict(), 1 / options.cells
    t, m = run.surface("timeSurface", 1), run.surface("interface", 1)
    told = " ".join(f"{share:.3%}" for share in (t.share_beyond(c * h) for c in (0.1, 0.25, 0.5, 1)))
    print(f"  detached beyond 0.1, 0.25, 0.5, 1 cells: {told}")
    errors = np.minimum(distance_from_truth(m.points, m.time, 0.05 * h) / h, 1)
    rms = np.sqrt(np.average(errors**2, weights=m.point_areas()))
    print(f"  error of M: rms {rms:.4f}, largest {errors.max():.4f} cells")
    verdict.check("two times", len(run) == 2, f"{len(run)}")
    for cells, allowed in options.detached:
        verdict.at_most(f"detached beyond {cells:g} cells", t.share_beyond(cells * h), allowed)
    if options.rms is not None:
        verdict.at_most("error of the interface, rms [cells]", rms, options.rms)
    verdict.leave()


if __name__ == "__main__":
    main()
