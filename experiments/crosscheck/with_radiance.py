"""Illuminances and luminances by Radiance's rtrace and ies2rad (package `pyradiance`, which carries the programs).

Radiance is radiometric: luminance / 179 lm/W goes in as radiance [W/(sr m2)], irradiance x 179 comes out.
The 179 is a convention of Radiance (it is also in ies2rad), not the 683 lm/W of the candela. The bands are
weighted here as in Stilb, not with Radiance's own 0.265, 0.670, 0.065.
"""

import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import pyradiance

from rays import BATCHES, Rays, fixed_rays, until
from scene import LUMINANCE_WEIGHTS, Luminaire, Rectangle, Scene, Sphere, Surface

EFFICACY = 179.0  # lm/W
POINT_RADIUS = 1e-3  # m: a point light and a luminaire are spheres of this size
PROGRAMS = Path(pyradiance.__file__).parent / "bin"
LIBRARY = Path(pyradiance.__file__).parent / "lib"
# No interpolation (-aa 0), independent samples (-u+), every shadow tested, Russian roulette without an end.
SETTINGS = (
    "-h -u+ -aa 0 -as 0 -ab 200 -av 0 0 0 -aw 0 -lr 0 -lw 1e-3 "
    "-ds 0.01 -dj 1 -dt 0 -dc 1 -dr 1 -dp 4096 -fff"
).split()


def illuminance(scene: Scene, positions: np.ndarray, normals: np.ndarray, error: float, repeats: int = 8):
    """Values and standard errors [lx] at n x 3 points; stops when all relative errors are below `error`."""
    rays = fixed_rays(positions, normals)
    return _measure(scene, error, ["-I", "-ad", "64"], lambda seed: rays.draw(seed, BATCHES * repeats), np.max)


def luminance(scene: Scene, rays: Rays, error: float, repeats: int = 64):
    """The same for luminances [cd/m2], stopped by the mean relative error."""
    return _measure(scene, error, ["-ad", "4"], lambda seed: rays.draw(seed, BATCHES * repeats), np.mean)


def _measure(scene: Scene, error: float, settings: list[str], draw_rays, overall):
    if any(_is_beyond_radiance(surface) for surface in scene.surfaces):
        return None
    with tempfile.TemporaryDirectory() as folder:
        octree = _build(scene, Path(folder))
        return until(error, lambda seed: _trace(octree, settings, *draw_rays(seed)), overall)


def _is_beyond_radiance(surface: Surface) -> bool:
    """It has no Phong and no GGX, and what gives light there reflects nothing."""
    kind = surface.material["type"]
    return kind in ("phong", "rough", "plastic", "frosted") or (surface.luminance is not None and kind != "black")


def run(command: list, data: bytes = b"") -> bytes:
    environment = {"RAYPATH": f".:{LIBRARY}", "PATH": str(PROGRAMS)}
    command = [PROGRAMS / command[0], *command[1:]]
    done = subprocess.run(command, input=data, env=environment, capture_output=True)
    if done.returncode:
        raise RuntimeError(f"{command[0].name}: {done.stderr.decode()}")
    return done.stdout


def _trace(octree: Path, settings: list[str], origins: np.ndarray, directions: np.ndarray) -> list[np.ndarray]:
    """Means of BATCHES parts of n x many x 3 rays: n values each."""
    time.sleep(1)  # rtrace takes its seed from the clock, in seconds
    rays = np.concatenate([origins, directions], axis=2).astype(np.float32)
    rgb = np.frombuffer(run(["rtrace", *SETTINGS, *settings, octree], rays.tobytes()), np.float32)
    means = rgb.reshape(len(origins), BATCHES, -1, 3).mean(axis=2, dtype=float)
    return list((EFFICACY * means @ LUMINANCE_WEIGHTS).T)


def _build(scene: Scene, folder: Path) -> Path:
    parts = ["void plastic black 0 0 5 0 0 0 0 0"]
    # Shadow rays of a `light` do not pass glass, and other rays do not count it; a `glow` they find by chance.
    lamp, reach = ("glow", "4 {} 0") if scene.has("glass", "pane") else ("light", "3 {}")
    for i, surface in enumerate(scene.surfaces):
        parts += _surface(surface, str(i), lamp, reach)
    for i, light in enumerate(scene.points):
        radiance = light.intensity / (np.pi * POINT_RADIUS**2) / EFFICACY
        parts += [f"void light bulb{i} 0 0 3 {_text(radiance)}"]
        parts += [f"bulb{i} sphere bulb{i}.s 0 0 4 {_text(light.position)} {POINT_RADIUS}"]
    for i, luminaire in enumerate(scene.luminaires):
        parts.append(_luminaire(luminaire, folder, f"luminaire{i}"))
    description, octree = folder / "scene.rad", folder / "scene.oct"
    description.write_text("\n".join(parts) + "\n")
    octree.write_bytes(run(["oconv", description]))
    return octree


def _text(numbers) -> str:
    return " ".join(f"{x:.9g}" for x in np.ravel(numbers))


def _surface(surface: Surface, name: str, lamp: str, reach: str) -> list[str]:
    shape, material = surface.shape, surface.material
    if surface.luminance is not None:
        arguments = reach.format(_text(surface.luminance / EFFICACY))
        lines, modifier = [f"void {lamp} m{name} 0 0 {arguments}"], f"m{name}"
    elif material["type"] == "black":
        lines, modifier = [], "black"
    elif material["type"] == "mirror":
        lines, modifier = [f"void mirror m{name} 0 0 3 {_text(material['reflectance'])}"], f"m{name}"
    elif material["type"] == "glass":
        lines, modifier = [f"void dielectric m{name} 0 0 5 1 1 1 {material['ior']} 0"], f"m{name}"
    elif material["type"] == "pane":
        passed = _text([material["internal_transmittance"]] * 3)
        lines, modifier = [f"void glass m{name} 0 0 4 {passed} {material['ior']}"], f"m{name}"
    elif material["type"] == "translucent":
        reflected, passed = material["reflectance"], material["transmittance"]
        straight = material.get("specular_transmittance", 0)
        color = reflected + passed + straight
        shares = [np.mean((passed + straight) / color), np.mean(straight / (passed + straight))]
        lines, modifier = [f"void trans m{name} 0 0 7 {_text(color)} 0 0 {_text(shares)}"], f"m{name}"
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
    run(["ies2rad", *settings, "-o", folder / name, luminaire.file])
    turn = ["-rz", str(luminaire.spin_deg), "-t", *(f"{x:.9g}" for x in luminaire.position)]
    return run(["xform", *turn, folder / f"{name}.rad"]).decode()
