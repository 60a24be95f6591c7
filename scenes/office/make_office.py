#!/usr/bin/env python3
"""Writes the example office: office.obj here, and the luminaire's files through make_luminaire.py.

Metres, z up; the room is 0 <= x <= 5.4 (window to door), 0 <= y <= 4.2, 0 <= z <= 2.8. Every solid is
closed and faces outwards (the room's shell faces inwards), and solids never touch: they stand a
millimetre or more apart, so that no two surfaces coincide. Groups of the OBJ file are the things in
the room, its material names are those of office.toml. Python's standard library only; the same bytes
every time.
"""

import random
from collections import defaultdict
from math import cos, pi, sin
from pathlib import Path

import make_luminaire
from solids import (box, changed, cushion, cylinder, lathe, loft, moved, plate, polygon, skin, tilted, tray,
                    turned)

LENGTH, WIDTH, HEIGHT = 5.4, 4.2, 2.8
TILE = 0.6
CEILING_TILE = (2.782, 2.797)  # underside and upper side of the hung tiles
LUMINAIRE_TILES = {(2, 1), (6, 1), (2, 5), (6, 5)}
GRILLE_TILE = (7, 3)
WINDOW = {"y": (0.9, 3.3), "z": (0.95, 2.25), "depth": 0.22}
DOOR = {"y": (0.4, 1.3), "z": (0.01, 2.06), "depth": 0.06}
DESK = {"width": 1.6, "depth": 0.8, "underside": 0.715, "top": 0.74}
DESK_BLOCK = (2.5, 2.1)  # the two desks stand back to back about this point
ON_DESK = DESK["top"] + 0.0015


class Office:
    """Solids by group and material, in the order in which they were added."""

    def __init__(self):
        self.groups = defaultdict(list)

    def add(self, group, material, solid):
        self.groups[group].append((material, solid))

    def triangle_count(self):
        return sum(len(solid) for solids in self.groups.values() for _, solid in solids)

    def obj(self):
        lines = [
            "# Two-desk office of the Stilb project, written by make_office.py. Metres, z up.",
            f"# {self.triangle_count()} triangles; every group is closed; the room's shell faces inwards.",
        ]
        vertex_count = 0
        for group, solids in self.groups.items():
            index, faces = {}, []
            for material, solid in solids:
                faces.append(f"usemtl {material}")
                for triangle in solid:
                    numbers = [index.setdefault(written(p), vertex_count + len(index) + 1) for p in triangle]
                    faces.append("f {} {} {}".format(*numbers))
            vertex_count += len(index)
            lines += [f"g {group}", *(f"v {point}" for point in index), *faces]
        return "\n".join(lines) + "\n"


def written(point):
    """Coordinates to a hundredth of a millimetre; adding 0.0 makes a negative zero positive."""
    return " ".join(f"{round(coordinate, 5) + 0.0:.5f}" for coordinate in point)


def add_room(office):
    """The shell: one closed surface, seen from inside, with recesses for the window and the door."""
    def corner(x, y, z):
        return (x * LENGTH, y * WIDTH, z * HEIGHT)

    def ring(x, opening):
        (y0, y1), (z0, z1) = opening["y"], opening["z"]
        return [(x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)]

    floor = [corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)]
    office.add("room", "carpet", polygon(floor))
    office.add("room", "ceiling", polygon([(x, y, HEIGHT) for x, y, _ in floor[::-1]]))
    office.add("room", "wall", polygon([corner(0, 0, 0), corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0)]))
    office.add("room", "wall", polygon([corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)]))
    for x, opening, outwards, back_material in [(0, WINDOW, -1, "glass"), (1, DOOR, 1, "wall")]:
        outer = [corner(x, 0, 0), corner(x, 1, 0), corner(x, 1, 1), corner(x, 0, 1)]
        rings = [outer, ring(x * LENGTH, opening), ring(x * LENGTH + outwards * opening["depth"], opening)]
        if x:  # seen from inside, counterclockwise is the other way round here
            rings = [points[::-1] for points in rings]
        office.add("room", "wall", skin(rings))
        office.add("room", back_material, polygon(rings[-1]))


def add_ceiling(office):
    bottom, top = CEILING_TILE
    for i in range(round(LENGTH / TILE)):
        for j in range(round(WIDTH / TILE)):
            low = (i * TILE + 0.002, j * TILE + 0.002)
            high = ((i + 1) * TILE - 0.002, (j + 1) * TILE - 0.002)
            if (i, j) in LUMINAIRE_TILES:
                add_luminaire(office, low, high)
            elif (i, j) == GRILLE_TILE:
                add_grille(office, low, high)
            else:
                office.add("ceiling_tiles", "ceiling", box((*low, bottom), (*high, top)))


def ceiling_frame(low, high, rim):
    """A frame of the thickness of a tile, its recess open to below."""
    bottom, top = CEILING_TILE
    frame = tray((low[0], -high[1], -top), (high[0], -low[1], -bottom), rim, 0.012)
    return tilted(frame, 180)


def add_luminaire(office, low, high):
    """The housing only: the light comes from the photometry light one centimetre below it."""
    office.add("luminaires", "enamel", ceiling_frame(low, high, 0.02))
    bottom = CEILING_TILE[0]
    office.add("luminaires", "diffuser", box((low[0] + 0.022, low[1] + 0.022, bottom + 0.004),
                                             (high[0] - 0.022, high[1] - 0.022, bottom + 0.008)))


def add_grille(office, low, high):
    office.add("grille", "enamel", ceiling_frame(low, high, 0.03))
    bottom = CEILING_TILE[0]
    for k in range(13):
        y = low[1] + 0.046 + k * 0.0408
        slat = box((low[0] + 0.032, -0.008, -0.001), (high[0] - 0.032, 0.008, 0.001))
        office.add("grille", "enamel", moved(tilted(slat, 20), 0, y, bottom + 0.006))


def add_joinery(office):
    """Skirting, window frame and sill, door."""
    low, high, thickness = 0.002, 0.062, 0.012
    for y in (0.002, WIDTH - 0.002 - thickness):
        office.add("skirting", "paint", box((0.002, y, low), (LENGTH - 0.002, y + thickness, high)))
    ends = (0.016, WIDTH - 0.016)
    office.add("skirting", "paint", box((0.002, ends[0], low), (0.002 + thickness, ends[1], high)))
    for y0, y1 in [(ends[0], DOOR["y"][0] - 0.05), (DOOR["y"][1] + 0.05, ends[1])]:
        x = LENGTH - 0.002 - thickness
        office.add("skirting", "paint", box((x, y0, low), (x + thickness, y1, high)))

    (y0, y1), (z0, z1) = WINDOW["y"], WINDOW["z"]
    y0, y1, z0, z1 = y0 + 0.002, y1 - 0.002, z0 + 0.002, z1 - 0.002
    bar, middle = 0.06, (y0 + y1) / 2
    uprights = [y0, middle - bar / 2, y1 - bar]
    for y in uprights:
        office.add("window", "paint", box((-0.2, y, z0 + bar + 0.001), (-0.14, y + bar, z1 - bar - 0.001)))
    for z in (z0, z1 - bar):
        office.add("window", "paint", box((-0.2, y0, z), (-0.14, y1, z + bar)))
    office.add("window", "paint", box((-0.138, y0, z0), (0.04, y1, z0 + 0.02)))
    handle = box((-0.138, middle - 0.01, 1.5), (-0.12, middle + 0.01, 1.62))
    office.add("window", "metal", handle)

    (y0, y1), (z0, z1) = DOOR["y"], DOOR["z"]
    leaf = box((LENGTH + 0.01, y0 + 0.003, z0 + 0.003), (LENGTH + 0.05, y1 - 0.003, z1 - 0.003))
    office.add("door", "door", leaf)
    spindle = turned(tilted(cylinder(0.01, 0.0, 0.05, 16), 90), 270)  # along -x
    office.add("door", "metal", moved(spindle, LENGTH + 0.008, y1 - 0.08, 1.05))
    lever = tilted(cylinder(0.009, 0.0, 0.12, 16), 90)
    office.add("door", "metal", moved(lever, LENGTH - 0.053, y1 - 0.07, 1.05))


def add_radiator(office):
    for k in range(16):
        column = cylinder(0.02, 0.151, 0.749, 8)
        office.add("radiator", "enamel", moved(column, 0.1, 1.3 + 0.105 * k))
    for z in (0.11, 0.75):
        office.add("radiator", "enamel", box((0.075, 1.27, z), (0.125, 2.905, z + 0.04)))


def chair():
    """An office chair about the z axis, facing +y: pairs of material and solid."""
    parts = [("dark_plastic", cylinder(0.04, 0.07, 0.115, 16))]
    for k in range(5):
        angle = 72 * k + 18
        spoke = loft([[(r, -w, z0), (r, w, z0), (r, w, z1), (r, -w, z1)]
                      for r, w, z0, z1 in [(0.046, 0.025, 0.075, 0.11), (0.18, 0.022, 0.068, 0.1),
                                           (0.31, 0.016, 0.06, 0.082)]])
        parts.append(("dark_plastic", turned(spoke, angle)))
        wheel = moved(tilted(cylinder(0.025, -0.02, 0.02, 10), 90), 0.28, 0, 0.028)
        parts.append(("dark_plastic", turned(wheel, angle)))
    parts += [
        ("metal", cylinder(0.025, 0.117, 0.4, 12)),
        ("dark_plastic", box((-0.1, -0.08, 0.402), (0.1, 0.08, 0.436))),
        ("dark_plastic", box((-0.03, -0.25, 0.404), (0.03, -0.082, 0.428))),
        ("dark_plastic", box((-0.03, -0.278, 0.404), (0.03, -0.252, 0.8))),
        ("fabric", moved(cushion(0.48, 0.46, 0.076, 0.1, 0.03), 0, 0, 0.476)),
    ]
    back = tilted(cushion(0.44, 0.5, 0.05, 0.1, 0.02), 90)
    bent = changed(back, lambda p: (p[0], p[1] + 0.5 * p[0] ** 2, p[2]))
    parts.append(("fabric", moved(bent, 0, -0.222, 0.81)))
    for side in (-1, 1):
        bar = box((min(0.104 * side, 0.3 * side), -0.02, 0.408), (max(0.104 * side, 0.3 * side), 0.02, 0.43))
        post = box((0.29 * side - 0.012, -0.02, 0.432), (0.29 * side + 0.012, 0.02, 0.679))
        pad = moved(cushion(0.07, 0.24, 0.026, 0.03, 0.01, steps=2, layers=2), 0.29 * side, 0.02, 0.694)
        parts += [("dark_plastic", bar), ("dark_plastic", post), ("dark_plastic", pad)]
    return parts


def desk():
    """A desk with its front left corner at the origin; who sits there looks to +y."""
    width, depth, under = DESK["width"], DESK["depth"], DESK["underside"]
    top = moved(plate(width, depth, 0.03, under, DESK["top"]), width / 2, depth / 2)
    parts = [("desk", top)]
    for x in (0.08, width - 0.08):
        for y in (0.08, depth - 0.08):
            parts.append(("metal", box((x - 0.025, y - 0.025, 0.014), (x + 0.025, y + 0.025, under - 0.001))))
            parts.append(("dark_plastic", moved(cylinder(0.02, 0.001, 0.013, 8), x, y)))
        parts.append(("metal", box((x - 0.02, 0.107, 0.65), (x + 0.02, depth - 0.107, 0.7))))
    parts.append(("desk", box((0.107, depth - 0.09, 0.3), (width - 0.107, depth - 0.072, 0.7))))
    parts += pedestal(0.16, 0.14)
    return parts


def pedestal(x, y):
    """Three drawers under the desk, fronts to -y."""
    parts = [("cabinet", box((x, y + 0.022, 0.04), (x + 0.42, y + 0.56, 0.6)))]
    for k in range(3):
        z = 0.045 + 0.185 * k
        parts.append(("cabinet", box((x, y, z), (x + 0.42, y + 0.02, z + 0.182))))
        parts.append(("metal", box((x + 0.13, y - 0.014, z + 0.13), (x + 0.29, y - 0.002, z + 0.142))))
    for dx in (0.05, 0.37):
        for dy in (0.06, 0.52):
            parts.append(("dark_plastic", moved(cylinder(0.018, 0.002, 0.039, 8), x + dx, y + dy)))
    return parts


def monitor():
    """On the desk, its middle at x = 0; the screen faces -y."""
    housing = tilted(tray((-0.31, -0.185, -0.03), (0.31, 0.185, 0), 0.008, 0.006), 90)
    glass = tilted(box((-0.3, -0.175, -0.005), (0.3, 0.175, -0.002)), 90)
    neck = box((-0.03, 0.032, ON_DESK + 0.008), (0.03, 0.05, 1.1))
    base = moved(plate(0.26, 0.2, 0.02, ON_DESK, ON_DESK + 0.0065), 0, 0.03)
    return [("dark_plastic", moved(housing, 0, 0, 1.06)), ("screen", moved(glass, 0, 0, 1.06)),
            ("metal", neck), ("metal", base)]


def keyboard():
    """A flat keyboard, front left corner at the origin: it stays below the working plane."""
    parts = [("dark_plastic", box((0, 0, ON_DESK), (0.44, 0.115, ON_DESK + 0.0025)))]
    pitch = 0.0215
    for row in range(5):
        widths = [1, 1, 1] + [1.25] * 10 + [1.5] * 3 if row else [1.25] * 4 + [7.5] + [1.5] * 5
        x = 0.005
        for width in widths:
            low = (x + 0.001, 0.005 + pitch * row, ON_DESK + 0.0035)
            high = (x + width * pitch - 0.001, 0.005 + pitch * (row + 1) - 0.002, ON_DESK + 0.0063)
            parts.append(("key", box(low, high)))
            x += width * pitch
    return parts


def small_things():
    """Mouse, mug and papers, where they cover no point of the 16 x 8 working plane."""
    mouse = moved(cushion(0.06, 0.1, 0.03, 0.028, 0.015, steps=3, layers=2), 1.2, 0.22, ON_DESK + 0.015)
    mug = lathe([(0, 0), (0.034, 0), (0.04, 0.01), (0.04, 0.095),
                 (0.036, 0.095), (0.036, 0.012), (0.03, 0.006), (0, 0.006)], 16)
    sheet = turned(box((-0.105, -0.148, 0), (0.105, 0.148, 0.003)), 8)
    return [("dark_plastic", mouse), ("ceramic", moved(mug, 0.3, 0.6, ON_DESK)),
            ("paper", moved(sheet, 0.28, 0.3, ON_DESK)),
            ("paper", moved(turned(sheet, 80), 1.35, 0.55, ON_DESK))]


def add_workplaces(office):
    """Two of the same, back to back with a gap of one centimetre; the second is the first, turned round."""
    for name, turn, chair_turn in [("a", 0, 12), ("b", 180, -20)]:
        def place(solid, to_desk=(-DESK["width"] / 2, -0.005 - DESK["depth"])):
            return moved(turned(moved(solid, *to_desk), turn), *DESK_BLOCK)

        def add(thing, parts, dx=0.0, dy=0.0):
            for material, solid in parts:
                office.add(f"{thing}_{name}", material, place(moved(solid, dx, dy)))

        add("desk", desk())
        add("monitor", monitor(), 0.8, 0.56)
        add("keyboard", keyboard(), 0.58, 0.15)
        add("desk_things", small_things())
        add("chair", [(material, turned(solid, chair_turn)) for material, solid in chair()], 0.82, -0.33)


def add_shelf(office):
    """Against the wall y = 4.2, with books; the dice are always the same."""
    x0, x1, y0, y1, height = 3.4, 4.6, 3.88, 4.18, 1.9
    side = 0.02
    office.add("shelf", "wood", box((x0, y0, 0.002), (x0 + side, y1, height)))
    office.add("shelf", "wood", box((x1 - side, y0, 0.002), (x1, y1, height)))
    office.add("shelf", "wood", box((x0 + side + 0.001, y1 - 0.008, 0.05), (x1 - side - 0.001, y1, height)))
    boards = [0.05 + 0.366 * k for k in range(6)]
    for z in boards:
        office.add("shelf", "wood",
                   box((x0 + side + 0.001, y0 + 0.005, z - side), (x1 - side - 0.001, y1 - 0.009, z)))
    dice = random.Random(1908)
    colours = ["book_red", "book_blue", "book_green", "paper", "book_dark"]
    for z in boards[:-1]:
        x = x0 + side + 0.004
        end = x1 - side - 0.004 - 0.4 * dice.random()
        while True:
            thickness = 0.03 + 0.06 * dice.random()
            book_height = 0.21 + 0.1 * dice.random()
            depth = 0.15 + 0.08 * dice.random()
            colour = colours[int(dice.random() * len(colours))]
            if x + thickness > end:
                break
            back = y1 - 0.011
            book = box((x, back - depth, z + 0.001), (x + thickness, back, z + book_height))
            office.add("books", colour, book)
            x += thickness + 0.0015


def add_cabinet(office):
    """Against the wall x = 5.4, with two doors and a plinth."""
    x0, x1, y0, y1, height = 4.96, 5.38, 2.2, 3.4, 1.1
    office.add("cabinet", "dark_plastic", box((x0 + 0.04, y0 + 0.02, 0.002), (x1, y1 - 0.02, 0.069)))
    office.add("cabinet", "cabinet", box((x0 + 0.022, y0, 0.07), (x1, y1, height)))
    middle = (y0 + y1) / 2
    for low, high, handle in [(y0, middle - 0.0015, middle - 0.06), (middle + 0.0015, y1, middle + 0.06)]:
        office.add("cabinet", "cabinet", box((x0, low, 0.072), (x0 + 0.02, high, height - 0.002)))
        bar = moved(cylinder(0.008, 0.55, 0.75, 12), x0 - 0.012, handle)
        office.add("cabinet", "metal", bar)


def add_on_walls(office):
    """Whiteboard on the wall y = 0, clock on the wall x = 5.4."""
    x0, x1, z0, z1 = 1.6, 3.4, 0.95, 2.05
    office.add("whiteboard", "whiteboard", box((x0, 0.006, z0), (x1, 0.016, z1)))
    for z in (z0 - 0.021, z1 + 0.001):
        office.add("whiteboard", "metal", box((x0 - 0.021, 0.004, z), (x1 + 0.021, 0.02, z + 0.02)))
    for x in (x0 - 0.021, x1 + 0.001):
        office.add("whiteboard", "metal", box((x, 0.004, z0), (x + 0.02, 0.02, z1)))
    office.add("whiteboard", "metal", box((2.2, 0.021, z0 - 0.019), (2.8, 0.08, z0 - 0.015)))
    for k, colour in enumerate(["book_red", "book_blue", "book_dark"]):
        pen = turned(tilted(cylinder(0.008, -0.06, 0.06, 12), 90), 90)
        office.add("whiteboard", colour, moved(pen, 2.35 + 0.16 * k, 0.05, z0 - 0.005))

    face = lathe([(0, 0), (0.14, 0), (0.15, 0.01), (0.15, 0.035),
                  (0.14, 0.035), (0.138, 0.028), (0, 0.028)], 20)
    standing = turned(tilted(face, 90), 270)  # its axis points to -x, into the room
    office.add("clock", "enamel", moved(standing, LENGTH - 0.003, 2.8, 2.1))


def add_on_floor(office):
    """Waste bin by the desks, plant in the corner by the window."""
    bin_profile = [(0, 0.003), (0.12, 0.003), (0.15, 0.32), (0.145, 0.32), (0.116, 0.008), (0, 0.008)]
    office.add("waste_bin", "dark_plastic", moved(lathe(bin_profile, 28), 3.65, 1.0))

    pot = lathe([(0, 0.002), (0.13, 0.002), (0.16, 0.3), (0.17, 0.3),
                 (0.17, 0.34), (0.155, 0.34), (0.145, 0.28), (0, 0.28)], 24)
    soil = lathe([(0, 0.282), (0.14, 0.282), (0.143, 0.3), (0, 0.31)], 24)
    office.add("plant", "ceramic", moved(pot, 0.45, 3.75))
    office.add("plant", "soil", moved(soil, 0.45, 3.75))
    for circle, (count, radius, height, lean) in enumerate([(3, 0.03, 0.75, 0.03), (7, 0.075, 0.62, 0.12),
                                                            (11, 0.115, 0.48, 0.2)]):
        for k in range(count):
            leaf = turned(snake_plant_leaf(radius, height * (1 - 0.12 * (k % 3)), lean),
                          360 * k / count + 11 * circle)
            office.add("plant", "leaf", moved(leaf, 0.45, 3.75, 0.315))


def snake_plant_leaf(radius, height, lean):
    """A stiff upright blade that leans away from the z axis: rings of four points up to a tip."""
    rings = []
    for s in (0.0, 0.3, 0.6, 0.85):
        half_width = 0.018 * (1 + 0.8 * sin(pi * s)) * (1 - 0.5 * s)
        thickness = 0.004 * (1 - 0.6 * s)
        x = radius + lean * s * s
        rings.append([(x + thickness * cos(a), half_width * sin(a), height * s)
                      for a in [pi * k / 2 for k in range(4)]])
    return loft(rings + [[(radius + lean, 0.0, height)]])


def make_office():
    office = Office()
    for add in (add_room, add_ceiling, add_joinery, add_radiator, add_workplaces, add_shelf, add_cabinet,
                add_on_walls, add_on_floor):
        add(office)
    return office


def main(folder):
    office = make_office()
    (folder / "office.obj").write_text(office.obj())
    print(f"office.obj: {office.triangle_count()} triangles")
    make_luminaire.main(folder)


if __name__ == "__main__":
    main(Path(__file__).resolve().parent)
