"""Variants of a scene in Python: the table of the command line."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas
import stilb
from room import TOML, program

KEY = "materials.wall.reflectance"


class Sweeps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.file = Path(folder.name) / "room.toml"
        cls.file.write_text(TOML)
        cls.scene = stilb.load(cls.file)

    def printed(self, *arguments):
        table = self.file.with_name("table.csv")
        made = program("measure", self.file, "--quiet", "--csv", table, *arguments)
        self.assertIn(made.returncode, (0, 3), made.stderr)
        return pandas.read_csv(table, keep_default_na=False)

    def same(self, own, printed):
        self.assertEqual([str(name) for name in own.columns], list(printed.columns))
        self.assertEqual(len(own), len(printed))
        for name in printed.columns:
            if name in ("converged", "warnings"):
                self.assertEqual([str(value).lower() for value in own[name]], [str(value).lower() for value in printed[name]])
            elif printed[name].dtype.kind == "f" and name not in (KEY, "lights.bulb.flux"):
                np.testing.assert_allclose(own[name], printed[name], rtol=1e-9, atol=1e-9, err_msg=name)
            else:
                self.assertEqual(list(map(str, own[name])), list(map(str, printed[name])), name)

    def test_the_table_is_that_of_the_command_line(self):
        own = stilb.sweep(self.scene, {KEY: [0.3, 0.5, 0.7]}, paths=1024)
        self.same(own, self.printed("--vary", f"{KEY}=0.3,0.5,0.7", "--paths", 1024))
        first, last = own[own[KEY] == 0.3], own[own[KEY] == 0.7]
        self.assertTrue((first["difference"] == 0).all())
        self.assertTrue((last["difference_low"][last["statistic"] == "mean"] > 0).all())

    def test_several_keys(self):
        keys = {KEY: [0.3, 0.5], "lights.bulb.flux": [400, 800]}
        words = ["--vary", f"{KEY}=0.3,0.5", "--vary", "lights.bulb.flux=400,800", "--paths", 512, "--sensor", "desk"]
        self.same(stilb.sweep(self.scene, keys, paths=512, sensors="desk"), self.printed(*words))
        self.same(stilb.sweep(self.scene, keys, zip=True, paths=512, sensors=["desk"]), self.printed(*words, "--zip"))

    def test_an_error_is_that_of_the_first_variant(self):
        own = stilb.sweep(self.scene, {KEY: [0.3, 0.5]}, error=0.1)
        self.same(own, self.printed("--vary", f"{KEY}=0.3,0.5", "--error", "10%"))

    def test_processes_share_the_variants(self):
        one, two = (stilb.sweep(self.scene, {KEY: [0.3, 0.5, 0.7]}, paths=512, processes=count) for count in (1, 2))
        pandas.testing.assert_frame_equal(one, two)

    def test_wrong_variations_are_refused(self):
        for variations, zip, message in [({}, False, "there is no key"), ({KEY: []}, False, "there is no key"),
                                         ({KEY: [0.3], "lights.bulb.flux": [1, 2]}, True, "different numbers of values"),
                                         ({"materials.wall.reflectence": [0.3]}, False, "reflectance"),
                                         ({KEY: [0.3, 2]}, False, "2 is not allowed")]:
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                stilb.sweep(self.scene, variations, zip=zip, paths=64)


if __name__ == "__main__":
    unittest.main()
