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
from ._wrong import names_of, wrong_type
from .estimates import ResultWarning
from .options import DESCRIPTION, Limits, SightLimits, options
from .parts import Mesh, Part, part_of
from .progress import Progress, called, require_progress
from .results import Image, Reading, Result, Run, warn_of
from .runs import ResumableRun
from .scene_files import ReadFile, replace
from .solution import Solution
from .sums import Sums
from .toml import document_text, value_text

__all__ = ["Scene", "Section", "load"]

SECTIONS = ("materials", "objects", "lights", "sensors")
TABLES = ("run", "defaults", "light_scenes")  # sections without parts


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
        if not isinstance(name, str):
            raise wrong_type(f"{self._section}: the name of a part", name, "a text")
        self._parts[name] = part_of(self._section, part, name)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise InputError(f"{self._section} have no attribute {name}: parts have keys. Allowed: "
                             f'scene.{self._section}["{name}"] = ...')
        super().__setattr__(name, value)

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
        self._file: ReadFile | None = None
        self._directory = Path(".")
        self._sections = {section: Section(section) for section in SECTIONS}
        self._settings: list[str] = []  # with which the file was read
        self._base: _stilb.Scene | None = None  # a file of another format
        self._built: _stilb.Scene | None = None
        self._built_state: Any = None

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "name" and not isinstance(value, str):
            raise wrong_type("name", value, "a text")
        if name in TABLES:
            value = _table(name, value)
        elif name in SECTIONS:
            raise InputError(f"{name}: a scene keeps its {name}. Allowed: scene.{name}[...] = ..., scene.{name}.update(...), "
                             f"scene.{name}.clear().")
        elif name != "name" and not name.startswith("_"):
            raise InputError(_unknown_attribute(name))
        super().__setattr__(name, value)

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
        if unknown := settings.keys() - ImportSettings.__annotations__:
            allowed = ", ".join(["set", "progress", *ImportSettings.__annotations__])
            raise TypeError(f"unknown argument {min(unknown)}; allowed: {allowed}")
        values = _table("set", {} if set is None else set)
        chosen = {f"import.{key}": value for key, value in settings.items()} | values
        texts = [f"{key}={value_text(value, key)}" for key, value in chosen.items()]
        return called(progress, lambda sink: _stilb.Scene.load(Path(path), texts, sink),
                      lambda read: cls._of_file(read, texts, values))

    @classmethod
    def parse(cls, text: str, directory: str | os.PathLike[str] = ".") -> Scene:
        """Reads a scene from the text of a scene file. Names of files in it are relative to `directory`."""
        if not isinstance(text, str):
            raise wrong_type("text", text, "the text of a scene file; stilb.load(path) reads a file")
        built = _stilb.Scene.parse(text, Path(directory))
        scene = cls.from_dict(tomllib.loads(text), directory)
        scene._keep(built)
        return scene

    @classmethod
    def from_dict(cls, document: Mapping[str, Any], directory: str | os.PathLike[str] = ".") -> Scene:
        """The scene of a document such as `to_dict` returns, and as scene files have. Its parts are checked when the scene
        is used. Names of files are relative to `directory`."""
        for section, content in _table("document", document).items():
            _require_section(section)
            _table(section, content)
        title = document.get("scene", {})
        if unknown := {*title} - {"name"}:
            raise InputError(f'scene: unknown key "{min(unknown, key=str)}". Allowed: name.')
        scene = cls(title.get("name", ""))
        scene._directory = Path(directory)
        scene.run = copy.deepcopy(dict(document.get("run", {})))
        scene.defaults = copy.deepcopy(dict(document.get("defaults", {})))
        scene.light_scenes = copy.deepcopy(dict(document.get("scenes", {})))
        scene._sections = {section: Section(section, document.get(section)) for section in SECTIONS}
        return scene

    @classmethod
    def _of_file(cls, read: _stilb.Scene, settings: list[str], set: Mapping[str, Any]) -> Scene:
        file = ReadFile(Path(read.path()))
        folder = file.path.parent.absolute()
        scene = cls(read.name()) if file.document is None else cls.from_dict(file.document, folder)
        scene._file = file
        scene._directory = folder
        scene._settings = settings
        if file.document is None:
            scene._base = read
        else:
            for key, value in set.items():
                scene.set(key, value)
        scene._keep(read)
        return scene

    @property
    def _path(self) -> Path | None:
        """The scene's own file."""
        return self._file.path if self._file else None

    def set(self, key: str, value: Any) -> None:
        """Sets a key by its full name, as --set of the command line does: `scene.set("materials.wall.reflectance", 0.5)`.

        The value of `materials.wall` is a part, or a dictionary with the keys of a scene file. Names with dots need quotes.
        """
        first, *names = _names(key)
        _require_section(first)
        if first == "scene" and names == ["name"]:
            self.name = value
        elif first in ("run", "defaults") and names:
            setattr(self, first, _with(getattr(self, first), names, value, first))
        elif first == "scenes" and names:
            self.light_scenes = _with(self.light_scenes, names, value, first)
        elif first in SECTIONS and len(names) == 1:
            self._sections[first][names[0]] = value
        elif first in SECTIONS and names:
            self._set_of_part(key, first, *names, value=value)
        else:
            raise InputError(f"{key}: there is no such key. Allowed: names such as materials.wall.reflectance.")

    def _set_of_part(self, key: str, section: str, name: str, attribute: str, *inner: str, value: Any) -> None:
        if name not in self._sections[section]:
            known = list(self._sections[section])
            raise InputError(f'{key}: there is no "{name}" in {section}.{_stilb.did_you_mean(name, known)} Allowed: '
                             f"{', '.join(known) or 'none'}.")
        part = self._sections[section][name]
        if inner:
            before = {attribute: part.to_dict()[attribute]} if attribute in part.to_dict() else {}
            value = _with(before, [attribute, *inner], value, f"{section}.{name}")[attribute]
        try:
            setattr(part, attribute, value)
        except InputError as error:
            raise InputError(f"{key}: {error}") from None

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
        return {**self.__dict__, **own, "_file": self._file and self._file.absolute()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._base = None
        if state["_base"]:
            self._require_file()
            self._base = _stilb.Scene.load(state["_file"].path, state["_settings"], None)

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
        require_progress(progress)
        scene, names = self._scene(), self._names(sensors)
        _stilb.RunState().adopt(scene, options(scene, limits), names)  # for its messages
        return ResumableRun(Sums(copy.copy(self), names, limits), progress)

    def _names(self, sensors: Iterable[str] | None) -> list[str]:
        """Of the sensors that are chosen; none for all."""
        if sensors is None:
            return []
        names = names_of("sensors", sensors, self._scene().sensors())
        if not names:
            raise InputError(f"sensors: the list is empty. Allowed: names of sensors ({', '.join(self._scene().sensors())}); "
                             "None for all.")
        return names

    def illuminance(self, points: ArrayLike, normals: ArrayLike, *, progress: Progress = None, **limits: Unpack[Limits]) -> Reading:
        """The illuminance [lx] on surface elements anywhere in the scene.

        `points` (..., 3) are positions [m], `normals` (..., 3) or (3,) the directions that the elements face, of any
        length. The values have the shape of the points.
        """
        rays = _rays("points", points, "normals", normals)
        return self._along(_stilb.illuminance, *rays, progress, limits)

    def luminance(self, positions: ArrayLike, directions: ArrayLike, *, progress: Progress = None,
                  **limits: Unpack[SightLimits]) -> Reading:
        """The luminance [cd/m2] that is seen from `positions` along `directions`, of shapes (..., 3) or (3,)."""
        rays = _rays("positions", positions, "directions", directions)
        return self._along(_stilb.luminance, *rays, progress, limits)

    def render(self, camera: str = "", *, progress: Progress = None, **limits: Unpack[Limits]) -> Image:
        """A luminance picture; the camera's name may be left out where the scene has one only."""
        if not isinstance(camera, str):
            raise wrong_type("camera", camera, "the name of a camera")
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
            program.run("report", file, output=program.absolute(path), set=settings,
                        sensor=names_of("sensors", sensors or [], self._scene().sensors()),
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
        """Writes a scene file (TOML), which is the scene's own from now on. A scene with mistakes is not written."""
        file = Path(path)
        document = _relocated(self.to_dict(), lambda name: _moved(name, self._directory, file.parent))
        text = document_text(document)
        self._scene()  # for its messages, which name the part
        _stilb.Scene.parse(text, file.parent)  # as it will be read, with the files that it names
        replace(file, text)
        self.__dict__.update(Scene.load(file).__dict__)

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
        if self._built is None or state != self._built_state or self._has_lost_file():
            self._built = self._build()
            self._built_state = state
        return self._built

    def _has_lost_file(self) -> bool:
        """Whether what is built refers to a file that is not as it was read."""
        refers = self._base is not None or (self._built is not None and self._built.path().name != "")
        return refers and self._file is not None and not self._file.is_as_read()

    def _require_file(self) -> None:
        """Parts of a scene file are kept; those of another format are read again."""
        if self._file is None or self._file.is_as_read():
            return
        raise InputError(f"{self._path}: this file is not there any more, or has changed since it was read, and scenes of other "
                         "formats than TOML need it as it was. Load it again, or make it a scene file by `stilb import`.")

    def _build(self) -> _stilb.Scene:
        if self._base is not None:
            self._require_file()
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

    def _along(self, measure: Callable[..., _stilb.Result], shape: tuple[int, ...], rays: np.ndarray[Any, Any],
               progress: Progress, limits: SightLimits) -> Reading:
        scene = self._scene()
        chosen = options(scene, limits)
        reading = called(progress, lambda sink: measure(scene, rays, chosen, sink),
                         lambda result: Result(result)._only(shape))
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


def _with(table: Mapping[str, Any], names: list[str], value: Any, place: str) -> dict[str, Any]:
    """The table with another value for a key in it, or in a table in it. `place`: its own name, for messages."""
    first, *others = names
    if not others:
        return {**table, first: value}
    inner, key = table.get(first, {}), f"{place}.{first}"
    if not isinstance(inner, Mapping):
        raise InputError(f"{key}.{'.'.join(others)}: {key} has no keys of its own, as its value is {inner!r}. Set all of it: "
                         f"{key}.")
    return {**table, first: _with(inner, others, value, key)}


def _table(what: str, value: object) -> dict[str, Any]:
    if not isinstance(value, Mapping):
        raise wrong_type(what, value, "a dictionary")
    return dict(value)


def _unknown_attribute(name: str) -> str:
    known = ["name", *TABLES, *SECTIONS]
    meant = ' Did you mean "light_scenes"?' if name == "scenes" else _stilb.did_you_mean(name, known)
    return f'Scene has no attribute "{name}".{meant} Allowed: {", ".join(known)}.'


def _require_section(section: str) -> None:
    known = ["scene", "defaults", "run", *SECTIONS, "scenes"]
    if section not in known:
        raise InputError(f'unknown section "{section}".{_stilb.did_you_mean(section, known)} Allowed: {", ".join(known)}.')


def _rays(name: str, positions: ArrayLike, other_name: str,
          directions: ArrayLike) -> tuple[tuple[int, ...], np.ndarray[Any, Any]]:
    """The shape of the readings, and positions and directions side by side as (n, 6)."""
    points, ways = _triples(name, positions), _triples(other_name, directions)
    try:
        points, ways = np.broadcast_arrays(points, ways)
    except ValueError:
        raise InputError(f"{name} of shape {points.shape} and {other_name} of shape {ways.shape} do not fit. Allowed: "
                         "(..., 3) of both, or (3,) for all.") from None
    sides = [points.reshape(-1, 3), ways.reshape(-1, 3)]
    return points.shape[:-1], np.ascontiguousarray(np.concatenate(sides, axis=1))


def _triples(name: str, values: ArrayLike) -> np.ndarray[Any, Any]:
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        raise wrong_type(name, values, "numbers (x, y, z), as an array of shape (..., 3)") from None
    if array.ndim == 0 or array.shape[-1] != 3 or array.size == 0:
        raise InputError(f"{name}: found an array of shape {array.shape}. Allowed: (..., 3), one (x, y, z) or more.")
    return array


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
