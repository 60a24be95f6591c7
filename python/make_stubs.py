#!/usr/bin/env python3
"""Writes the type stubs of the extension module, and of what stilb/parts.py and options.py make from the library's lists.

Usage: make_stubs.py FOLDER     (the package, with its extension module)
"""

import importlib
import sys
import types
from pathlib import Path

from nanobind import stubgen

HEAD = '''from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

from numpy.typing import ArrayLike

Value = ArrayLike | PathLike[str] | Mapping[str, Any] | Sequence[Any] | None

class Part:
    section: str
    type: str
    type_key: str
    def __init__(self, **keys: Value) -> None: ...
    def __getattr__(self, key: str) -> Any: ...
    def __setattr__(self, key: str, value: Value) -> None: ...
    def to_dict(self) -> dict[str, Any]: ...
    def _state(self) -> tuple[Any, ...]: ...

class Material(Part): ...
class Object(Part): ...
class Light(Part): ...
class Sensor(Part): ...

def part_of(section: str, value: Any, name: str) -> Part: ...
'''

MESH = '''
class Mesh(Object):
    def __init__(self, vertices: ArrayLike | None = None, faces: ArrayLike | None = None, material: str | None = None, *,
                 {}) -> None: ...
'''

OPTIONS = '''from typing import TypedDict

from . import _stilb

DESCRIBED: dict[str, list[str]]
DESCRIPTION: str

class SightLimits(TypedDict, total=False):
    """How a run is made and when it stops: `help(stilb.Scene)`."""

{}
class Limits(SightLimits, total=False):
    directions: str | None

def options(scene: _stilb.Scene, limits: SightLimits) -> _stilb.Options: ...
'''


def open_package(folder):
    """Makes the package's modules importable without its __init__.py, which needs NumPy."""
    package = types.ModuleType("stilb")
    package.__path__ = [str(folder)]
    sys.modules["stilb"] = package


def classes(kinds, class_name, docstring):
    """The text of the stubs, and the names."""
    bases = {"materials": "Material", "objects": "Object", "lights": "Light", "sensors": "Sensor"}
    names = ["Part", *bases.values()]
    text = ""
    for kind in kinds:
        name = class_name(kind.section, kind.type)
        names.append(name)
        keys = [key for key in kind.keys if key not in ("type", "shape")]
        if name == "Mesh":
            text += MESH.format(", ".join(f"{key}: Value = ..." for key in keys if key != "material"))
            continue
        parameters = "".join(f", {key}: Value = ..." for key in keys)
        text += f"\nclass {name}({bases[kind.section]}):\n"
        text += f'    """{docstring(kind.section, kind.type, keys, 8 * " ")}"""\n'
        text += f"    def __init__(self{', *' if parameters else ''}{parameters}) -> None: ...\n"
    return text, names


def main():
    folder = Path(sys.argv[1])
    open_package(folder)
    module, names, meanings = (importlib.import_module(f"stilb.{name}") for name in ("_stilb", "_names", "_meanings"))
    text, names = classes(module.part_types(), names.class_name, meanings.docstring)
    (folder / "parts.pyi").write_text(f"{HEAD}{text}\n__all__ = {sorted(names)}\n", encoding="utf-8")
    keys = "".join(f"    {key}: {kind} | None\n" for key, kind, *_ in module.described_options() if key != "directions")
    (folder / "options.pyi").write_text(OPTIONS.format(keys), encoding="utf-8")
    stubgen.main(["-q", "-r", "-m", "stilb._stilb", "-O", str(folder)])


if __name__ == "__main__":
    main()
