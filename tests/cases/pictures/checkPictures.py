# SPDX-License-Identifier: GPL-3.0-or-later
"""checkPictures.py RESULTS OPAQUE HALF DEFAULT BARE

Compares regions of the pictures with what geometry, texture and light predict. Folders
of pictures: from the front with opacity 1 and 0.5, with the default view, and of results
without a case around them."""
import pathlib
import sys

import numpy as np

import sphere
from sphere import verdict

WIDTH, HEIGHT = 1280, 960
SCENE = WIDTH - 281  # the legend is to the right of it
TANGENT = np.tan(np.radians(14))  # of half the view angle
DISTANCE = 1.06 * (0.5 + 0.5 / TANGENT)  # fits the unit cube seen from the front
SCALE = 0.5 * HEIGHT / TANGENT
EYE = np.array([0.5, 0.5 - DISTANCE, 0.5])
LIGHTS = (((-0.4, 1.0, 0.6), 0.75), ((0.9, 1.0, 0.1), 0.4))  # right, towards us, up
AMBIENT, DIFFUSE = 0.62, 0.42
TOLERANCE = 4


def pixel(x):
    """Column and row (from below) where a point is seen."""
    depth = DISTANCE + x[1] - 0.5
    return 0.5 * SCENE + SCALE * (x[0] - 0.5) / depth, 0.5 * HEIGHT + SCALE * (x[2] - 0.5) / depth


def region(picture, x, half=8):
    column, row = (int(round(c)) for c in pixel(x))
    return picture[row - half : row + half, column - half : column + half].reshape(-1, 3)


def rays(x, half=8):
    column, row = (int(round(c)) for c in pixel(x))
    i, j = np.meshgrid(np.arange(column - half, column + half), np.arange(row - half, row + half))
    d = np.stack(
        [(i + 0.5 - 0.5 * SCENE) / SCALE, np.ones(i.shape), (j + 0.5 - 0.5 * HEIGHT) / SCALE], axis=-1
    ).reshape(-1, 3)
    return d / np.linalg.norm(d, axis=1)[:, None]


def layer(texture, direction, side, opacity):
    """Colour and opacity of the sphere where the rays enter (-1) or leave it (1)."""
    to_eye = EYE - sphere.CENTRE
    b = direction @ to_eye
    t = -b + side * np.sqrt(b * b - to_eye @ to_eye + sphere.RADIUS**2)
    normal = (to_eye + t[:, None] * direction) / sphere.RADIUS
    u = np.arctan2(normal[:, 1], normal[:, 0]) / (2 * np.pi) % 1
    v = np.arcsin(normal[:, 2]) / np.pi + 0.5
    index = (sphere.TEXTURE * sphere.parameter(u, v)).astype(int)
    cosine = np.abs(np.einsum("ij,ij->i", normal, direction))
    seen = normal * -side  # the side that faces the viewer
    light = np.full(len(u), AMBIENT)
    for (right, towards, up), intensity in LIGHTS:
        to_light = np.array([right, -towards, up]) / np.linalg.norm([right, towards, up])
        light += DIFFUSE * intensity * np.maximum(0, seen @ to_light)
    alpha = 1 + cosine * (opacity - 1)
    return np.minimum(255, texture[index[:, 1], index[:, 0]] * light[:, None]), alpha[:, None]


def compare(name, measured, expected):
    difference = np.abs(measured.mean(axis=0) - expected)
    verdict(
        name,
        difference.max() <= TOLERANCE,
        f"mean colour {measured.mean(axis=0).round(1)}, expected {np.round(expected, 1)}",
    )


def check_sphere(texture, opaque, half):
    # Two places: a direction of p mirrored or turned would show another colour.
    for name, x in (
        ("left", sphere.CENTRE + sphere.RADIUS * np.array([-0.5, -0.8, 0.33])),
        ("right", sphere.CENTRE + sphere.RADIUS * np.array([0.5, -0.8, -0.33])),
    ):
        direction = rays(x)
        front, _ = layer(texture, direction, -1, 1)
        compare(f"opaque texture, {name}", region(opaque, x), front.mean(axis=0))
        front, a = layer(texture, direction, -1, 0.5)
        back, b = layer(texture, direction, 1, 0.5)
        peeled = a * front + (1 - a) * (b * back + (1 - b) * 255)
        compare(f"two translucent layers, {name}", region(half, x), peeled.mean(axis=0))
    top = sphere.CENTRE + sphere.RADIUS * np.array([0, -np.cos(1.2), np.sin(1.2)])
    compare("attached is black", region(opaque, top, 3), np.zeros(3))


def check_surroundings(later, empty):
    cloud = region(later, np.array([0.8, 0.4, 0.7]), 20).mean(axis=0)
    verdict("particles are red", cloud[0] > 180 and cloud[1:].max() < 90, cloud)
    compare("who left is not drawn", region(later, np.array([0.95, 0.5, 0.1])), [255] * 3)
    grey = region(empty, np.array([0.5, 0.375, 0.12]), 20).mean(axis=0)
    verdict("the obstacle is grey", np.ptp(grey) < 2 and 120 < grey[0] < 230, grey)
    compare("an empty interface", region(empty, sphere.CENTRE), [255] * 3)
    # The box is drawn where the domain is, though nothing else reaches there.
    column, row = (int(round(c)) for c in pixel(np.array([0.3, 0.0, 1.0])))
    line = empty[row - 3 : row + 4, column - 20 : column + 20].min(axis=0).max()
    verdict("the domain has an outline", line < 200, line)


def check_legend(texture, picture, bare):
    panel = picture[:, int(np.ceil(SCENE)) + 2 :]
    square = panel[480:660, 40:220].reshape(-1, 3)
    compare("the legend shows the texture", square, texture[100:-90, 90:-90].mean(axis=(0, 1)))
    verdict("the legend tells the time", (panel[895:935].max(axis=2) < 100).sum() > 100, "no text")
    compare("the legend explains what entered", panel[311:321, 28:39].reshape(-1, 3), [120, 80, 40])
    wall = slice(223, 232), slice(28, 39)
    verdict("the legend explains walls", panel[wall].max() < 215, panel[wall].mean())
    bare = bare[:, int(np.ceil(SCENE)) + 2 :]
    verdict("without a mesh it has no wall", bare[wall].min() > 235, bare[wall].mean())


def check_default(picture):
    scene = picture[:, : int(SCENE) - 2].min(axis=2) < 250
    columns, rows = np.flatnonzero(scene.any(axis=0)), np.flatnonzero(scene.any(axis=1))
    margins = columns[0], int(SCENE) - 2 - columns[-1], rows[0], HEIGHT - rows[-1]
    verdict("the whole domain is seen", min(margins) > 4, margins)
    filled = max(np.ptp(columns) / SCENE, np.ptp(rows) / HEIGHT)
    verdict("it fills the picture", filled > 0.85, filled)


def main():
    results, opaque, half, default, bare = (pathlib.Path(a) for a in sys.argv[1:6])
    texture = sphere.png(results / "texture.png")
    first, second, third = (sphere.png(opaque / f"view_00000{i}.png") for i in range(3))
    verdict("pictures have the size asked for", first.shape == (HEIGHT, WIDTH, 3), first.shape)
    check_sphere(texture, first, sphere.png(half / "view_000000.png"))
    check_surroundings(second, third)
    check_legend(texture, third, sphere.png(bare / "view_000002.png"))
    check_default(sphere.png(default / "view_000002.png"))
    sys.exit(sphere.failed)


main()
