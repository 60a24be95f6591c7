"""scripts/check-cases: what counts as right, and its exit codes."""

import importlib.machinery
import importlib.util
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts/check-cases"
LOADER = importlib.machinery.SourceFileLoader("check_cases", str(SCRIPT))
MODULE = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_cases", LOADER))
LOADER.exec_module(MODULE)


def document(*values, error=0.1, warnings=()):
    return json.dumps({"warnings": warnings, "sensors": [{
        "name": "desk", "summary": {"mean": sum(values) / len(values)},
        "values": [{"value": value, "standard_error": error} for value in values]}]})


class ChecksTest(unittest.TestCase):
    def faults(self, check, out="", err="", code=0):
        return MODULE.faults_of(check, (code, out, err))

    def test_readings(self):
        check = {"readings": [{"sensor": "desk", "values": [100, "any", 50], "relative": 0.01}]}
        self.assertEqual(self.faults(check, document(101.2, 7, 50)), [])  # 1 and three standard errors
        self.assertRegex(self.faults(check, document(101.4, 7, 50))[0], r"desk\[0\] is 101.4")
        self.assertRegex(self.faults(check, document(100, 7, 49.1))[0], r"desk\[2\] is 49.1")
        self.assertRegex(self.faults(check, document(100, 7, float("nan")))[0], r"desk\[2\]")
        self.assertEqual(self.faults(check, "no document"), ["no sensor desk"])
        mean = {"readings": [{"sensor": "desk", "statistic": "mean", "values": [3], "absolute": 0.5}]}
        self.assertEqual(self.faults(mean, document(2, 3, 5)), [])
        self.assertEqual(len(self.faults(mean, document(2, 3, 6))), 1)
        every = {"readings": [{"sensor": "desk", "all": True, "values": [5], "absolute": 0.5}]}
        self.assertEqual(self.faults(every, document(5, 5.5)), [])
        self.assertEqual(len(self.faults(every, document(5, 9))), 1)
        late = {"readings": [{"sensor": "desk", "first": 1, "values": [5]}]}
        self.assertEqual(self.faults(late, document(9, 5)), [])

    def test_exit_codes(self):
        self.assertEqual(len(self.faults({}, code=3)), 1)
        self.assertEqual(self.faults({"exit": [0, 3]}, code=3), [])
        self.assertEqual(self.faults({"exit": "any"}, code=1), [])

    def test_words(self):
        self.assertEqual(self.faults({"says": ["tw."]}, "one two"), [])
        self.assertEqual(len(self.faults({"says": ["four"], "says_not": ["one"]}, "one", "two")), 2)
        # A file's name in the document is no warning.
        self.assertEqual(len(self.faults({"warns": ["desk"]}, document(1))), 1)
        self.assertEqual(self.faults({"warns": ["desk"]}, document(1, warnings=["desk is dark"])), [])
        self.assertEqual(self.faults({"warns": ["desk"]}, err="warning: desk is dark"), [])
        self.assertEqual(self.faults({"warns": ["desk"]}, "Warnings (1)\n  desk is dark\n\nRun: auto\n"), [])
        self.assertEqual(len(self.faults({"warns": ["auto"]}, "Warnings (1)\n  desk is dark\n\nRun: auto\n")), 1)

    def test_one_way_of_several_is_enough(self):
        check = {"exit": "any", "either": [{"readings": [{"sensor": "desk", "values": [5]}]}, {"warns": ["close"]}]}
        self.assertEqual(self.faults(check, document(5)), [])
        self.assertEqual(self.faults(check, document(9), "too close"), [])
        self.assertEqual(len(self.faults(check, document(9))), 1)
        self.assertEqual(len(self.faults({**check, "says": ["x"]}, document(5))), 1, "beside what is always right")


class ScriptTest(unittest.TestCase):
    def check(self, *arguments, program="/bin/true"):
        return subprocess.run([SCRIPT, *map(str, arguments)], capture_output=True, text=True,
                              env={**os.environ, "STILB": program})

    def test_outcomes(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            (folder / "sweep").mkdir()
            self.assertEqual(self.check(folder).returncode, 0)
            self.assertIn("later     sweep", self.check(folder).stdout)
            (folder / "no-such-case").mkdir()
            result = self.check(folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn("FAIL      no-such-case", result.stdout)
            (folder / "utf8-bom").mkdir()
            self.assertEqual(self.check(folder, "utf8-bom").returncode, 0, "a program that always succeeds")
            self.assertEqual(self.check(folder, "utf8-bom", program="/bin/false").returncode, 1)
            self.assertEqual(self.check(folder, "missing").returncode, 2)
            self.assertEqual(self.check(folder / "nowhere").returncode, 2)
        self.assertEqual(self.check().returncode, 2)


if __name__ == "__main__":
    unittest.main()
