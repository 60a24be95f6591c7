"""The rays along which other programs measure luminance, and how long they do so."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from scene import Camera

BATCHES = 32


@dataclass
class Rays:
    """`draw(seed, n)`: origins and directions of n rays for each of `count` readings, both count x n x 3."""

    count: int
    draw: Callable[[int, int], tuple[np.ndarray, np.ndarray]]


def fixed_rays(origins: np.ndarray, directions: np.ndarray) -> Rays:
    def repeat(_: int, n: int):
        return tuple(np.repeat(v[:, None], n, axis=1) for v in (origins, directions))

    return Rays(len(origins), repeat)


def until(error: float, batches: Callable[[int], list], overall=np.mean):
    """Means and standard errors of samples, until the `overall` of the relative errors is below `error`.

    `batches(first)` makes BATCHES independent estimates, by the seeds from `first`.
    """
    means: list[np.ndarray] = []
    while True:
        means += batches(len(means))
        value = np.mean(means, axis=0)
        standard_error = np.std(means, axis=0, ddof=1) / np.sqrt(len(means))
        if overall(standard_error / np.maximum(value, 1e-300)) <= error:
            return value, standard_error


def directions_at(camera: Camera, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Where one looks at places of the picture [pixels from its upper left corner], as docs/scene-format.md says."""
    width, height = camera.resolution
    forward = _unit(camera.target - camera.position)
    right = _unit(np.cross(forward, [0, 0, 1]))
    up = np.cross(right, forward)
    across, upwards = (2 * x - width) / width, (height - 2 * y) / width  # -1 and 1 at the sides
    half = np.radians(camera.fov_deg) / 2
    if camera.projection == "perspective":
        local = across * np.tan(half), upwards * np.tan(half), np.ones_like(across)
    elif camera.projection == "fisheye":
        angle, azimuth = half * np.hypot(across, upwards), np.arctan2(upwards, across)
        local = np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)
    else:
        azimuth, elevation = half * across, half * upwards
        local = np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)
    return _unit(np.stack(local, axis=-1) @ np.array([right, up, forward]))


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
