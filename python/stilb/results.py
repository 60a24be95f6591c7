"""Results: numbers with their errors, as NumPy arrays that share the memory of the C++ library."""

from __future__ import annotations

import os
import tempfile
import uuid
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _stilb, program
from ._stilb import InputError
from ._wrong import names_of, wrong_type
from .estimates import Errors, Estimate, Interval, Numbers, ResultWarning, RunKey
from .shares import ByName, Readings
from .values import Values

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray

    from .sums import Sums

__all__ = ["Image", "Reading", "Result", "Run"]

WITHOUT_PATCHES = ("path", "light-paths", "guided", "local", "double-local")  # techniques
OF_OTHER_NUMBERS = ("derived", "ugr", "dgp")  # types of sensors whose values are no means of light


class Run:
    """The common part of all results."""

    _samples = "paths"

    def __init__(self, run: _stilb.Summary, seeds: tuple[int, ...] = ()) -> None:
        """`seeds`: where they are several."""
        self._run = run
        self._seeds = seeds or (run.seed,)

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
        """The seed of the random numbers; of several the first one."""
        return self._seeds[0]

    @property
    def seeds(self) -> tuple[int, ...]:
        """All seeds of the random numbers: several after `stilb.merge`."""
        return self._seeds

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
    def stopped(self) -> str:
        """What ended the run: "target reached", "requirements decided", "paths done", "time over", "interrupted" or
        "patches too coarse"."""
        return self._run.stopped

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

    def __repr__(self) -> str:
        return f"<stilb.Run: {self._ending()}>"

    def _ending(self) -> str:
        technique = f" ({self.technique})" if self.technique != self.method else ""
        return (f"{self.method}{technique}, {self.paths} {self._samples} in {self.elapsed_s:.2f} s, error "
                f"{100 * self.error:.2g} %; {self._convergence()}")

    def _convergence(self) -> str:
        return f"{'converged' if self.converged else 'NOT converged'}: {self.stopped}"

    def _notes(self) -> list[str]:
        """The warnings, and why the run did not converge."""
        return self.warnings if self.converged else [*self.warnings, self._shortfall()]

    def _shortfall(self) -> str:
        wanted = self._run.requested_error
        if wanted is not None and not self.error <= wanted:
            return (f"The requested error of {100 * wanted:g} % is not reached: the error is {100 * self.error:.2g} %. The "
                    f"run ended by: {self.stopped}.")
        return f"The run ended before its goal: {self.stopped}."


def factors_of(lights: Mapping[str, float | Sequence[float]]) -> dict[str, tuple[float, float, float]]:
    """The factors of lights: a number for each, or one each for red, green and blue."""
    if not isinstance(lights, Mapping):
        raise wrong_type("lights", lights, 'factors by the names of lights, such as {"panel": 0.4}')
    return {name: _bands(name, factor) for name, factor in lights.items()}


def _bands(light: str, factor: float | Sequence[float]) -> tuple[float, float, float]:
    try:
        numbers = np.asarray(factor)
    except ValueError:  # a list of lists
        numbers = np.array("")
    if numbers.dtype.kind not in "biuf" or numbers.shape not in ((), (3,)):
        raise InputError(f"lights.{light}: {factor!r} is not allowed. Allowed: a factor of 0 or more, such as 0.5, or three of "
                         "them for red, green and blue.")
    red, green, blue = np.broadcast_to(numbers, 3).tolist()
    return float(red), float(green), float(blue)


def warn_of(run: Run, level: int = 4) -> None:
    """Python warnings of what is odd about a result. `level`: of the user's call in the stack."""
    for text in run._notes():
        warnings.warn(text, ResultWarning, stacklevel=level)


class Reading(Values):
    """The readings of one sensor.

    The arrays have the shape (nv, nu) for grids, row by row along edge_v; (n,) for points, lines of sight and others;
    that of the given points for `Scene.illuminance` and `Scene.luminance`. They cannot be changed: `desk.value.copy()`.

    A reading is an array, too, that of its values: `np.asarray(desk)`, `desk[0, 1]`, `desk.shape`, `len(desk)`.
    """

    def __init__(self, sensor: _stilb.SensorResult, run: _stilb.Summary, key: RunKey,
                 shape: tuple[int, ...] | None = None, of: str = "") -> None:
        """`of`: the part of the light or the light scene, which tells errors apart."""
        self._sensor = sensor
        self._of = of
        self._run = run
        self._key = key
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
        return Run(self._run, self._key.seeds)

    @property
    def value(self) -> Numbers:
        """The values."""
        return self._shaped(self._sensor.value)

    @property
    def standard_error(self) -> Numbers:
        """The standard errors of the values."""
        return self._shaped(self._sensor.standard_error)

    @property
    def replicates(self) -> Numbers:
        """The values in each of the R independent replicates, (R, ...): the basis of all errors.

        The standard error of any function of readings is the standard deviation of its values in the replicates over
        sqrt(R), where it is nearly linear. Rows of runs with the same seed and number of paths belong together.
        """
        replicates = self._sensor.replicates
        return replicates.reshape(replicates.shape[:1] + self._shape)

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

    @property
    def interval(self) -> Interval[Numbers]:
        """Lower and upper ends of the intervals that contain the true values with a probability of 95 %:
        `low, high = desk.interval`, and `desk.interval(0.99)` for another one.

        Those of 95 % are the engine's, with what it adds for rare light and for patches (docs/statistics.md). Others are
        wider or narrower than these by the ratio of Student's t.
        """
        low, high = self._shaped(self._sensor.lower), self._shaped(self._sensor.upper)
        return Interval.of(low, high, self.value, lambda: self._run.replicates - 1)

    @cached_property
    def mean(self) -> Estimate:
        """The mean of the readings."""
        return self._statistic("mean", self.unit)

    @cached_property
    def minimum(self) -> Estimate:
        """The smallest reading."""
        return self._statistic("minimum", self.unit)

    @cached_property
    def maximum(self) -> Estimate:
        """The largest reading."""
        return self._statistic("maximum", self.unit)

    @cached_property
    def uniformity(self) -> Estimate:
        """The smallest reading over the mean."""
        return self._statistic("uniformity", "")

    @cached_property
    def diversity(self) -> Estimate:
        """The smallest reading over the largest one."""
        return self._statistic("diversity", "")

    @property
    def requirements(self) -> dict[str, tuple[float, str]]:
        """The limit of each requirement of the scene, and whether it is met: "pass", "fail", "undecided" or "unsure"."""
        return {item.key: (item.limit, item.verdict) for item in self._sensor.requirements}

    @property
    def reasons(self) -> dict[str, str]:
        """Why requirements are "unsure": what the value leaves out, such as lamps too small for UGR, could change them."""
        return {item.key: item.reason for item in self._sensor.requirements if item.reason}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each reading: position [m], direction, value, standard error and 95 % interval. Needs
        pandas."""
        from . import tables

        return tables.table(self)

    def to_xarray(self) -> xarray.Dataset:
        """Values, standard errors, ends of the 95 % intervals and colours, with x, y and z [m]. The axes of a grid, v and u,
        are metres along its edges, at the middles of the cells; those of other readings count. Needs xarray."""
        from . import tables

        return tables.dataset(self)

    def plot(self, axes: matplotlib.axes.Axes | None = None, **style: Any) -> matplotlib.axes.Axes:
        """Draws a grid in colours, and other readings with their 95 % intervals. Needs matplotlib; returns the axes."""
        from . import plots

        return plots.plot_grid(self, axes, **style) if self._is_grid() else plots.plot_readings(self, axes, **style)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the values."""
        return self._shape

    @property
    def size(self) -> int:
        """The number of readings."""
        return self._sensor.value.size

    def __repr__(self) -> str:
        return f"<{self.name}: {self._text()}; {self.run._convergence()}>"

    def _repr_html_(self) -> str:
        return _html_table([self]) + _html_notes(self.run)

    def _text(self) -> str:
        if self.size == 1:
            return str(self.mean)
        return f"{' x '.join(map(str, self._shape))} readings, mean {self.mean}"

    def _statistic(self, name: str, unit: str) -> Estimate:
        sensor, key, full_name = self._sensor, self._key, f"{self._of}{self.name}.{name}"
        estimate: _stilb.Estimate = getattr(sensor, name)
        is_rare = name == "mean" and self._run.technique in WITHOUT_PATCHES and sensor.type not in OF_OTHER_NUMBERS
        return Estimate(estimate.value, estimate.standard_error, (estimate.lower, estimate.upper), unit,
                        lambda: Errors.of_statistic(estimate, key, full_name, np.array(sensor.residuals(name)),
                                                    has_rare_light_alone=is_rare))

    def _is_grid(self) -> bool:
        return self._sensor.count[1] > 0

    def _shaped(self, array: Numbers) -> Numbers:
        """A view of the array in the shape of the readings."""
        return array.reshape(self._shape + array.shape[1:])


class Result(Run, Mapping[str, Reading]):
    """The readings of all sensors: `result["desk"]`, in the order of the scene."""

    def __init__(self, result: _stilb.Result, token: str | None = None, sums: Sums | None = None,
                 seeds: tuple[int, ...] = (), is_dimmed: bool = False) -> None:
        """`token`: of the same result, where it is made again. `sums`: what it was made of, where that is kept. `seeds`:
        where they are several."""
        super().__init__(result.summary(), seeds)
        self._result = result
        self._sums = sums
        self._is_dimmed = is_dimmed
        self._key = RunKey(token or uuid.uuid4().hex, self.seeds, result.confidence)
        self._readings = {sensor.name: Reading(sensor, self._run, self._key) for sensor in result.sensors}

    def __reduce__(self) -> tuple[Callable[..., Result], tuple[Any, ...]]:
        return Result, (self._result, self._key.token, self._sums, self._seeds, self._is_dimmed)

    def __getitem__(self, sensor: str) -> Reading:
        if sensor not in self._readings:
            raise KeyError(f"there is no result of a sensor {sensor!r}; there are: {', '.join(self._readings)}")
        return self._readings[sensor]

    def __iter__(self) -> Iterator[str]:
        return iter(self._readings)

    def __len__(self) -> int:
        return len(self._readings)

    @cached_property
    def shares(self) -> dict[str, Readings]:
        """What each light or group of lights, or each number of reflections gives, after scene.measure(by="light") or
        by="bounce": `result.shares["panel"]["desk"].mean`. The values add up to the readings. Colours are not known."""
        parts: dict[str, dict[str, Reading]] = {}
        for sensor in self._result.sensors:
            for name, share in sensor.shares():
                parts.setdefault(name, {})[sensor.name] = Reading(share, self._run, self._key, of=f"share {name}: ")
        return ByName({name: Readings(name, readings) for name, readings in parts.items()},
                      'this result has no shares: scene.measure(by="light") or by="bounce" has them')

    @cached_property
    def scenes(self) -> dict[str, Readings]:
        """The readings in the scene's light scenes (`scene.light_scenes`): `result.scenes["evening"]["desk"]`."""
        return ByName({lit.name: Readings(lit.name, {sensor.name: Reading(sensor, self._run, self._key, of=f"scene {lit.name}: ")
                                                     for sensor in lit.sensors}, lit.power_w)
                       for lit in self._result.light_scenes},
                      'the scene had no light scenes: scene.light_scenes["evening"] = {"panel": 0.2} adds one')

    def dimmed(self, lights: Mapping[str, float | Sequence[float]] | None = None, /,
               **named: float | Sequence[float]) -> Result:
        """The result with the lamps so, from the same samples: `result.dimmed(panel=0.4, corridor=0)`, or
        `result.dimmed({"panel": 0.4})`. A factor for a light or a group of lights, or three of them for red, green and blue.

        The run must have kept the lights apart: scene.measure(by="light"), or a light scene that tells them apart.
        """
        factors = factors_of({} if lights is None else lights) | factors_of(named)
        if self._is_dimmed:
            raise InputError("this result is a dimmed one already. Dim the one that it was made from, with the factors of all "
                             "lights at once.")
        if self._sums is None:
            raise InputError('this result has not kept the lights apart: scene.measure(by="light") does.')
        result = self._sums.result(factors)
        warn_of(result, 3)
        return result

    def covariance(self, first: str, second: str | None = None) -> Numbers:
        """The covariances of the values of two sensors, or of one: (n, m) for n and m readings in the order of
        `value.ravel()`, in the product of their units.

        They come from the R replicates. The root of the diagonal of covariance("desk") is the standard error, except for
        large grids, where standard errors are smoothed over neighbours.
        """
        columns = [self[name]._sensor.replicates for name in (first, second or first)]
        a, b = (column - column.mean(0) for column in columns)
        return np.asarray(a.T @ b / (len(a) * (len(a) - 1)))

    def to_json(self) -> str:
        """The document of `stilb measure --json` (docs/json.md)."""
        return self._result.json()

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each reading of all sensors: those of `Reading.to_pandas()`, with the sensor's name and
        the number of the reading as index, and quantity and unit. Needs pandas."""
        from . import tables

        return tables.table_of_all(self)

    def falsecolor(self, path: str | os.PathLike[str], *, sensors: Sequence[str] | None = None, log: bool = False,
                   minimum: float | None = None, maximum: float | None = None, isolines: bool = False, numbers: bool = False,
                   errors: bool = False) -> None:
        """Draws grids and areas in false colours, as .png or .svg, at one scale of metres and one of colours. The program
        `stilb`, which is installed with the package, does this.

        sensors   names of the grids (default: all)
        log       a logarithmic scale
        minimum   lower end of the scale (default: a round number); likewise `maximum`
        isolines  labelled lines of equal value
        numbers   the value of each cell
        errors    half of the 95 % intervals, after a ±
        """
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "result.json"
            file.write_text(self.to_json(), encoding="utf-8")
            names = [self[name].name for name in names_of("sensors", sensors or [], self)]
            program.run("falsecolor", file, output=program.absolute(path), sensor=names, log=log, min=minimum, max=maximum,
                        isolines=isolines, numbers=numbers, errors=errors)

    def __repr__(self) -> str:
        return "\n".join([*(f"{name}: {reading._text()}" for name, reading in self.items()), self._ending(),
                          *(f"Warning: {text}" for text in self._notes())])

    def _repr_html_(self) -> str:
        return _html_table(list(self.values())) + f"<p>{escape(self._ending())}</p>" + _html_notes(self)

    def _only(self, shape: tuple[int, ...]) -> Reading:
        """The only sensor's readings in another shape."""
        return Reading(self._result.sensors[0], self._run, self._key, shape)


class Image(Run):
    """A luminance picture. The arrays begin with the top row, and share the memory of the C++ library."""

    _samples = "passes"

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

    @property
    def depth(self) -> NDArray[np.float32]:
        """The distance from the camera [m] of the surface in each pixel's middle, (h, w); NaN where there is none."""
        return self._picture.depth

    @property
    def normals(self) -> NDArray[np.float32]:
        """The unit normals of the same surfaces, in the scene's coordinates, (h, w, 3); NaN where there is none."""
        return self._picture.normals

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes OpenEXR, Radiance or PNG, by the ending: .exr, .hdr, .png (docs/pictures.md)."""
        self._picture.save(Path(path))

    def falsecolor(self, path: str | os.PathLike[str], *, log: bool = False, minimum: float | None = None,
                   maximum: float | None = None, isolines: bool = False, numbers: bool = False) -> None:
        """Draws the luminance in false colours, as .png or .svg: as `Result.falsecolor`, by the program."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "picture.exr"
            self.save(file)
            program.run("falsecolor", file, output=program.absolute(path), log=log, min=minimum, max=maximum,
                        isolines=isolines, numbers=numbers)

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


def _html_table(readings: list[Reading]) -> str:
    head = "".join(f"<th>{title}</th>" for title in ("sensor", "quantity", "readings", "mean", "minimum", "maximum"))
    rows = [f"<tr><th>{escape(reading.name)}</th><td>{reading.quantity}</td>"
            f"<td>{' x '.join(map(str, reading.value.shape))}</td><td>{escape(str(reading.mean))}</td>"
            f"<td>{escape(str(reading.minimum))}</td><td>{escape(str(reading.maximum))}</td></tr>"
            for reading in readings]
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _html_notes(run: Run) -> str:
    """How the run ended where that was before its goal, and its warnings."""
    head = [] if run.converged else [run._convergence()]
    return "".join(f"<p><b>{escape(text)}</b></p>" for text in head) + "".join(
        f"<p>Warning: {escape(text)}</p>" for text in run._notes())
