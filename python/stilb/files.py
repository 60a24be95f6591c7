"""Files of other programs: points, and meshes as series of spherical harmonics."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from . import _stilb
from ._stilb import InputError
from .estimates import Numbers, ResultWarning

__all__ = ["Fit", "fit", "read_points"]


def read_points(path: str | os.PathLike[str]) -> tuple[Numbers, Numbers]:
    """Positions [m] and normals of a file with lines "x y z nx ny nz", as rtrace takes them, (n, 3) each:
    `scene.illuminance(*stilb.read_points("grid.pts"))`."""
    points = np.array(_stilb.read_points(Path(path)))
    return points[:, 0], points[:, 1]


class Fit:
    """A mesh as a series of spherical harmonics: `stilb.Harmonics(file=...)` is an object of it.

    Errors are distances along rays from the centre.
    """

    def __init__(self, made: _stilb.MeshFit, path: Path) -> None:
        self.path = path
        self.center = np.array(made.center)
        self.size = made.size
        self.rms_error, self.largest_error = np.array(made.errors).T

    path: Path
    center: Numbers  # [unit of the mesh]
    size: float  # the longest edge of the mesh's box
    rms_error: Numbers  # (degree + 1,), of the series that ends at each degree
    largest_error: Numbers

    def __repr__(self) -> str:
        return (f"<stilb.Fit {self.path}: degree {len(self.rms_error) - 1}, rms error "
                f"{100 * self.rms_error[-1] / self.size:.3g} % of the size>")


def fit(mesh: str | os.PathLike[str], path: str | os.PathLike[str], *, degree: int,
        center: Sequence[float] | None = None, tolerance: float = 0.005, force: bool = False) -> Fit:
    """Fits a series of spherical harmonics to a star-shaped mesh, and writes its file, as `stilb fit` does (docs/fit.md).

    `center`: of the rays; searched by default. `tolerance`: the share of directions in which the mesh may have several
    surfaces or none. `force`: take the outermost surface in any case.
    """
    if not 0 <= degree <= _stilb.most_degree:
        raise InputError(f"degree: {degree} is not allowed. Allowed: from 0 to {_stilb.most_degree}.")
    if not 0 <= tolerance < 1:
        raise InputError(f"tolerance: {tolerance} is not allowed. Allowed: a share of the directions below 1.")
    if center is not None and np.shape(center) != (3,):
        raise InputError(f"center: {center!r} is not allowed. Allowed: a position (x, y, z).")
    x, y, z = map(float, center if center is not None else (0, 0, 0))
    made = _stilb.fit_mesh(Path(mesh), Path(path), degree, None if center is None else (x, y, z), tolerance, force)
    for share, text in [(made.folded_share, "the outermost of several surfaces is taken"),
                        (made.missed_share, "there is no surface: the holes are closed by interpolation")]:
        if share > 0:
            warnings.warn(f"{mesh}: in {100 * share:.3f} % of the directions {text}.", ResultWarning, stacklevel=2)
    if made.open_edges:
        warnings.warn(f"{mesh}: the mesh is not closed: {made.open_edges} edges belong to one face or to more than two.",
                      ResultWarning, stacklevel=2)
    return Fit(made, Path(path))
