"""A small room for the tests of the Python package: as a scene file, and built in code; and the program to compare with."""

import os
import subprocess
from pathlib import Path

import stilb

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STILB", str(ROOT / "build/release/stilb"))

TOML = """
[scene]
name = "room"

[materials.wall]
type = "diffuse"
reflectance = [0.7, 0.5, 0.3]

[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"

[objects.table]
shape = "polygons"
vertices = [[1, 1, 0.7], [2.6, 1, 0.7], [2.6, 1.8, 0.7], [1, 1.8, 0.7]]
faces = [[0, 1, 2], [0, 2, 3]]
material = "wall"

[lights.bulb]
type = "point"
position = [2, 1.5, 2.3]
flux = 800

[sensors.desk]
type = "grid"
corner = [1, 1, 0.75]
edge_u = [1.6, 0, 0]
edge_v = [0, 0.8, 0]
count = [4, 2]
require = { mean = 1 }

[sensors.eye]
type = "luminance"
position = [0.5, 0.5, 1.6]
directions = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]

[sensors.view]
type = "camera"
position = [0.3, 0.3, 1.6]
target = [2.5, 2, 0.8]
fov = 70
resolution = [24, 16]

[run]
seed = 7
"""


def built() -> stilb.Scene:
    """The same room in code."""
    scene = stilb.Scene("room")
    scene.run["seed"] = 7
    scene.materials["wall"] = stilb.Diffuse(reflectance=(0.7, 0.5, 0.3))
    scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
    scene.objects["table"] = stilb.Mesh([[1, 1, 0.7], [2.6, 1, 0.7], [2.6, 1.8, 0.7], [1, 1.8, 0.7]],
                                        [[0, 1, 2], [0, 2, 3]], "wall")
    scene.lights["bulb"] = stilb.PointLight(position=(2, 1.5, 2.3), flux=800)
    scene.sensors["desk"] = stilb.Grid(corner=(1, 1, 0.75), edge_u=(1.6, 0, 0), edge_v=(0, 0.8, 0), count=(4, 2),
                                       require={"mean": 1})
    scene.sensors["eye"] = stilb.Luminance(position=(0.5, 0.5, 1.6), directions=[(1, 0, 0), (0, 1, 0), (0, 0, -1)])
    scene.sensors["view"] = stilb.Camera(position=(0.3, 0.3, 1.6), target=(2.5, 2, 0.8), fov=70, resolution=(24, 16))
    return scene


def program(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
