#!/usr/bin/env python3
"""Writes hall.toml and downlight.ies: a hall of 30 x 18 m with 60 luminaires and hanging shelves.

    python3 benchmarks/peers/scenes/hall.py
"""

import math
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS, ROWS = 10, 6
WIDTH, DEPTH, HEIGHT = 30.0, 18.0, 5.0

HEAD = f"""# A hall with 60 luminaires and hanging shelves. Written by hall.py.

[scene]
name = "Hall"

[materials.wall]
type = "diffuse"
reflectance = 0.5

[materials.ceiling]
type = "diffuse"
reflectance = 0.7

[materials.floor]
type = "diffuse"
reflectance = 0.25

[materials.shelf]
type = "diffuse"
reflectance = 0.4

[objects.hall]
shape = "box"
min = [0, 0, 0]
max = [{WIDTH}, {DEPTH}, {HEIGHT}]
material = "wall"

[objects.ceiling]
shape = "rectangle"
corner = [0, 0, {HEIGHT - 0.002}]
edge_u = [0, {DEPTH}, 0]
edge_v = [{WIDTH}, 0, 0]
material = "ceiling"

[objects.floor]
shape = "rectangle"
corner = [0, 0, 0.002]
edge_u = [{WIDTH}, 0, 0]
edge_v = [0, {DEPTH}, 0]
material = "floor"

[sensors.grid]
type = "grid"
corner = [0, 0, 0.85]
edge_u = [{WIDTH}, 0, 0]
edge_v = [0, {DEPTH}, 0]
count = [128, 128]
"""

SHELF = """
[objects.shelf_{i}_{j}]
shape = "box"
min = [{x0:g}, {y0:g}, 1.2]
max = [{x1:g}, {y1:g}, 2.2]
material = "shelf"
"""

LUMINAIRE = """
[lights.downlight_{i}_{j}]
type = "photometry"
file = "downlight.ies"
position = [{x:g}, {y:g}, {z:g}]
"""


def shelves():
    for i in range(5):
        for j in range(2):
            x0, y0 = 3.4 + 5.5 * i, 2.4 + 7.6 * j
            yield SHELF.format(i=i, j=j, x0=x0, y0=y0, x1=x0 + 0.6, y1=y0 + 5.6)


def luminaires():
    for i in range(COLUMNS):
        for j in range(ROWS):
            x, y = WIDTH * (i + 0.5) / COLUMNS, DEPTH * (j + 0.5) / ROWS
            yield LUMINAIRE.format(i=i, j=j, x=x, y=y, z=HEIGHT - 0.05)


def photometry() -> str:
    """A downlight of 4000 lm: intensity in proportion to cos^3(gamma), a little narrower across C90."""
    gammas, planes = range(0, 91, 5), range(0, 91, 15)
    rows = []
    for c in planes:
        power = 3 + math.sin(math.radians(c)) ** 2
        values = [max(math.cos(math.radians(g)), 0) ** power if g < 90 else 0 for g in gammas]
        rows.append(" ".join(f"{2500 * v:.2f}" for v in values))
    return "\n".join([
        "IESNA:LM-63-2002", "[TEST] computed by hall.py", "[MANUFAC] none", "[LUMINAIRE] downlight", "TILT=NONE",
        f"1 -1 1 {len(gammas)} {len(planes)} 1 2 0.2 0.2 0", "1 1 40",
        " ".join(map(str, gammas)), " ".join(map(str, planes)), *rows, ""])


def files() -> dict[str, str]:
    return {"hall.toml": HEAD + "".join(shelves()) + "".join(luminaires()), "downlight.ies": photometry()}


def main() -> None:
    for name, content in files().items():
        (HERE / name).write_text(content)


if __name__ == "__main__":
    main()
