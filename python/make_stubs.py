#!/usr/bin/env python3
"""Writes the type stubs of the extension module, and of the classes that stilb/parts.py makes from the reader's lists.

Usage: make_stubs.py FOLDER     (the package, with its extension module)
"""

import importlib.util
import subprocess
import sys
from pathlib import Path

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


def load(folder, name):
    spec = importlib.util.spec_from_file_location(f"stilb.{name}", next(folder.glob(f"{name}.*")))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def classes(kinds, class_name):
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
        text += f"    def __init__(self{', *' if parameters else ''}{parameters}) -> None: ...\n"
    return text, names


def main():
    folder = Path(sys.argv[1])
    text, names = classes(load(folder, "_stilb").part_types(), load(folder, "_names").class_name)
    (folder / "parts.pyi").write_text(f"{HEAD}{text}\n__all__ = {sorted(names)}\n", encoding="utf-8")
    subprocess.run([sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "_stilb", "-i", str(folder), "-O", str(folder),
                    "-r"], check=True)


if __name__ == "__main__":
    main()
