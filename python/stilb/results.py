"""Results: numbers with their errors, as NumPy arrays that share the memory of the C++ library."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _stilb

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

__all__ = ["Estimate", "Image", "Reading", "Result"]

Numbers = NDArray[np.float64]


class Estimate:
    """A number with its standard error and its 95 % interval."""

    def __init__(self, estimate: _stilb.Estimate, unit: str = "") -> None:
        self.value = estimate.value
        self.standard_error = estimate.standard_error
        self.interval = (estimate.lower, estimate.upper)
        self.unit = unit

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        low, high = self.interval
        return f"{with_error(self.value, (high - low) / 2)} {self.unit}".rstrip()


class Run:
    """The common part of all results."""

    def __init__(self, run: _stilb.Summary) -> None:
        self._run = run

    @property
    def method(self) -> str:
        """The method of computation."""
        return self._run.method

    @property
    def technique(self) -> str:
        """What method "auto" has chosen, such as "light-paths", or the method. With this method, the seed and
        the number of paths, the same scene gives the same digits again."""
        return self._run.technique

    @property
    def seed(self) -> int:
        """The seed of the random numbers."""
        return self._run.seed

    @property
    def paths(self) -> int:
        """The number of samples of the technique: light paths, paths of each reading, passes of a picture ..."""
        return self._run.samples

    @property
    def replicates(self) -> int:
        """The number of independent repetitions that the errors come from."""
        return self._run.replicates

    @property
    def elapsed_s(self) -> float:
        """The time of the run [s]."""
        return self._run.elapsed_s

    @property
    def converged(self) -> bool:
        """False where the error asked for was not reached, or the run was interrupted."""
        return self._run.converged

    @property
    def error(self) -> float:
        """The relative half-width that the 95 % intervals of 95 % of the readings or pixels have at most."""
        return self._run.attained_error

    @property
    def warnings(self) -> list[str]:
        """The warnings about the scene and about the result."""
        return self._run.warnings

    @property
    def warning_kinds(self) -> list[str]:
        """The kind of each warning, such as "holes" or "rare-light", for programs: sentences may change."""
        return self._run.warning_kinds

    def _ending(self) -> str:
        return f"{self.method}, {self.paths} paths in {self.elapsed_s:.2f} s, error {100 * self.error:.2g} %"


class Reading:
    """The readings of one sensor.

    The arrays have the shape (nv, nu) for grids, row by row along edge_v; (n,) for points, lines of sight and others;
    that of the given points for `Scene.illuminance` and `Scene.luminance`. They cannot be changed: `desk.value.copy()`.
    """

    def __init__(self, sensor: _stilb.SensorResult, run: _stilb.Summary, shape: tuple[int, ...] | None = None) -> None:
        self._sensor = sensor
        self._run = run
        columns, rows = sensor.count
        self._shape = shape if shape is not None else (rows, columns) if rows else sensor.value.shape

    @property
    def name(self) -> str:
        """The sensor's name."""
        return self._sensor.name

    @property
    def type(self) -> str:
        """The sensor's type, such as "grid"."""
        return self._sensor.type

    @property
    def quantity(self) -> str:
        """Such as "illuminance"."""
        return self._sensor.quantity

    @property
    def unit(self) -> str:
        """Such as "lx"."""
        return self._sensor.unit

    @property
    def error(self) -> float:
        """The relative half-width that the 95 % intervals of 95 % of the readings have at most."""
        return self._sensor.attained_error

    @property
    def run(self) -> Run:
        """The run that these readings come from: its method, effort and warnings."""
        return Run(self._run)

    @property
    def value(self) -> Numbers:
        """The values."""
        return self._shaped(self._sensor.value)

    @property
    def standard_error(self) -> Numbers:
        """The standard errors of the values."""
        return self._shaped(self._sensor.standard_error)

    @property
    def rgb(self) -> Numbers:
        """Linear Rec. 709, in the sensor's unit, (..., 3); its luminance is the value."""
        return self._shaped(self._sensor.rgb)

    @property
    def position(self) -> Numbers:
        """The positions [m], (..., 3)."""
        return self._shaped(self._sensor.position)

    @property
    def direction(self) -> Numbers:
        """Normals of surface elements, axes of bodies, or viewing directions, (..., 3)."""
        return self._shaped(self._sensor.direction)

    def interval(self, confidence: float = 0.95) -> tuple[Numbers, Numbers]:
        """Lower and upper ends of the intervals that contain the true values with this probability.

        Those of 95 % are the engine's, with what it adds for rare light and for patches (docs/statistics.md). Others are
        wider or narrower than these by the ratio of Student's t.
        """
        low, high = self._shaped(self._sensor.lower), self._shaped(self._sensor.upper)
        if confidence == 0.95:
            return low, high
        factor = self._width_factor(confidence)
        return self.value - factor * (self.value - low), self.value + factor * (high - self.value)

    @cached_property
    def mean(self) -> Estimate:
        """The mean of the readings."""
        return Estimate(self._sensor.mean, self.unit)

    @cached_property
    def minimum(self) -> Estimate:
        """The smallest reading."""
        return Estimate(self._sensor.minimum, self.unit)

    @cached_property
    def maximum(self) -> Estimate:
        """The largest reading."""
        return Estimate(self._sensor.maximum, self.unit)

    @cached_property
    def uniformity(self) -> Estimate:
        """The smallest reading over the mean."""
        return Estimate(self._sensor.uniformity)

    @cached_property
    def diversity(self) -> Estimate:
        """The smallest reading over the largest one."""
        return Estimate(self._sensor.diversity)

    @property
    def requirements(self) -> dict[str, tuple[float, str]]:
        """The limit of each requirement of the scene, and whether it is met: "pass", "fail", "undecided" or "unsure"."""
        return {item.key: (item.limit, item.verdict) for item in self._sensor.requirements}

    @property
    def reasons(self) -> dict[str, str]:
        """Why requirements are "unsure": what the value leaves out, such as lamps too small for UGR, could change them."""
        return {item.key: item.reason for item in self._sensor.requirements if item.reason}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each reading: position [m], direction, value, standard error and 95 % interval."""
        import pandas

        sensor = self._sensor
        columns = {axis: sensor.position[:, i] for i, axis in enumerate("xyz")}
        columns |= {f"direction_{axis}": sensor.direction[:, i] for i, axis in enumerate("xyz")}
        columns |= {"value": sensor.value, "standard_error": sensor.standard_error, "lower": sensor.lower,
                    "upper": sensor.upper}
        table = pandas.DataFrame(columns)
        if self._is_grid():
            table.index = pandas.MultiIndex.from_product([range(self._shape[0]), range(self._shape[1])], names=["v", "u"])
        table.attrs = {"name": self.name, "quantity": self.quantity, "unit": self.unit}
        return table

    def plot(self, axes: matplotlib.axes.Axes | None = None, **style: Any) -> matplotlib.axes.Axes:
        """Draws a grid in colours, and other readings with their 95 % intervals. Needs matplotlib; returns the axes."""
        from . import plots

        return plots.plot_grid(self, axes, **style) if self._is_grid() else plots.plot_readings(self, axes, **style)

    def __len__(self) -> int:
        return len(self._sensor.value)

    def __repr__(self) -> str:
        return f"<{self.name}: {self._text()}>"

    def _repr_html_(self) -> str:
        return _html_table([self])

    def _text(self) -> str:
        if len(self) == 1:
            return str(Estimate(self._sensor.mean, self.unit))
        return f"{' x '.join(map(str, self._shape))} readings, mean {self.mean}"

    def _is_grid(self) -> bool:
        return self._sensor.count[1] > 0

    def _shaped(self, array: Numbers) -> Numbers:
        """A view of the array in the shape of the readings."""
        return array.reshape(self._shape + array.shape[1:])

    def _width_factor(self, confidence: float) -> float:
        if not 0 < confidence < 1:
            raise _stilb.InputError(f"confidence {confidence}: expected a probability between 0 and 1, such as 0.95.")
        if self._run.replicates < 2:
            return float("nan")

        def half_width(probability: float) -> float:
            return _stilb.statistics.student_t_quantile((1 + probability) / 2, self._run.replicates - 1)

        return half_width(confidence) / half_width(0.95)


class Result(Run, Mapping[str, Reading]):
    """The readings of all sensors: `result["desk"]`, in the order of the scene."""

    def __init__(self, result: _stilb.Result) -> None:
        super().__init__(result)
        self._result = result
        self._readings = {sensor.name: Reading(sensor, result) for sensor in result.sensors}

    def __getitem__(self, sensor: str) -> Reading:
        if sensor not in self._readings:
            raise KeyError(f"there is no result of a sensor {sensor!r}; there are: {', '.join(self._readings)}")
        return self._readings[sensor]

    def __iter__(self) -> Iterator[str]:
        return iter(self._readings)

    def __len__(self) -> int:
        return len(self._readings)

    def to_json(self) -> str:
        """The document of `stilb measure --json` (docs/json.md)."""
        return self._result.json

    def __repr__(self) -> str:
        return "\n".join([*(f"{name}: {reading._text()}" for name, reading in self.items()), self._ending()])

    def _repr_html_(self) -> str:
        return _html_table(list(self.values())) + f"<p>{escape(self._ending())}</p>"

    def _only(self, shape: tuple[int, ...]) -> Reading:
        """The only sensor's readings in another shape."""
        return Reading(self._result.sensors[0], self._result, shape)


class Image(Run):
    """A luminance picture. The arrays begin with the top row, and share the memory of the C++ library."""

    def __init__(self, picture: _stilb.Picture) -> None:
        super().__init__(picture)
        self._picture = picture

    @property
    def luminance(self) -> NDArray[np.float32]:
        """The luminance [cd/m2], (h, w); NaN where the camera shows nothing."""
        return self._picture.luminance

    @property
    def standard_error(self) -> NDArray[np.float32] | None:
        """The standard error of each pixel [cd/m2], (h, w); None after a single pass."""
        return self._picture.standard_error

    @property
    def rgb(self) -> NDArray[np.float32]:
        """Linear Rec. 709 [cd/m2], (h, w, 3)."""
        return self._picture.rgb

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes OpenEXR, Radiance or PNG, by the ending: .exr, .hdr, .png (docs/pictures.md)."""
        self._picture.save(Path(path))

    def plot(self, axes: matplotlib.axes.Axes | None = None, **style: Any) -> matplotlib.axes.Axes:
        """Draws the luminance in false colours, with a logarithmic scale. Needs matplotlib; returns the axes."""
        from . import plots

        return plots.plot_image(self, axes, **style)

    def __repr__(self) -> str:
        return f"<stilb.Image {self._picture.width} x {self._picture.height}: {self._ending()}>"

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            self.save(path)
            return path.read_bytes()


def with_error(value: float, half_width: float) -> str:
    """The value with as many digits as two digits of its error have: 494.3 ± 1.1."""
    if not np.isfinite(half_width) or half_width <= 0 or not np.isfinite(value):
        return f"{value:.6g}"
    digits = 1 - int(np.floor(np.log10(half_width)))
    if digits < 0:
        value, half_width, digits = round(value, digits), round(half_width, digits), 0
    return f"{value:.{digits}f} ± {half_width:.{digits}f}"


def _html_table(readings: list[Reading]) -> str:
    head = "".join(f"<th>{title}</th>" for title in ("sensor", "quantity", "readings", "mean", "minimum", "maximum"))
    rows = [f"<tr><th>{escape(reading.name)}</th><td>{reading.quantity}</td>"
            f"<td>{' x '.join(map(str, reading.value.shape))}</td><td>{escape(str(reading.mean))}</td>"
            f"<td>{escape(str(reading.minimum))}</td><td>{escape(str(reading.maximum))}</td></tr>"
            for reading in readings]
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
