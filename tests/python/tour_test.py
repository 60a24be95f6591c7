"""The tour of the Python package runs, and the examples of docs/python.md do."""

import contextlib
import io
import os
import re
import runpy
import tempfile
import unittest
from pathlib import Path

from room import ROOT, TOML


class Documents(unittest.TestCase):
    def test_tour(self):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            runpy.run_path(str(ROOT / "examples/python/tour.py"))
        text = printed.getvalue()
        self.assertIn('Did you mean "reflectance"?', text)
        self.assertIn("['bulb'] 0.25", text)
        self.assertGreater(float(re.search(r"exactly .* lx: z = .*, p = ([0-9.]+)", text)[1]), 1e-3)

    def test_examples_of_the_guide(self):
        blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / "docs/python.md").read_text(encoding="utf-8"), re.M | re.S)
        self.assertGreater(len(blocks), 3)
        names: dict[str, object] = {}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "office.toml").write_text(TOML.replace("view", "main"))
            os.chdir(folder)
            try:
                with contextlib.redirect_stdout(io.StringIO()):
                    for block in blocks:
                        exec(block, names)
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
