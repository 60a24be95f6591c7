#!/usr/bin/env python3
"""Measures the exported scene beside this file with Mitsuba 3: prints the values at the points of sensors.

    pip install mitsuba
    python3 measure.py desk.pts --samples 4096
    python3 measure.py paper.pts --luminance

A line of a .pts file has a position, and the normal of the point or (--luminance) the viewing direction. Printed are
value and standard error, in lx or cd/m2. Other programs can import load(), illuminance() and luminance().
"""

import argparse
from pathlib import Path

import numpy as np

import mitsuba as mi

if mi.variant() is None:
    mi.set_variant("llvm_ad_rgb")

import drjit as dr  # noqa: E402

import stilb_plugins  # noqa: E402, F401: what Mitsuba lacks

HERE = Path(__file__).resolve().parent
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
PATH_TRACER = {"type": "path", "max_depth": -1, "rr_depth": 5}


def load(folder=HERE, sampler: str = "independent"):
    """The scene; `sampler` is that of its cameras."""
    file = Path(folder) / "scene.xml"
    has_cameras = "$sampler" in file.read_text()
    return mi.load_file(str(file), **({"sampler": sampler} if has_cameras else {}))


def read_points(path):
    """Positions and directions, both n x 3."""
    lines = np.loadtxt(path, ndmin=2)
    return lines[:, :3], lines[:, 3:]


def repeated(vectors, count: int, kind):
    """Every vector `count` times, one after the other."""
    # An opaque count is not compiled into the kernel, which so serves for any.
    index = dr.arange(mi.UInt32, len(vectors) * count) // dr.opaque(mi.UInt32, count)
    columns = [mi.Float(vectors[:, axis].astype(np.float32)) for axis in range(3)]
    return kind(*(dr.gather(mi.Float, column, index) for column in columns))


def mean_luminance(spectrum, points: int) -> np.ndarray:
    """Of all samples of each point; linear Rec. 709, or grey in variants of one channel."""
    channels = np.array(spectrum).reshape(-1, points, dr.width(spectrum) // points).mean(axis=2, dtype=float)
    return WEIGHTS @ channels if len(channels) == 3 else channels[0]


def surface_points(positions, normals, samples: int):
    here = dr.zeros(mi.SurfaceInteraction3f, samples * len(positions))
    here.p = repeated(positions, samples, mi.Point3f)
    here.n = repeated(normals, samples, mi.Normal3f)
    return here


def illuminance(scene, integrator, positions, normals, samples: int, sampler, is_direct_included=True) -> np.ndarray:
    """One estimate [lx] at each point: light of emitters by sampling them, the rest by paths from the point.

    A path's first ray has the density of the cosine; the light that it sees on emitters is left out, since sampling
    them has counted it.
    """
    here = surface_points(positions, normals, samples)
    total = mi.Spectrum(0)
    if is_direct_included and scene.emitters():
        towards, weight = scene.sample_emitter_direction(here, sampler.next_2d())
        total += weight * dr.maximum(dr.dot(towards.d, here.n), 0)
    direction = mi.Frame3f(here.n).to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
    total += dr.pi * light_without_emission(scene, integrator, sampler, here.spawn_ray(direction))
    return mean_luminance(total, len(positions))


def light_without_emission(scene, integrator, sampler, ray):
    """The radiance along rays, less that of emitters that they meet at once."""
    radiance = integrator.sample(scene, sampler, mi.RayDifferential3f(ray))[0]
    first = scene.ray_intersect(ray)
    return radiance - first.emitter(scene).eval(first)


def direct_illuminance(scene, positions, normals) -> np.ndarray:
    """[lx] by all emitters, one after the other: exact where they are points."""
    emitters = scene.emitters_dr()
    here = surface_points(positions, normals, dr.width(emitters))
    index = dr.arange(mi.UInt32, len(positions) * dr.width(emitters)) % dr.opaque(mi.UInt32, dr.width(emitters))
    towards, weight = dr.gather(mi.EmitterPtr, emitters, index).sample_direction(here, mi.Point2f(0.5))
    is_shaded = scene.ray_test(here.spawn_ray_to(towards.p))
    light = dr.select(is_shaded, 0, weight * dr.maximum(dr.dot(towards.d, here.n), 0))
    return mean_luminance(light, len(positions)) * dr.width(emitters)


def luminance(scene, integrator, positions, directions, samples: int, sampler) -> np.ndarray:
    """One estimate [cd/m2] along each line of sight."""
    origins = repeated(positions, samples, mi.Point3f)
    ray = mi.RayDifferential3f(origins, repeated(directions, samples, mi.Vector3f))
    return mean_luminance(integrator.sample(scene, sampler, ray)[0], len(positions))


def seeded_sampler(seed: int, width: int):
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, width)
    return sampler


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("points", type=Path)
    parser.add_argument("--luminance", action="store_true", help="lines of sight instead of points with normals")
    parser.add_argument("--samples", type=int, default=4096, help="at each point (4096)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    scene, integrator = load(), mi.load_dict(PATH_TRACER)
    positions, directions = read_points(arguments.points)
    measure = luminance if arguments.luminance else illuminance
    batches, size = 32, max(arguments.samples // 32, 1)
    values = []
    for batch in range(batches):
        sampler = seeded_sampler(arguments.seed * batches + batch, size * len(positions))
        values.append(measure(scene, integrator, positions, directions, size, sampler))
    for value, error in zip(np.mean(values, axis=0), np.std(values, axis=0, ddof=1) / np.sqrt(batches)):
        print(f"{value:.6g} {error:.3g}")


if __name__ == "__main__":
    main()
