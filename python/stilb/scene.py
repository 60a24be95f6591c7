"""Scenes: read from files, or built in code; measured, rendered and solved."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableMapping
from pathlib import Path
from typing import Any, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _stilb
from ._stilb import InputError
from .options import DESCRIPTION, Limits, options
from .parts import Mesh, Part, part_of
from .progress import Progress, sink_of
from .results import Image, Reading, Result
from .solution import Solution

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
    progress  True for a line on stderr, or a function that gets a `stilb.Progress` and may return False to end the run
              with its result so far

    Ctrl-C ends a run with KeyboardInterrupt. Other Python threads go on during a run.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name
        self.run: dict[str, Any] = {}
        self.defaults: dict[str, Any] = {}
        self._path: Path | None = None
        self._directory = Path(".")
        self._sections = {section: Section(section) for section in SECTIONS}
        self._base: _stilb.Scene | None = None
        self._built: _stilb.Scene | None = None
        self._built_state: Any = None

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, progress: Progress = None, **settings: Unpack[ImportSettings]) -> Scene:
        """Reads a scene file, or a scene of another program. Errors name file, line and key.

        The parts of a file that is not TOML (glTF, OBJ, Radiance) stay as they are; others can be added to them. How it is
        read can be set:

        scale        metres per unit of the file, or "auto"
        up           the axis of the file that points upwards: "y", "z" or "auto"
        light_scale  a factor on all light
        textures     True: surfaces show the textures of their base colours; False: the mean of each counts
        progress     as in runs: help(stilb.Scene)
        """
        scene = cls()
        scene._path = Path(path)
        scene._directory = scene._path.parent
        scene._built = _stilb.Scene.load(scene._path, [_setting(key, value) for key, value in settings.items()],
                                         sink_of(progress))
        scene.name = scene._built.name()
        document = _toml_document(scene._path)
        if document is None:
            scene._base = scene._built
        else:
            scene.run = document.get("run", {})
            scene.defaults = document.get("defaults", {})
            scene._sections = {section: Section(section, document.get(section)) for section in SECTIONS}
        scene._built_state = scene._state()
        return scene

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
        scene = self._scene()
        names = [sensors] if isinstance(sensors, str) else list(sensors or [])
        return Result(_stilb.measure(scene, options(scene, limits), names, sink_of(progress)))

    def illuminance(self, points: ArrayLike, normals: ArrayLike, *, progress: Progress = None, **limits: Unpack[Limits]) -> Reading:
        """The illuminance [lx] on surface elements anywhere in the scene.

        `points` (..., 3) are positions [m], `normals` (..., 3) or (3,) the directions that the elements face, of any
        length. The values have the shape of the points.
        """
        return self._along(_stilb.illuminance, points, normals, progress, limits)

    def luminance(self, positions: ArrayLike, directions: ArrayLike, *, progress: Progress = None,
                  **limits: Unpack[Limits]) -> Reading:
        """The luminance [cd/m2] that is seen from `positions` along `directions`, of shapes (..., 3) or (3,)."""
        return self._along(_stilb.luminance, positions, directions, progress, limits)

    def render(self, camera: str = "", *, progress: Progress = None, **limits: Unpack[Limits]) -> Image:
        """A luminance picture; the camera's name may be left out where the scene has one only."""
        scene = self._scene()
        return Image(_stilb.render(scene, camera, options(scene, limits), sink_of(progress)))

    def solve(self, *, progress: Progress = None, **limits: Unpack[Limits]) -> Solution:
        """The light on all surfaces, from which pictures of all cameras with other lamps are made."""
        scene = self._scene()
        return Solution(_stilb.solve(scene, options(scene, limits), sink_of(progress)))

    def to_dict(self) -> dict[str, Any]:
        """The document of the scene file."""
        if self._base:
            raise InputError(f"{self._path}: the parts of this file cannot be written as a scene file here. Make it one by "
                             "`stilb import`, and load that.")
        document: dict[str, Any] = {"scene": {"name": self.name}} if self.name else {}
        document |= {section: parts for section, parts in (("defaults", self.defaults), ("run", self.run)) if parts}
        for section in SECTIONS:
            if self._sections[section]:
                document[section] = {name: part.to_dict() for name, part in self._sections[section].items()}
        return document

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file (TOML), which is the scene's own from now on. It needs the package tomli-w."""
        import tomli_w

        file = Path(path)
        document = _plain(self.to_dict(), lambda name: _moved(name, self._directory, file.parent))
        file.write_text(tomli_w.dumps(document), encoding="utf-8")
        loaded = Scene.load(file)
        self.__dict__.update(loaded.__dict__)

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(parts)} {section}" for section, parts in self._sections.items())
        return f"<stilb.Scene {self.name!r}: {counts}{f' added to {self._path}' if self._base else ''}>"

    def _state(self) -> Any:
        parts = tuple(section._state() for section in self._sections.values())
        return (self.name, repr(self.run), repr(self.defaults), parts)

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
               progress: Progress, limits: Limits) -> Reading:
        points, rays = _rays(positions, directions)
        scene = self._scene()
        result = measure(scene, rays, options(scene, limits), sink_of(progress))
        return Result(result)._only(points.shape[:-1])


def load(path: str | os.PathLike[str], *, progress: Progress = None, **settings: Unpack[ImportSettings]) -> Scene:
    """Reads a scene from a file: `help(stilb.Scene.load)`.

    `settings` are `scale`, `up`, `light_scale` and `textures` of scenes of other programs.
    """
    return Scene.load(path, progress=progress, **settings)


def _setting(key: str, value: Any) -> str:
    """As on the command line."""
    return f"import.{key}={str(value).lower() if isinstance(value, bool) else value}"


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


def _plain(value: Any, move: Callable[[str], str], key: str = "") -> Any:
    """The value in types of TOML, with the names of files moved."""
    if isinstance(value, Mapping):
        return {name: _plain(inner, move, name) for name, inner in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(inner, move) for inner in value]
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    return move(value) if key in ("file", "geometry") and isinstance(value, str) else value
