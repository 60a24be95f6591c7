"""docs/measure.schema.json: the documents of `stilb measure --json` follow it, and it refuses others."""

import copy
import json
import os
import subprocess
import unittest
from pathlib import Path

import jsonschema

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs/measure.schema.json").read_text())


def strict(schema):
    """Without the keys that later versions may add."""
    return schema | {"additionalProperties": False}


def document(*arguments):
    command = [os.environ["STILB"], "measure", *map(str, arguments), "--json", "--quiet"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT).stdout)


class SchemaTest(unittest.TestCase):
    def setUp(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        self.validator = jsonschema.Draft202012Validator(strict(SCHEMA))

    def test_documents(self):
        small = ["--paths", "1", "--replicates"]
        evening = ["--set", "scenes.evening.others=0.5", "--by", "light"]
        for arguments in (
            ["scenes/simple/room.toml", *small],
            ["scenes/simple/room.toml", *small, *evening],
            ["scenes/simple/room.toml", *small, "--method", "radiosity", "--patch", "1"],
            ["scenes/office/office.toml", *small, "--by", "bounce"],
            ["scenes/classroom/classroom.toml", *small],
        ):
            with self.subTest(arguments[0], flags=arguments[1:]):
                self.validator.validate(document(*arguments))

    def test_other_documents(self):
        right = document("scenes/simple/room.toml", "--paths", "1")
        self.validator.validate(right)
        for change in (
            lambda d: d.pop("technique"),
            lambda d: d.update(stopped="because"),
            lambda d: d.update(format=2),
            lambda d: d.update(paths="many"),
            lambda d: d["sensors"][0].pop("values"),
            lambda d: d["sensors"][0]["values"][0].update(interval=[1]),
            lambda d: d["sensors"][0]["summary"].update(median=3),
        ):
            wrong = copy.deepcopy(right)
            change(wrong)
            with self.assertRaises(jsonschema.ValidationError):
                self.validator.validate(wrong)


if __name__ == "__main__":
    unittest.main()
