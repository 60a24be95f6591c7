#!/usr/bin/env python3
"""Checks where Stilb's cameras see small lamps, with Radiance's vwrays and Mitsuba's sky.

    venv/bin/python experiments/crosscheck/cameras.py

Nine lamps of half a degree stand around a camera, some near the edges of its picture. The middle of a lamp's light
in the picture, made a direction, must be the direction of the lamp. Three ways to make directions of pixels:
the formula of rays.py; vwrays, which gets the VIEW that Stilb wrote into the picture; and the picture as the
sky of Mitsuba, for panoramas.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import with_radiance
from crosscheck import ROOT
from rays import directions_at
from scene import Camera

import mitsuba as mi  # noqa: E402, with the variant of with_mitsuba.py

POSITION, TARGET = np.array([1.0, 2.0, 1.5]), np.array([1.6, 3.1, 1.2])
CAMERAS = [
    Camera(POSITION, TARGET, "perspective", 90, (512, 384)),
    Camera(POSITION, TARGET, "fisheye", 180, (512, 512)),
    Camera(POSITION, TARGET, "panorama", 360, (1024, 512)),
]
RADIUS = np.radians(0.25)
# Mitsuba's sky has the middles of its first and last rows at the poles, so up to half a pixel is its own.
LARGEST_ERRORS = {"formula": 0.1, "vwrays": 0.1, "sky": 0.6}  # pixels


def lamps_in(camera: Camera) -> np.ndarray:
    """Directions to the middle of the picture and to eight places near its edges."""
    reach = 0.68 if camera.projection == "fisheye" else 0.94  # the corners of a fisheye are empty
    x, y = (size / 2 * (1 + reach * np.array([-1, 0.02, 1])) for size in camera.resolution)
    return directions_at(camera, *(places.ravel() for places in np.meshgrid(x, y)))


def render(stilb: Path, camera: Camera, lamps: np.ndarray) -> mi.Bitmap:
    text = f"""[sensors.eye]
type = "camera"
projection = "{camera.projection}"
fov = {camera.fov_deg}
position = {camera.position.tolist()}
target = {camera.target.tolist()}
resolution = {list(camera.resolution)}
"""
    for i, center in enumerate(camera.position + lamps):
        lamp = f'type = "sphere"\ncenter = {center.tolist()}\nradius = {np.sin(RADIUS)}\nluminance = 100'
        text += f"[lights.lamp{i}]\n{lamp}\n"
    with tempfile.TemporaryDirectory() as folder:
        scene, picture = Path(folder) / "lamps.toml", Path(folder) / "lamps.exr"
        scene.write_text(text)
        command = [stilb, "render", scene, "-o", picture, "--method", "path", "--paths", "64", "--quiet"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return mi.Bitmap(str(picture))


def by_formula(camera: Camera) -> np.ndarray:
    """Directions of the middles of all pixels, height x width x 3."""
    width, height = camera.resolution
    return directions_at(camera, *np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5))


def by_vwrays(view: str, camera: Camera) -> np.ndarray:
    width, height = camera.resolution
    command = ["vwrays", *view.split(), "-x", str(width), "-y", str(height), "-pa", "0", "-pj", "0", "-ff"]
    return np.frombuffer(with_radiance.run(command), np.float32).reshape(height, width, 6)[:, :, 3:].astype(float)


def middles(luminance: np.ndarray, pixels: np.ndarray, lamps: np.ndarray) -> np.ndarray:
    luminance = np.nan_to_num(luminance)
    parts = np.array([luminance * (pixels @ lamp > np.cos(6 * RADIUS)) for lamp in lamps])
    if not np.isclose(parts.sum(), luminance.sum()):
        sys.exit("the picture has light where no lamp is")
    return np.einsum("lij,ijk->lk", parts, pixels)


def middles_in_sky(bands: np.ndarray, camera: Camera, lamps: np.ndarray) -> np.ndarray:
    """Mitsuba's sky has its middle at z and its zenith at y."""
    look = mi.ScalarTransform4f().look_at([0, 0, 0], (camera.target - camera.position).tolist(), [0, 0, 1])
    sky = mi.load_dict({"type": "envmap", "bitmap": mi.Bitmap(bands), "to_world": look})
    around = lamps[:, None] + np.random.default_rng(1).normal(size=(1, 100000, 3)) * 3 * RADIUS
    around /= np.linalg.norm(around, axis=2, keepdims=True)
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(-around.reshape(-1, 3).T.astype(np.float32))
    seen = np.array(sky.eval(si))[1].reshape(len(lamps), -1)
    return np.einsum("ln,lnk->lk", seen, around)


def errors(found: np.ndarray, lamps: np.ndarray, camera: Camera) -> float:
    """The largest angle between lamps and what was found, in pixels of the picture's middle."""
    found = found / np.linalg.norm(found, axis=1, keepdims=True)
    half = np.radians(camera.fov_deg) / 2
    pixel = (np.tan(half) if camera.projection == "perspective" else half) * 2 / camera.resolution[0]
    return float(np.max(np.linalg.norm(found - lamps, axis=1)) / pixel)


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("--stilb", type=Path, default=ROOT / "build/release/stilb")
    arguments = parser.parse_args()
    print("| picture | directions by | farthest of the lamps [pixels] |\n|---|---|---|")
    failed = False
    for camera in CAMERAS:
        lamps = lamps_in(camera)
        bitmap = render(arguments.stilb, camera, lamps)
        channels, view = np.array(bitmap), bitmap.metadata().get("VIEW")
        found = {"formula": middles(channels[:, :, 1], by_formula(camera), lamps)}
        if camera.projection == "panorama":
            found["sky"] = middles_in_sky(channels[:, :, :3], camera, lamps)
        else:
            found["vwrays"] = middles(channels[:, :, 1], by_vwrays(view, camera), lamps)
        for name, directions in found.items():
            error = errors(directions, lamps, camera)
            failed |= error > LARGEST_ERRORS[name]
            print(f"| {camera.projection} | {name} | {error:.3f} |")
    if failed:
        sys.exit(f"lamps are farther away than {LARGEST_ERRORS} pixels")


if __name__ == "__main__":
    main()
