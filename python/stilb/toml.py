"""Scene files as text."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ._wrong import wrong_type


def value_text(value: Any, key: str) -> str:
    """A value in one line, as a scene file and --set have it. `key`: its full name, for messages."""
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers, and what is like them
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return str(int(value))
    if isinstance(value, float | np.floating):  # NumPy's widest numbers stay NumPy's
        return repr(float(value))
    if isinstance(value, Mapping):
        members = (f"{_key(name)} = {value_text(inner, f'{key}.{name}')}" for name, inner in value.items())
        return f"{{ {', '.join(members)} }}"
    if isinstance(value, Sequence | Iterator) and not isinstance(value, bytes | bytearray):
        elements = (value_text(inner, f"{key}[{number}]") for number, inner in enumerate(value))
        return f"[{', '.join(elements)}]"
    raise wrong_type(key, value, "numbers, texts, True and False, lists, arrays and dictionaries")


def document_text(document: Mapping[str, Mapping[str, Any]]) -> str:
    """A scene file: a table for each section with keys of its own, and for each part."""
    return "\n".join(_table_text(section, section, table) for section, table in document.items())


def _table_text(name: str, place: str, table: Mapping[str, Any]) -> str:
    """A table of keys as text; a table of tables as one text after another. `place`: the table's name without quotation
    marks, for messages."""
    if table and all(isinstance(inner, Mapping) for inner in table.values()):
        return "\n".join(_table_text(f"{name}.{_key(key)}", f"{place}.{key}", inner) for key, inner in table.items())
    return f"[{name}]\n" + "".join(f"{_key(key)} = {value_text(inner, f'{place}.{key}')}\n" for key, inner in table.items())


def _key(name: object) -> str:
    text = str(name)
    return text if re.fullmatch("[A-Za-z0-9_-]+", text) else value_text(text, text)
