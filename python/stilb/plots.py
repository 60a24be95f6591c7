"""Drawings of results by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .results import Image, Reading


def _axes_or_new(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots(layout="constrained")[1]


def plot_grid(reading: Reading, axes: Axes | None, **style: Any) -> Axes:
    """The cells of a grid in colours, u to the right and v upwards, in metres along the edges."""
    axes = _axes_or_new(axes)
    rows, columns = reading.value.shape
    position = reading.position
    width = columns * step(position[0])
    height = rows * step(position[:, 0])
    shown = axes.imshow(reading.value, **{"origin": "lower", "extent": (0, width, 0, height), **style})
    axes.figure.colorbar(shown, ax=axes, label=f"{reading.quantity} [{reading.unit}]")
    axes.set(title=reading.name, xlabel="along edge_u [m]", ylabel="along edge_v [m]")
    return axes


def step(positions: np.ndarray[Any, Any]) -> float:
    """The distance of neighbours in a row of positions; 1 where there is one only."""
    return float(np.linalg.norm(positions[1] - positions[0])) if len(positions) > 1 else 1.0


def plot_readings(reading: Reading, axes: Axes | None, **style: Any) -> Axes:
    """Each reading with its 95 % interval."""
    axes = _axes_or_new(axes)
    value = reading.value.ravel()
    low, high = (end.ravel() for end in reading.interval())
    axes.errorbar(np.arange(len(value)), value, yerr=(value - low, high - value),
                  **{"fmt": "o", "capsize": 3, **style})
    unit = f" [{reading.unit}]" if reading.unit else ""
    axes.set(title=reading.name, xlabel="reading", ylabel=f"{reading.quantity}{unit}")
    return axes


def plot_image(image: Image, axes: Axes | None, **style: Any) -> Axes:
    """The luminance in false colours, with a logarithmic scale from a thousandth of the brightest percent."""
    from matplotlib.colors import LogNorm

    axes = _axes_or_new(axes)
    luminance = image.luminance
    brightest = float(np.nanpercentile(luminance, 99)) or 1.0
    shown = axes.imshow(luminance, **{"norm": LogNorm(brightest / 1000, brightest, clip=True), **style})
    axes.figure.colorbar(shown, ax=axes, label="luminance [cd/m²]")
    axes.set_axis_off()
    return axes
