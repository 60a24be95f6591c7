"""The files of scenes: what they were when they were read, and how they are written."""

from __future__ import annotations

import hashlib
import os
import shutil
import tomllib
from pathlib import Path
from typing import Any

from ._stilb import InputError

__all__ = ["ReadFile", "replace"]


class ReadFile:
    """The file of a scene as it was read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._state = _state(path)
        content = path.read_bytes()
        self._hash = _hash(content)
        self.document = _document(content)

    document: dict[str, Any] | None  # of a scene file; None where the file is of another format

    def is_as_read(self) -> bool:
        """Whether the file is still there, with the same content."""
        try:
            state = _state(self.path)
            if state != self._state and _hash(self.path.read_bytes()) != self._hash:
                return False
        except OSError:
            return False
        self._state = state
        return True

    def absolute(self) -> ReadFile:
        """The same, as other working directories find it."""
        made = ReadFile.__new__(ReadFile)
        made.__dict__.update({**self.__dict__, "path": self.path.absolute()})
        return made


def _state(path: Path) -> tuple[int, ...]:
    """Differs where the file was probably changed."""
    found = path.stat()
    return found.st_ino, found.st_size, found.st_mtime_ns


def _hash(content: bytes) -> bytes:
    return hashlib.blake2b(content, digest_size=16).digest()


def _document(content: bytes) -> dict[str, Any] | None:
    try:
        return tomllib.loads(content.decode("utf-8-sig"))
    except ValueError:
        return None


def replace(path: Path, text: str) -> None:
    """Writes a file in one step: it is the old one or the new one at any time."""
    target = Path(os.path.realpath(path))  # links stay links
    if target.exists() and not target.is_file():
        raise InputError(f"{path}: this is no file that could be written. Allowed: the name of a file, such as room.toml.")
    written = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        written.write_text(text, encoding="utf-8")
        if target.exists():
            shutil.copymode(target, written)
        os.replace(written, target)
    except OSError as error:
        written.unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror, str(path)) from None
