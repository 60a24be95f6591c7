"""Problems with known answers, computed without any simulation (docs/exact-solutions.md).

Numbers may be arrays: results then have their shape. Positions and normals are arrays (..., 3). Lengths are in metres,
angles in degrees. Arguments out of range raise ValueError.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._stilb import exact as _exact

__all__ = [
    "coaxial_disk_form_factors", "concentric_sphere_form_factors", "diffuse_cube", "diffuse_cube_mean", "furnace",
    "illuminance_by_disk", "illuminance_by_point", "illuminance_by_polygon", "illuminance_by_rectangle",
    "illuminance_by_sphere", "pane_transmittance", "photometric_sphere", "sobolev", "two_surfaces",
]

Numbers = NDArray[np.float64]
PARTS = ("total", "direct", "indirect")


def _each(function: Callable[..., float], *numbers: ArrayLike) -> Numbers:
    with np.errstate(all="ignore"):  # intermediate results of the solutions are no concern of NumPy's
        return np.asarray(np.vectorize(function, otypes=[np.float64])(*numbers))


def _each_point(function: Callable[..., float], *points: ArrayLike) -> Numbers:
    """The function at each of the points (..., 3), which are broadcast."""
    arrays = np.broadcast_arrays(*(np.asarray(point, np.float64) for point in points))
    if arrays[0].ndim == 0 or arrays[0].shape[-1] != 3:
        raise ValueError(f"found points of shape {arrays[0].shape}. Allowed: (..., 3).")
    rows = zip(*(array.reshape(-1, 3).tolist() for array in arrays), strict=True)
    return np.array([function(*row) for row in rows]).reshape(arrays[0].shape[:-1])


def _part(part: str) -> str:
    if part not in PARTS:
        raise ValueError(f'part "{part}" is not known. Allowed: {", ".join(PARTS)}.')
    return part


def sobolev(radius: ArrayLike, *, plane: int = 1, reflectances: Sequence[float] = (0.5, 0.5),
            distances: Sequence[float] = (0.5, 0.5), intensity: float = 1.0, part: str = "total") -> Numbers:
    """Sobolev's problem: the illuminance [lx] on infinite parallel diffuse planes with a point source between them.

    `radius`: the distance [m] from the source's foot, at most 100 times the distance of the planes. Plane 1 lies under
    the source, plane 2 above it. `distances` [m] are those of the source from both planes, `intensity` is in cd.
    `part`: "total", "direct" or "indirect" (after one or more reflections).
    """
    if plane not in (1, 2):
        raise ValueError(f"plane {plane} is not known. Allowed: 1, 2.")
    first, second = reflectances
    below, above = distances
    problem = _exact.SobolevProblem((first, second), (below, above), intensity)
    of_radius = getattr(problem, _part(part))
    return _each(lambda r: of_radius(plane, r), radius)


def furnace(emitted: ArrayLike, reflectance: ArrayLike) -> tuple[Numbers, Numbers]:
    """Luminance [cd/m2] and illuminance [lx] in a closed room whose walls all emit `emitted` [cd/m2] and reflect alike."""
    return _each(_exact.furnace_luminance, emitted, reflectance), _each(_exact.furnace_illuminance, emitted, reflectance)


def photometric_sphere(radius: float, reflectance: float, flux: float, *, source: Sequence[float] | None = None,
                       to_wall: ArrayLike = (0, 0, 1)) -> Numbers:
    """The illuminance [lx] of the wall of a diffuse sphere about the origin, lit from within.

    With an isotropic `source`: direct and indirect light in the directions `to_wall` (..., 3) from the centre. Without:
    after one or more reflections, which is the same everywhere for any light.
    """
    if source is None:
        return np.asarray(_exact.sphere_indirect(radius, reflectance, flux))
    x, y, z = map(float, source)
    return _each_point(lambda way: _exact.sphere_illuminance(radius, reflectance, flux, (x, y, z), way), to_wall)


def diffuse_cube(side: float, flux: float, reflectance: float, x: ArrayLike, y: ArrayLike, *,
                 part: str = "total") -> Numbers:
    """The illuminance [lx] on a face of a diffuse cube with an isotropic source in its middle, `x`, `y` from the middle of
    the face. Relative error below 2e-4, except nearer than a fortieth of the side to an edge."""
    cube = _exact.DiffuseCube(side, flux)
    _part(part)
    direct = _each(cube.direct, x, y) if part != "indirect" else np.asarray(0.0)
    indirect = _each(lambda a, b: cube.indirect(reflectance, a, b), x, y) if part != "direct" else np.asarray(0.0)
    return direct + indirect


def diffuse_cube_mean(side: float, flux: float, reflectance: float) -> float:
    """The mean illuminance [lx] of all faces of that cube."""
    return _exact.DiffuseCube(side, flux).mean(reflectance)


def coaxial_disk_form_factors(radius_1: float, radius_2: float, distance: float) -> Numbers:
    """[i, j]: the share of the flux of disk i + 1 that reaches disk j + 1, facing each other on one axis."""
    return np.array(_exact.coaxial_disk_form_factors(radius_1, radius_2, distance))


def concentric_sphere_form_factors(inner_radius: float, outer_radius: float) -> Numbers:
    """The same for the outside of an inner sphere and the inside of an outer one."""
    return np.array(_exact.concentric_sphere_form_factors(inner_radius, outer_radius))


def two_surfaces(emitted: Sequence[float], reflectances: Sequence[float], form_factors: ArrayLike) -> Numbers:
    """The mean illuminance [lx] of two surfaces that emit `emitted` [lm/m2], with all reflections between them."""
    (a, b), (c, d) = np.asarray(form_factors, np.float64).tolist()
    one, two = map(float, emitted)
    first, second = map(float, reflectances)
    return np.array(_exact.two_surface_illuminance((one, two), (first, second), ((a, b), (c, d))))


def pane_transmittance(angle: ArrayLike, *, ior: float = 1.5, internal_transmittance: float = 1.0) -> Numbers:
    """The transmittance of a thin pane for unpolarised light at `angle` [degrees] to the normal."""
    return _each(lambda degrees: _exact.pane_transmittance(ior, internal_transmittance, math.radians(degrees)), angle)


def illuminance_by_point(position: ArrayLike, normal: ArrayLike, source: Sequence[float], intensity: float) -> Numbers:
    """The illuminance [lx] of surface elements by an isotropic point source of `intensity` [cd]."""
    return _each_point(lambda p, n: _exact.by_point(p, n, _triple(source), intensity), position, normal)


def illuminance_by_polygon(position: ArrayLike, normal: ArrayLike, vertices: ArrayLike, luminance: float) -> Numbers:
    """By a plane polygon that emits to the side from which its vertices run counterclockwise (Lambert's formula)."""
    corners = [_triple(vertex) for vertex in np.asarray(vertices, np.float64).tolist()]
    return _each_point(lambda p, n: _exact.by_polygon(p, n, corners, luminance), position, normal)


def illuminance_by_rectangle(position: ArrayLike, normal: ArrayLike, corner: ArrayLike, edge_u: ArrayLike,
                             edge_v: ArrayLike, luminance: float) -> Numbers:
    """By a parallelogram that emits to the side of edge_u x edge_v."""
    c, u, v = (np.asarray(x, np.float64) for x in (corner, edge_u, edge_v))
    return illuminance_by_polygon(position, normal, np.array([c, c + u, c + u + v, c + v]), luminance)


def illuminance_by_disk(position: ArrayLike, normal: ArrayLike, center: Sequence[float], disk_normal: Sequence[float],
                        radius: float, luminance: float) -> Numbers:
    """By a disk that emits to the side of its normal."""
    return _each_point(lambda p, n: _exact.by_disk(p, n, _triple(center), _triple(disk_normal), radius, luminance),
                       position, normal)


def illuminance_by_sphere(position: ArrayLike, normal: ArrayLike, center: Sequence[float], radius: float,
                          luminance: float) -> Numbers:
    """By a sphere, wholly or partly above the element's horizon."""
    return _each_point(lambda p, n: _exact.by_sphere(p, n, _triple(center), radius, luminance), position, normal)


def _triple(point: Sequence[Any]) -> tuple[float, float, float]:
    x, y, z = map(float, point)
    return (x, y, z)
