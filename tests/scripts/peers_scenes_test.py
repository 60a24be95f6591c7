"""The scenes of `make bench-peers`. Needs none of the other programs."""

import importlib.util
import json
import unittest

from command_line import ROOT, run

SCENES = ROOT / "benchmarks/peers/scenes"


class ScenesTest(unittest.TestCase):
    def test_scenes_are_read_without_warnings(self):
        scenes = sorted(SCENES.glob("*.toml"))
        self.assertEqual(len(scenes), 5)
        for scene in scenes:
            with self.subTest(scene=scene.name):
                result = run("info", scene, "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(json.loads(result.stdout)["warnings"], [])

    def test_the_hall_is_what_its_generator_writes(self):
        specification = importlib.util.spec_from_file_location("hall", SCENES / "hall.py")
        hall = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(hall)
        for name, content in hall.files().items():
            self.assertEqual((SCENES / name).read_text(), content)


if __name__ == "__main__":
    unittest.main()
