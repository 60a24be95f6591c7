"""Scenes: read from files, or built in code; measured, rendered and solved."""

from __future__ import annotations

import copy
import os
import tempfile
import tomllib
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableMapping
from pathlib import Path
from typing import Any, TypedDict, TypeVar, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _stilb, program
from ._stilb import InputError
from .estimates import ResultWarning
from .options import DESCRIPTION, Limits, SightLimits, options
from .parts import Mesh, Part, part_of
from .progress import Progress, called
from .results import Image, Reading, Result, Run, warn_of
from .runs import ResumableRun
from .solution import Solution
from .sums import Sums
from .toml import document_text, value_text

__all__ = ["Scene", "Section", "load"]

SECTIONS = ("materials", "objects", "lights", "sensors")

class ImportSettings(TypedDict, total=False):
    """How a scene of another program is read: `help(stilb.load)`."""

    scale: float | str
    up: str
    light_scale: float
    textures: bool


class Section(MutableMapping[str, Part]):
    """The materials, objects, lights or sensors of a scene, by name and in order.

    A value is a part such as `stilb.Diffuse(reflectance=0.6)`, or a dictionary with the keys of a scene file.
    """

    def __init__(self, section: str, parts: Mapping[str, Any] | None = None) -> None:
        self._section = section
        self._parts: dict[str, Part] = {}
        for name, part in (parts or {}).items():
            self[name] = part

    def __getitem__(self, name: str) -> Part:
        if name not in self._parts:
            raise KeyError(f"there is no {name!r} in {self._section}; there are: {', '.join(self._parts) or 'none'}")
        return self._parts[name]

    def __setitem__(self, name: str, part: Part | Mapping[str, Any]) -> None:
        self._parts[name] = part_of(self._section, part, name)

    def __delitem__(self, name: str) -> None:
        self[name]
        del self._parts[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def __repr__(self) -> str:
        return repr(self._parts)

    def _state(self) -> tuple[Any, ...]:
        return tuple((name, part._state()) for name, part in self._parts.items())


class Scene:
    __doc__ = f"""A room, its lights and its sensors.

    `stilb.load(path)` reads one from a file, `Scene(name)` makes an empty one, to which parts are added:

        scene = stilb.Scene("room")
        scene.materials["wall"] = stilb.Diffuse(reflectance=0.6)
        scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
        scene.lights["bulb"] = stilb.PointLight(position=(2, 1.5, 2.3), flux=800)
        scene.sensors["desk"] = stilb.Illuminance(position=(1, 1, 0.75), normal=(0, 0, 1))
        print(scene.measure(error=0.01)["desk"])

    Lengths are in metres with z up, angles in degrees, fluxes in lm. Wrong input raises `stilb.InputError` when the scene
    is used.

    All runs have these arguments; without `error`, `time` and `paths`, those of the scene's section `run` count, or else
    1 % or a minute:

{DESCRIPTION}
    progress    True for a line on stderr, or a function that gets a `stilb.Progress` and may return False to end the run
                with its result so far

    Ctrl-C ends a run with KeyboardInterrupt, whose attribute `result` has the result so far (or None). Other Python threads
    go on during a run. Warnings of a run, and that it did not converge, are Python warnings (`stilb.ResultWarning`).

    Scenes can be copied and pickled. A copy has parts of its own.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name
        self.run: dict[str, Any] = {}
        self.defaults: dict[str, Any] = {}
        self.light_scenes: dict[str, dict[str, Any]] = {}  # states of the lamps: {"evening": {"panel": 0.2, "others": 0}}
        self._path: Path | None = None
        self._directory = Path(".")
        self._sections = {section: Section(section) for section in SECTIONS}
        self._settings: list[str] = []  # with which the file was read
        self._base: _stilb.Scene | None = None  # a file of another format
        self._built: _stilb.Scene | None = None
        self._built_state: Any = None

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None, progress: Progress = None,
             **settings: Unpack[ImportSettings]) -> Scene:
        """Reads a scene file, or a scene of another program. Errors name file, line and key.

        The parts of a file that is not TOML (glTF, OBJ, Radiance) stay as they are; others can be added to them. How it is
        read can be set:

        scale        metres per unit of the file, or "auto"
        up           the axis of the file that points upwards: "y", "z" or "auto"
        light_scale  a factor on all light
        textures     True: surfaces show the textures of their base colours; False: the mean of each counts
        set          other values for keys, as --set of the command line: {"materials.wall.reflectance": 0.5}
        progress     as in runs: help(stilb.Scene)
        """
        chosen = {f"import.{key}": value for key, value in settings.items()} | dict(set or {})
        texts = [f"{key}={value_text(value)}" for key, value in chosen.items()]
        return called(progress, lambda sink: _stilb.Scene.load(Path(path), texts, sink),
                      lambda read: cls._of_file(read, texts, set or {}))

    @classmethod
    def parse(cls, text: str, directory: str | os.PathLike[str] = ".") -> Scene:
        """Reads a scene from the text of a scene file. Names of files in it are relative to `directory`."""
        built = _stilb.Scene.parse(text, Path(directory))
        scene = cls.from_dict(tomllib.loads(text), directory)
        scene._keep(built)
        return scene

    @classmethod
    def from_dict(cls, document: Mapping[str, Any], directory: str | os.PathLike[str] = ".") -> Scene:
        """The scene of a document such as `to_dict` returns, and as scene files have. Its parts are checked when the scene
        is used. Names of files are relative to `directory`."""
        for section, content in document.items():
            _require_section(section)
            if not isinstance(content, Mapping):
                raise InputError(f"{section}: found a value of type {type(content).__name__}. Allowed: a dictionary.")
        scene = cls(document.get("scene", {}).get("name", ""))
        scene._directory = Path(directory)
        scene.run = copy.deepcopy(dict(document.get("run", {})))
        scene.defaults = copy.deepcopy(dict(document.get("defaults", {})))
        scene.light_scenes = copy.deepcopy(dict(document.get("scenes", {})))
        scene._sections = {section: Section(section, document.get(section)) for section in SECTIONS}
        return scene

    @classmethod
    def _of_file(cls, read: _stilb.Scene, settings: list[str], set: Mapping[str, Any]) -> Scene:
        path = Path(read.path())
        document = _toml_document(path)
        scene = cls(read.name()) if document is None else cls.from_dict(document, path.parent)
        scene._path = path
        scene._directory = path.parent
        scene._settings = settings
        if document is None:
            scene._base = read
        else:
            for key, value in set.items():
                scene.set(key, value)
        scene._keep(read)
        return scene

    def set(self, key: str, value: Any) -> None:
        """Sets a key by its full name, as --set of the command line does: `scene.set("materials.wall.reflectance", 0.5)`.

        The value of `materials.wall` is a part, or a dictionary with the keys of a scene file. Names with dots need quotes.
        """
        first, *names = _names(key)
        _require_section(first)
        if first == "scene" and names == ["name"]:
            self.name = value
        elif first in ("run", "defaults") and names:
            setattr(self, first, _with(getattr(self, first), names, value))
        elif first == "scenes" and names:
            self.light_scenes = _with(self.light_scenes, names, value)
        elif first in SECTIONS and len(names) == 1:
            self._sections[first][names[0]] = value
        elif first in SECTIONS and names:
            name, attribute, *inner = names
            if name not in self._sections[first]:
                known = list(self._sections[first])
                raise InputError(f'{key}: there is no "{name}" in {first}.{_stilb.did_you_mean(name, known)} Allowed: '
                                 f"{', '.join(known) or 'none'}.")
            part = self._sections[first][name]
            try:
                setattr(part, attribute, _with(getattr(part, attribute, {}), inner, value) if inner else value)
            except InputError as error:
                raise InputError(f"{key}: {error}") from None
        else:
            raise InputError(f"{key}: there is no such key. Allowed: names such as materials.wall.reflectance.")

    def __copy__(self) -> Scene:
        """A scene with parts of its own."""
        made = Scene(self.name)
        made.__dict__.update(self.__dict__)
        made.run, made.defaults = copy.deepcopy(self.run), copy.deepcopy(self.defaults)
        made.light_scenes = copy.deepcopy(self.light_scenes)
        made._sections = copy.deepcopy(self._sections)
        if self._built is not None and self._state() == self._built_state:
            made._built_state = made._state()
        else:
            made._built = None
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return copy.copy(self)

    def __getstate__(self) -> dict[str, Any]:
        """What other processes, and other working directories, can make the scene of."""
        own = {"_base": self._base is not None, "_built": None, "_built_state": None,
               "_directory": self._directory.absolute()}
        return {**self.__dict__, **own, "_path": self._path and self._path.absolute()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._base = _stilb.Scene.load(state["_path"], state["_settings"], None) if state["_base"] else None

    @property
    def materials(self) -> Section:
        """The materials, by name."""
        return self._sections["materials"]

    @property
    def objects(self) -> Section:
        """The objects, by name."""
        return self._sections["objects"]

    @property
    def lights(self) -> Section:
        """The lights, by name."""
        return self._sections["lights"]

    @property
    def sensors(self) -> Section:
        """The sensors and cameras, by name."""
        return self._sections["sensors"]

    def check(self) -> list[str]:
        """The warnings of `stilb info` about the scene, such as one of a lamp behind a wall."""
        return _stilb.validate(self._scene())

    def measure(self, *, sensors: Iterable[str] | None = None, progress: Progress = None, **limits: Unpack[Limits]) -> Result:
        """Measures all sensors but cameras, or those of these names. `limits`: see `help(stilb.Scene)`."""
        scene, names, state = self._scene(), self._names(sensors), _stilb.RunState()
        chosen = options(scene, limits)
        return _warned(called(progress, lambda sink: _stilb.measure_state(scene, chosen, names, state, False, sink),
                              lambda result: Sums(self, names, limits, state).wrapped(result)))

    def start(self, *, sensors: Iterable[str] | None = None, progress: Progress = None,
              **limits: Unpack[Limits]) -> ResumableRun:
        """A run of `measure` that can be followed, saved and continued. Nothing is computed yet:

            run = scene.start(error=0.001, seed=7)
            for partial in run:                     # a Result after each error estimate; `break` keeps what there is
                print(partial["desk"].mean)
                run.save("hall.run")
        """
        options(self._scene(), limits)  # for its messages
        return ResumableRun(Sums(copy.copy(self), self._names(sensors), limits), progress)

    def _names(self, sensors: Iterable[str] | None) -> list[str]:
        """Of the sensors that are chosen; none for all."""
        names = [] if sensors is None else [sensors] if isinstance(sensors, str) else list(sensors)
        if sensors is not None and not names:
            raise InputError(f"sensors: the list is empty. Allowed: names of sensors ({', '.join(self._scene().sensors())}); "
                             "None for all.")
        return names

    def illuminance(self, points: ArrayLike, normals: ArrayLike, *, progress: Progress = None, **limits: Unpack[Limits]) -> Reading:
        """The illuminance [lx] on surface elements anywhere in the scene.

        `points` (..., 3) are positions [m], `normals` (..., 3) or (3,) the directions that the elements face, of any
        length. The values have the shape of the points.
        """
        return self._along(_stilb.illuminance, points, normals, progress, limits)

    def luminance(self, positions: ArrayLike, directions: ArrayLike, *, progress: Progress = None,
                  **limits: Unpack[SightLimits]) -> Reading:
        """The luminance [cd/m2] that is seen from `positions` along `directions`, of shapes (..., 3) or (3,)."""
        return self._along(_stilb.luminance, positions, directions, progress, limits)

    def render(self, camera: str = "", *, progress: Progress = None, **limits: Unpack[Limits]) -> Image:
        """A luminance picture; the camera's name may be left out where the scene has one only."""
        scene = self._scene()
        chosen = options(scene, limits)
        return _warned(called(progress, lambda sink: _stilb.render(scene, camera, chosen, sink), Image))

    def solve(self, *, degree: int | None = None, progress: Progress = None, **limits: Unpack[Limits]) -> Solution:
        """The light on all surfaces, from which pictures of all cameras with other lamps are made.

        `degree`: of the directional basis that stores the light on glossy surfaces, 0 to 12; a higher one is sharper and
        takes more memory.
        """
        scene = self._scene()
        chosen = options(scene, limits)
        solved = copy.copy(self)
        return _warned(called(progress, lambda sink: _stilb.solve(scene, chosen, sink, degree),
                              lambda solution: Solution(solution, solved)))

    def export(self, folder: str | os.PathLike[str], format: str) -> list[Path]:
        """Writes the scene, its points and its views for "mitsuba" or "radiance" (docs/export.md). Returns the files; what
        has no equal in the other program is warned of."""
        written = _stilb.export_scene(self._scene(), format, Path(folder))
        for text in written.warnings:
            warnings.warn(text, ResultWarning, stacklevel=2)
        return written.files

    def report(self, path: str | os.PathLike[str], *, sensors: Iterable[str] | None = None, readings: bool = False,
               view_time: float | None = None, view_passes: int | None = None, **limits: Unpack[Limits]) -> None:
        """Measures the sensors, renders the cameras, and writes a page for clients (.html, docs/report.md). The program
        `stilb`, which is installed with the package, does this.

        `sensors`: names of sensors and cameras; all by default. `readings`: whether the page lists all of them. `view_time`
        [s] or `view_passes`: of each camera (default: 60 s). `limits`: of the readings, see `help(stilb.Scene)`.
        """
        options(self._scene(), limits)  # for its messages
        with tempfile.TemporaryDirectory() as folder:
            file, settings = Path(folder) / "scene.toml", list[str]()
            if self._path is not None and self._scene().path() == self._path:  # as it was read
                file, settings = self._path, self._settings
            else:
                copy.copy(self).save(file)
            program.run("report", file, output=program.absolute(path), set=settings, sensor=list(sensors or []),
                        readings=readings, view_time=view_time, view_passes=view_passes, quiet=True, **limits)

    def to_dict(self) -> dict[str, Any]:
        """The document of the scene file."""
        if self._base:
            raise InputError(f"{self._path}: the parts of this file cannot be written as a scene file here. Make it one by "
                             "`stilb import`, and load that.")
        return self._document()

    def _document(self) -> dict[str, Any]:
        document: dict[str, Any] = {"scene": {"name": self.name}} if self.name else {}
        document |= {section: parts for section, parts in (("defaults", self.defaults), ("run", self.run)) if parts}
        for section in SECTIONS:
            if self._sections[section]:
                document[section] = {name: part.to_dict() for name, part in self._sections[section].items()}
        return document | ({"scenes": self.light_scenes} if self.light_scenes else {})

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file (TOML), which is the scene's own from now on."""
        file = Path(path)
        document = _relocated(self.to_dict(), lambda name: _moved(name, self._directory, file.parent))
        file.write_text(document_text(document), encoding="utf-8")
        loaded = Scene.load(file)
        self.__dict__.update(loaded.__dict__)

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(parts)} {section}" for section, parts in self._sections.items())
        return f"<stilb.Scene {self.name!r}: {counts}{f' added to {self._path}' if self._base else ''}>"

    def _keep(self, built: _stilb.Scene) -> None:
        """`built`: the scene as it is now."""
        self._built = built
        self._built_state = self._state()

    def _state(self) -> Any:
        parts = tuple(section._state() for section in self._sections.values())
        return (self.name, repr(self.run), repr(self.defaults), repr(self.light_scenes), parts)

    def _scene(self) -> _stilb.Scene:
        """The scene in C++: that of the file, or a new one where something was changed."""
        state = self._state()
        if self._built is None or state != self._built_state:
            self._built = self._build()
            self._built_state = state
        return self._built

    def _build(self) -> _stilb.Scene:
        builder = _stilb.SceneBuilder(self._base or self.name)
        builder.directory(self._directory)
        builder.run(self.run)
        builder.defaults(self.defaults)
        for name, factors in self.light_scenes.items():
            builder.light_scene(name, factors)
        add = {"materials": builder.material, "objects": builder.object, "lights": builder.light,
               "sensors": builder.sensor}
        for section in SECTIONS:
            for name, part in self._sections[section].items():
                keys = part.to_dict()
                if isinstance(part, Mesh) and "vertices" in keys and "faces" in keys:
                    del keys["shape"]
                    builder.mesh(name, keys.pop("vertices"), keys.pop("faces"), keys)
                else:
                    add[section](name, keys)
        return builder.build()

    def _along(self, measure: Callable[..., _stilb.Result], positions: ArrayLike, directions: ArrayLike,
               progress: Progress, limits: SightLimits) -> Reading:
        points, rays = _rays(positions, directions)
        scene = self._scene()
        chosen = options(scene, limits)
        reading = called(progress, lambda sink: measure(scene, rays, chosen, sink),
                         lambda result: Result(result)._only(points.shape[:-1]))
        warn_of(reading.run)
        return reading


Ended = TypeVar("Ended", bound=Run)


def _warned(run: Ended) -> Ended:
    warn_of(run)
    return run


def load(path: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None, progress: Progress = None,
         **settings: Unpack[ImportSettings]) -> Scene:
    """Reads a scene from a file: `help(stilb.Scene.load)`.

    `set` has other values for keys: {"materials.wall.reflectance": 0.5}. `settings` are `scale`, `up`, `light_scale` and
    `textures` of scenes of other programs.
    """
    return Scene.load(path, set=set, progress=progress, **settings)


def _names(key: str) -> list[str]:
    """The names that the dots of a key separate."""
    try:
        inner: Any = tomllib.loads(f"{key} = 0")
    except tomllib.TOMLDecodeError:
        raise InputError(f"{key}: this is no key. Allowed: names such as materials.wall.reflectance.") from None
    names = []
    while isinstance(inner, dict):
        ((name, inner),) = inner.items()
        names.append(name)
    return names


def _with(table: Mapping[str, Any], names: list[str], value: Any) -> dict[str, Any]:
    """The table with another value for a key in it, or in a table in it."""
    first, *others = names
    inner = table.get(first, {})
    return {**table, first: _with(inner if isinstance(inner, Mapping) else {}, others, value) if others else value}


def _require_section(section: str) -> None:
    known = ["scene", "defaults", "run", *SECTIONS, "scenes"]
    if section not in known:
        raise InputError(f'unknown section "{section}".{_stilb.did_you_mean(section, known)} Allowed: {", ".join(known)}.')


def _toml_document(path: Path) -> dict[str, Any] | None:
    """The content of a scene file; None where the file is of another format."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return None


def _rays(positions: ArrayLike, directions: ArrayLike) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """The positions, and both side by side as (n, 6)."""
    try:
        points, ways = np.broadcast_arrays(np.asarray(positions, np.float64), np.asarray(directions, np.float64))
    except ValueError as error:
        raise InputError(f"positions and directions do not fit: {error}. Allowed: (..., 3) and (..., 3) or (3,).") from None
    if points.ndim == 0 or points.shape[-1] != 3 or points.size == 0:
        raise InputError(f"found positions of shape {points.shape}. Allowed: (..., 3), one position or more.")
    return points, np.ascontiguousarray(np.concatenate([points.reshape(-1, 3), ways.reshape(-1, 3)], axis=1))


def _moved(file: str, old: Path, new: Path) -> str:
    """The name of a file as seen from another folder."""
    return file if os.path.isabs(file) else Path(os.path.relpath(old / file, new)).as_posix()


def _relocated(value: Any, move: Callable[[str], str], key: str = "") -> Any:
    """The value with the names of files moved."""
    if isinstance(value, Mapping):
        return {name: _relocated(inner, move, name) for name, inner in value.items()}
    if key in ("file", "geometry") and isinstance(value, str | os.PathLike):
        return move(os.fspath(value))
    return value
