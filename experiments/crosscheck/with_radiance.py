"""Illuminances by Radiance's rtrace and ies2rad (package `pyradiance`, which carries the programs).

Radiance is radiometric: luminance / 179 lm/W goes in as radiance [W/(sr m2)], irradiance x 179 comes out.
The 179 is a convention of Radiance (it is also in ies2rad), not the 683 lm/W of the candela. The bands are
weighted here as in Stilb, not with Radiance's own 0.265, 0.670, 0.065.
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pyradiance

from scene import LUMINANCE_WEIGHTS, Luminaire, Rectangle, Scene, Sphere, Surface

EFFICACY = 179.0  # lm/W
POINT_RADIUS = 1e-3  # m: a point light and a luminaire are spheres of this size
PROGRAMS = Path(pyradiance.__file__).parent / "bin"
LIBRARY = Path(pyradiance.__file__).parent / "lib"
# No interpolation (-aa 0), independent samples (-u+), every shadow tested, Russian roulette without an end.
SETTINGS = (
    "-I -h -u+ -aa 0 -ad 64 -as 0 -ab 200 -av 0 0 0 -aw 0 -lr 0 -lw 1e-3 "
    "-ds 0.01 -dj 1 -dt 0 -dc 1 -dr 1 -dp 4096 -faa"
).split()


def illuminance(scene: Scene, positions: np.ndarray, normals: np.ndarray, error: float, repeats: int = 256):
    """Values and standard errors [lx] at n x 3 points; stops when all relative errors are below `error`."""
    if any(_is_beyond_radiance(surface) for surface in scene.surfaces):
        return None
    with tempfile.TemporaryDirectory() as folder:
        octree = _build(scene, Path(folder))
        samples: list[np.ndarray] = []
        while True:
            samples += list(_trace(octree, positions, normals, repeats))
            value = np.mean(samples, axis=0)
            standard_error = np.std(samples, axis=0, ddof=1) / np.sqrt(len(samples))
            if np.all(standard_error <= error * value):
                return value, standard_error


def _is_beyond_radiance(surface: Surface) -> bool:
    """It has no Phong material, and what gives light there reflects nothing."""
    kind = surface.material["type"]
    return kind == "phong" or (surface.luminance is not None and kind != "black")


def _run(command: list, text: str = "") -> bytes:
    environment = {"RAYPATH": f".:{LIBRARY}", "PATH": str(PROGRAMS)}
    command = [PROGRAMS / command[0], *command[1:]]
    done = subprocess.run(command, input=text.encode(), env=environment, capture_output=True)
    if done.returncode:
        raise RuntimeError(f"{command[0].name}: {done.stderr.decode()}")
    return done.stdout


def _trace(octree: Path, positions, normals, repeats: int) -> np.ndarray:
    """repeats x n illuminances."""
    lines = "\n".join(" ".join(f"{x:.9g}" for x in row) for row in np.hstack([positions, normals]))
    out = _run(["rtrace", *SETTINGS, octree], "\n".join([lines] * repeats) + "\n")
    rgb = np.array(out.split(), float).reshape(repeats, len(positions), 3)
    return EFFICACY * rgb @ LUMINANCE_WEIGHTS


def _build(scene: Scene, folder: Path) -> Path:
    parts = ["void plastic black 0 0 5 0 0 0 0 0"]
    for i, surface in enumerate(scene.surfaces):
        parts += _surface(surface, str(i))
    for i, light in enumerate(scene.points):
        radiance = light.intensity / (np.pi * POINT_RADIUS**2) / EFFICACY
        parts += [f"void light bulb{i} 0 0 3 {_text(radiance)}"]
        parts += [f"bulb{i} sphere bulb{i}.s 0 0 4 {_text(light.position)} {POINT_RADIUS}"]
    for i, luminaire in enumerate(scene.luminaires):
        parts.append(_luminaire(luminaire, folder, f"luminaire{i}"))
    description, octree = folder / "scene.rad", folder / "scene.oct"
    description.write_text("\n".join(parts) + "\n")
    octree.write_bytes(_run(["oconv", description]))
    return octree


def _text(numbers) -> str:
    return " ".join(f"{x:.9g}" for x in np.ravel(numbers))


def _surface(surface: Surface, name: str) -> list[str]:
    shape, material = surface.shape, surface.material
    if surface.luminance is not None:
        lines, modifier = [f"void light m{name} 0 0 3 {_text(surface.luminance / EFFICACY)}"], f"m{name}"
    elif material["type"] == "black":
        lines, modifier = [], "black"
    elif material["type"] == "mirror":
        lines, modifier = [f"void mirror m{name} 0 0 3 {_text(material['reflectance'])}"], f"m{name}"
    else:
        lines, modifier = [f"void plastic m{name} 0 0 5 {_text(material['reflectance'])} 0 0"], f"m{name}"
    if isinstance(shape, Sphere):
        return lines + [f"{modifier} sphere s{name} 0 0 4 {_text(shape.center)} {shape.radius:.9g}"]
    if isinstance(shape, Rectangle):
        a, u, v = shape.corner, shape.edge_u, shape.edge_v
        polygons = [[a, a + u, a + u + v, a + v]]
    else:
        polygons = shape.vertices[shape.faces]
    sides = [f"polygon s{name}.{i} 0 0 {3 * len(p)} {_text(p)}" for i, p in enumerate(polygons)]
    return lines + [f"{modifier} {side}" for side in sides]


def _luminaire(luminaire: Luminaire, folder: Path, name: str) -> str:
    settings = ["-dm", "-t", "default", "-i", str(POINT_RADIUS), "-m", str(luminaire.dimming)]
    _run(["ies2rad", *settings, "-o", folder / name, luminaire.file])
    turn = ["-rz", str(luminaire.spin_deg), "-t", *(f"{x:.9g}" for x in luminaire.position)]
    return _run(["xform", *turn, folder / f"{name}.rad"]).decode()
