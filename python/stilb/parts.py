"""The parts of scenes: materials, objects, lights and sensors.

Each type that scene files have is a class: `stilb.Diffuse(reflectance=0.6)` is what a scene file writes as
`type = "diffuse"`, `reflectance = 0.6`. The keys are those of docs/scene-format.md. They are checked when the scene is
used, with the messages of the command line.
"""

from __future__ import annotations

import copy
import inspect
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from . import _stilb
from ._meanings import docstring
from ._names import class_name
from ._stilb import InputError
from ._wrong import wrong_type

__all__ = ["Light", "Material", "Object", "Part", "Sensor"]


class Part:
    """A part of a scene: a type, and keys with values as in scene files.

    Keys are attributes, too: `lamp.flux = 400`.
    """

    section = ""
    type = ""
    type_key = "type"
    _allowed: tuple[str, ...] = ()  # keys; where it is empty, the reader of scenes decides

    def __init__(self, **keys: Any) -> None:
        object.__setattr__(self, "_keys", {key: _kept(value) for key, value in keys.items() if value is not None})
        object.__setattr__(self, "_changes", 0)

    def __getattr__(self, key: str) -> Any:
        if key.startswith("_") or key not in self._keys:
            raise AttributeError(f"{type(self).__name__} has no {key}; it has: {', '.join(self._keys) or 'no keys'}")
        return self._keys[key]

    def __setattr__(self, key: str, value: Any) -> None:
        if self._allowed and key not in self._allowed:
            name = type(self).__name__
            raise InputError(f'{name} has no key "{key}".{_stilb.did_you_mean(key, list(self._allowed))} Allowed: '
                             f"{', '.join(self._allowed)}.")
        self._keys[key] = _kept(value)
        object.__setattr__(self, "_changes", self._changes + 1)

    def __delattr__(self, key: str) -> None:
        self.__getattr__(key)
        del self._keys[key]
        object.__setattr__(self, "_changes", self._changes + 1)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Part) and self.section == other.section and _same(self.to_dict(), other.to_dict())

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={_short(value)}' for key, value in self._keys.items())})"

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._keys]

    def __copy__(self) -> Part:
        """Arrays, which nothing changes, are shared."""
        made = type(self).__new__(type(self))
        keys = {key: value if isinstance(value, np.ndarray) else copy.deepcopy(value) for key, value in self._keys.items()}
        made.__dict__.update({**self.__dict__, "_keys": keys})
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Part:
        return copy.copy(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self.section, dict(self._keys))

    def to_dict(self) -> dict[str, Any]:
        """The table of a scene file that describes this part."""
        return {self.type_key: self.type, **self._keys}

    def _state(self) -> tuple[Any, ...]:
        """Differs from an earlier state where the part was changed."""
        tables = [repr(value) for value in self._keys.values() if isinstance(value, Mapping)]
        return (id(self), self._changes, *tables)


class Material(Part):
    """A material of a scene: `scene.materials["wall"] = stilb.Diffuse(reflectance=0.6)`."""

    section = "materials"


class Object(Part):
    """An object of a scene: `scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")`."""

    section = "objects"
    type_key = "shape"


class Light(Part):
    """A light of a scene: `scene.lights["bulb"] = stilb.PointLight(position=(2, 1.5, 2.3), flux=800)`."""

    section = "lights"


class Sensor(Part):
    """A sensor of a scene: `scene.sensors["desk"] = stilb.Illuminance(position=(1, 1, 0.75), normal=(0, 0, 1))`."""

    section = "sensors"


def _restored(kind: type[Part], section: str, keys: dict[str, Any]) -> Part:
    return _Table(section, keys) if kind is _Table else kind(**keys)


def _kept(value: Any) -> Any:
    """A value that cannot be changed in place, so that a part changes by its attributes alone."""
    if isinstance(value, np.ndarray):
        value = value.copy()
        value.setflags(write=False)
    if isinstance(value, Sequence | Iterator) and not isinstance(value, str | bytes | bytearray):
        return tuple(_kept(element) for element in value)
    return value


def _short(value: Any) -> str:
    return f"<array {value.shape}>" if isinstance(value, np.ndarray) and value.size > 12 else repr(value)


def _same(a: Mapping[str, Any], b: Mapping[str, Any]) -> bool:
    return a.keys() == b.keys() and all(np.array_equal(a[key], b[key]) for key in a)


BASES: dict[str, type[Part]] = {base.section: base for base in (Material, Object, Light, Sensor)}


def _make_class(section: str, name: str, keys: list[str]) -> type[Part]:
    base = BASES[section]
    own = [key for key in keys if key != base.type_key]
    parameters = [inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=None) for key in own]
    return type(class_name(section, name), (base,), {
        "type": name,
        "_allowed": tuple(own),
        "__module__": "stilb",
        "__doc__": docstring(section, name, own),
        "__signature__": inspect.Signature(parameters),
    })


CLASSES: dict[tuple[str, str], type[Part]] = {
    (kind.section, kind.type): _make_class(kind.section, kind.type, kind.keys) for kind in _stilb.part_types()
}


class Mesh(CLASSES["objects", "mesh"]):  # type: ignore[misc]
    __module__ = "stilb"
    _allowed = ("vertices", "faces", *CLASSES["objects", "mesh"]._allowed)
    __doc__ = docstring("objects", "mesh", list(_allowed)) + """

    The front of a triangle is the side from which its corners run counterclockwise. Arrays are copied.
    """
    __signature__ = inspect.Signature([
        inspect.Parameter("vertices", inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None),
        inspect.Parameter("faces", inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None),
        *[inspect.Parameter(key, kind, default=None) for key, kind in [
            ("material", inspect.Parameter.POSITIONAL_OR_KEYWORD),
            *[(key, inspect.Parameter.KEYWORD_ONLY) for key in
              ("file", "materials", "scale", "rotate", "translate", "transform")]]],
    ])

    def __init__(self, vertices: Any = None, faces: Any = None, material: Any = None, **keys: Any) -> None:
        if vertices is not None:
            vertices = _array(vertices, np.float64, "vertices")
        if faces is not None:
            faces = _indices(faces)
        super().__init__(vertices=vertices, faces=faces, material=material, **keys)

    def to_dict(self) -> dict[str, Any]:
        return {"shape": "polygons" if "vertices" in self._keys else "mesh", **self._keys}


def _array(values: Any, dtype: Any, key: str) -> np.ndarray[Any, Any]:
    array = np.ascontiguousarray(values, dtype)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{key}: found an array of shape {array.shape}. Allowed: (n, 3).")
    return array


def _indices(values: Any) -> np.ndarray[Any, Any]:
    faces = np.asarray(values)
    if not np.issubdtype(faces.dtype, np.integer):
        raise InputError(f"faces: found an array of {faces.dtype}. Allowed: whole numbers, indices of vertices.")
    if faces.size and (faces.min() < 0 or faces.max() >= 2**32):
        raise InputError("faces: an index is negative or too large. Allowed: indices of vertices, from 0.")
    return _array(faces, np.uint32, "faces")


CLASSES["objects", "mesh"] = Mesh
globals().update({kind.__name__: kind for kind in CLASSES.values()})
__all__ += [kind.__name__ for kind in CLASSES.values()]


def part_of(section: str, value: Any, name: str) -> Part:
    """The value as a part of a section; dictionaries are tables of scene files."""
    if isinstance(value, Part):
        if value.section != section:
            raise InputError(f"{section}.{name}: {type(value).__name__} belongs to {value.section}, not to {section}.")
        return value
    if not isinstance(value, Mapping):
        allowed = ", ".join(kind.__name__ for (of, _), kind in CLASSES.items() if of == section)
        raise wrong_type(f"{section}.{name}", value, f"{allowed}, or a dictionary with the keys of a scene file")
    keys = dict(value)
    base = BASES[section]
    kind = CLASSES.get((section, keys.pop(base.type_key, "")))
    if all(isinstance(keys.get(key), np.ndarray) for key in ("vertices", "faces")):
        kind = Mesh
    return kind(**keys) if kind else _Table(section, dict(value))


class _Table(Part):
    """A part whose type is missing, comes from the scene's defaults, or is wrong: the reader says so."""

    def __init__(self, section: str, keys: dict[str, Any]) -> None:
        super().__init__(**keys)
        object.__setattr__(self, "section", section)

    def to_dict(self) -> dict[str, Any]:
        return dict(self._keys)
