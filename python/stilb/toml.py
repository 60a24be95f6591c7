"""Scene files as text."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np


def value_text(value: Any) -> str:
    """A value in one line, as a scene file and --set have it."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(key)} = {value_text(inner)}' for key, inner in value.items())} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(value_text, value))}]"
    return repr(value)


def document_text(document: Mapping[str, Mapping[str, Any]]) -> str:
    """A scene file: a table for each section with keys of its own, and for each part."""
    return "\n".join(_table_text(section, table) for section, table in document.items())


def _table_text(name: str, table: Mapping[str, Any]) -> str:
    """Of a table of keys; of parts, one each. Parts have a type or a shape; only defaults are tables without."""
    if table and all(isinstance(inner, Mapping) for inner in table.values()):
        return "\n".join(_table_text(f"{name}.{_key(key)}", inner) for key, inner in table.items())
    return f"[{name}]\n" + "".join(f"{_key(key)} = {value_text(inner)}\n" for key, inner in table.items())


def _key(name: str) -> str:
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else value_text(name)
