"""The program `stilb`, which is installed with the package, for what the library does not have: drawings and reports."""

from __future__ import annotations

import shutil
import subprocess
import sysconfig
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ._stilb import InputError
from .estimates import ResultWarning


def run(command: str, *arguments: object, **flags: Any) -> None:
    """Runs `stilb COMMAND`, with its flags by their names. Its messages become those of exceptions."""
    scripts = sysconfig.get_path("scripts")
    program = shutil.which("stilb", path=scripts) or shutil.which("stilb")
    if program is None:
        raise FileNotFoundError(f"the program stilb is neither in {scripts} nor in one of the folders of PATH: install the "
                                "package by pip, or add the folder of the program to PATH.")
    words = [program, command, *map(str, arguments), *_words(flags)]
    ended = subprocess.run(words, capture_output=True, text=True, check=False)
    message = ended.stderr.strip().removeprefix("stilb: ")
    if ended.returncode == 2:
        raise InputError(message)
    if ended.returncode == 3:
        text = f"a run of stilb {command} ended before its goal, as what it wrote says. {message}".rstrip()
        warnings.warn(text, ResultWarning, stacklevel=3)
    elif ended.returncode != 0:
        raise RuntimeError(f"{' '.join(words)}: {message or f'exit code {ended.returncode}'}")


def _words(flags: Mapping[str, Any]) -> list[str]:
    words: list[str] = []
    for name, value in flags.items():
        flag = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(flag)
        elif isinstance(value, list | tuple):
            words += [word for one in value for word in (flag, str(one))]
        elif value is not None and value is not False:
            words += [flag, str(value)]
    return words


def absolute(path: Any) -> Path:
    """Where names that begin with a dash are no flags."""
    return Path(path).absolute()
