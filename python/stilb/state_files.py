"""State files of runs (docs/runs.md): those of the command line, for which a run is words of `stilb measure`."""

from __future__ import annotations

import argparse
import copy
import os
import tomllib
from pathlib import Path
from typing import Any, NoReturn

from . import _stilb
from ._stilb import InputError
from .options import DESCRIBED
from .scene import Scene, _moved, _relocated
from .sums import Sums
from .toml import document_text


class _Words(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise InputError(f"this run cannot go on here: {message}. The command line can: stilb resume FILE.")


def _parser() -> _Words:
    words = _Words(allow_abbrev=False, add_help=False)
    words.add_argument("scene")
    words.add_argument("--set", action="append", default=[])
    words.add_argument("--sensor", action="append", default=[])
    for key in DESCRIBED:
        words.add_argument(_flag(key), dest=f"option {key}")
    # What they say concerns the files of the command alone.
    for flags in (["-o", "--output"], ["--csv"], ["--falsecolor"], ["--state-every"], ["--part"]):
        words.add_argument(*flags)
    words.add_argument("--json", nargs="?")
    for flag in ("--quiet", "--progress", "--replicates", "--check"):
        words.add_argument(flag, action="store_true")
    return words


def _flag(key: str) -> str:
    return f"--{key.replace('_', '-')}"


def _typed(key: str, text: str) -> Any:
    kind = DESCRIBED[key][0]
    if kind == "int":
        return int(text) if text.isdigit() else int(float(text))
    return float(text) if kind == "float" else text


def _value(text: str) -> Any:
    """Of --set: text without quotes is a text, too."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _scene_of(path: Path, settings: list[str]) -> Scene:
    values = dict(text.split("=", 1) for text in settings)
    keys = {key: _value(text) for key, text in values.items() if not key.startswith("import.")}
    return Scene._of_file(_stilb.Scene.load(path, settings, None), settings, keys)


def read(path: str | os.PathLike[str]) -> Sums:
    """The run of a state file."""
    file = Path(path)
    state = _stilb.RunState.read(file.read_bytes(), str(file))
    if not state.arguments():
        raise InputError(f"{file}: this run names no scene: it was not begun by stilb measure or scene.start().")
    try:
        words = vars(_parser().parse_args(state.arguments()))
        scene = _scene_of(file.parent / state.folder() / words["scene"], words["set"])
    except InputError as error:
        raise InputError(f"{file}: {error}") from None
    limits: Any = {key: _typed(key, words[f"option {key}"]) for key in DESCRIBED if words[f"option {key}"] is not None}
    sums = Sums(scene, words["sensor"], limits, state)
    state.require_same_run(sums.adopted_by(scene).state, str(file))
    return sums


def write(sums: Sums, path: str | os.PathLike[str]) -> None:
    """Writes a state file. It refers to the scene's file; a scene that was built in code is written beside it."""
    file = Path(path)
    if not sums.state.samples():
        raise InputError("the run has no samples yet, and there is nothing to save. Save it after its first result.")
    source = _own_file(sums.scene) or _file_beside(sums.scene, file)
    state = sums.adopted_by(source).state
    if file.exists():
        _stilb.RunState.read(file.read_bytes(), str(file)).require_same_run(state, str(file))
    assert source._path is not None
    scene_file = source._path.absolute()
    folder = os.path.relpath(scene_file.parent, file.absolute().parent)
    state.set_command(_words(scene_file.name, source, sums), Path(folder).as_posix())
    state.save(file)


def _words(scene: str, source: Scene, sums: Sums) -> list[str]:
    words = [scene]
    for flag, texts in (("--set", source._settings), ("--sensor", sums.sensors)):
        words += [word for text in texts for word in (flag, text)]
    given = {key: value for key, value in sums.limits.items() if value is not None}
    return words + [word for key, value in given.items() for word in (_flag(key), _word(key, value))]


def _word(key: str, value: Any) -> str:
    return str(int(value)) if DESCRIBED[key][0] == "int" else str(value)


def _own_file(scene: Scene) -> Scene | None:
    """The scene as its file has it; None where it has none, or was changed."""
    if scene._path is None:
        return None
    if scene._scene().path() == scene._path:
        return scene
    try:
        read = _scene_of(scene._path, scene._settings)
    except (InputError, OSError):
        return None
    return read if text_of(read) == text_of(scene) else None


def text_of(scene: Scene) -> str:
    """All that a scene is, apart from the parts of a file of another format. Names of files are absolute."""
    folder = scene._directory.absolute()
    return document_text(_relocated(scene._document(), lambda name: os.path.normpath(folder / name)))


def _file_beside(scene: Scene, state: Path) -> Scene:
    file = state.with_suffix(".toml")
    if file.exists():
        found = Scene.load(file)
        if text_of(found) != text_of(scene):
            raise InputError(f"{state}: a state names the file of its scene. This scene was built in code or has been changed, "
                             f"and {file} is that of another one: save it elsewhere before the run begins, scene.save(path), "
                             "or keep the run by pickle.")
        return found
    written = copy.copy(scene)
    written.save(file)
    return written
