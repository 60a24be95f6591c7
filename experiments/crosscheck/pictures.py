#!/usr/bin/env python3
"""Compares Stilb's pictures with Mitsuba 3 and Radiance: the mean luminances of 8 x 8 blocks.

    venv/bin/python experiments/crosscheck/pictures.py experiments/crosscheck/surfaces.toml --programs mitsuba

Each camera of the scene makes a picture for every seed. A block's value is its mean over all of them, and its
error comes from their spread: neighbouring pixels share light paths, so their own errors do not add up to it.
Blocks that reach beyond a fisheye's circle are left out.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

from crosscheck import LARGEST_Z, PROGRAMS, ROOT, print_differences
from rays import Rays, directions_at
from scene import Camera, read_scene

BLOCKS = 8  # on each side


def read_channel(path: Path, name: str) -> np.ndarray:
    bitmap = mi.Bitmap(str(path))
    names = [field.name for field in bitmap.struct_()]
    return np.array(bitmap)[:, :, names.index(name)]


def picture_blocks(arguments, scene: Path, camera: str, method: str) -> tuple:
    """Values and standard errors of all blocks, row by row."""
    pictures = []
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.exr"
        command = [arguments.stilb, "render", scene, "--sensor", camera, "-o", picture, "--method", method, "--quiet"]
        command += ["--paths", arguments.passes, "--threads", arguments.threads]
        for seed in range(1, arguments.seeds + 1):
            subprocess.run([str(word) for word in [*command, "--seed", seed]], check=True, stdout=subprocess.DEVNULL)
            luminance = read_channel(picture, "Y")
            height, width = luminance.shape
            blocks = luminance.reshape(BLOCKS, height // BLOCKS, BLOCKS, width // BLOCKS)
            pictures.append(blocks.mean(axis=(1, 3)).ravel())
    return np.mean(pictures, axis=0), np.std(pictures, axis=0, ddof=1) / np.sqrt(len(pictures))


def block_corners(camera: Camera) -> tuple:
    """Left and upper edges of all blocks, row by row, and the size of a block [pixels]."""
    size = np.array(camera.resolution) / BLOCKS
    upper, left = np.divmod(np.arange(BLOCKS**2), BLOCKS)
    return left * size[0], upper * size[1], size


def is_shown(camera: Camera) -> np.ndarray:
    """Which blocks lie in the picture with all of their corners."""
    left, upper, size = block_corners(camera)
    if camera.projection != "fisheye":
        return np.full(len(left), True)
    middle = np.array(camera.resolution) / 2
    farthest = np.abs(np.stack([left, upper], axis=1) + size / 2 - middle) + size / 2
    return np.hypot(*farthest.T) <= middle[0]


def block_rays(camera: Camera, shown: np.ndarray) -> Rays:
    left, upper, size = block_corners(camera)
    left, upper = left[shown, None], upper[shown, None]

    def draw(seed: int, n: int):
        random = np.random.default_rng(seed)
        x, y = (edge + random.random((len(left), n)) * side for edge, side in zip((left, upper), size))
        directions = directions_at(camera, x, y)
        return np.broadcast_to(camera.position, directions.shape), directions

    return Rays(len(left), draw)


def compare(path: Path, name: str, arguments) -> float:
    scene = read_scene(path)
    camera = scene.cameras[name]
    shown = is_shown(camera)
    measured = {}
    for method in arguments.methods:
        start = time.monotonic()
        measured[method] = [column[shown] for column in picture_blocks(arguments, path, name, method)]
        print(f"{path.stem} {name}: {method} took {time.monotonic() - start:.0f} s", file=sys.stderr)
    references = {}
    for program in arguments.programs:
        start = time.monotonic()
        if result := PROGRAMS[program].luminance(scene, block_rays(camera, shown), arguments.error):
            references[program] = result
            print(f"{path.stem} {name}: {program} took {time.monotonic() - start:.0f} s", file=sys.stderr)
    print(f"\n### {path.stem}: {name}, {np.count_nonzero(shown)} blocks\n")
    places = [f"row {i // BLOCKS}, column {i % BLOCKS}" for i in np.flatnonzero(shown)]
    return print_differences(places, measured, references)


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--stilb", type=Path, default=ROOT / "build/release/stilb")
    parser.add_argument("--cameras", nargs="+", help="only these")
    parser.add_argument("--passes", type=int, default=256, help="of each picture (256)")
    parser.add_argument("--seeds", type=int, default=32, help="pictures of each method (32)")
    parser.add_argument("--threads", type=int, default=0, help="of Stilb (all)")
    parser.add_argument("--error", type=float, default=0.002, help="relative standard error of the others (0.002)")
    parser.add_argument("--methods", nargs="+", default=["auto", "path"])
    parser.add_argument("--programs", nargs="+", default=list(PROGRAMS), choices=PROGRAMS)
    arguments = parser.parse_args()
    largest = 0.0
    for scene in arguments.scenes:
        for camera in arguments.cameras or read_scene(scene).cameras:
            largest = max(largest, compare(scene, camera, arguments))
    if largest > LARGEST_Z:
        sys.exit(f"there are differences of more than {LARGEST_Z} standard errors")


if __name__ == "__main__":
    main()
