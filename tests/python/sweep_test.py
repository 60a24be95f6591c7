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
        """But for the standard errors, which the command line has not."""
        columns = [str(name) for name in own.columns]
        self.assertEqual(columns, list(printed.columns))
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
        self.assertTrue((first["difference_standard_error"] == 0).all())
        t = stilb.statistics.student_t_quantile(0.975, 31)
        half_widths = (own["difference_high"] - own["difference_low"]) / 2
        np.testing.assert_allclose(half_widths, t * own["difference_standard_error"], atol=1e-12)
        self.assertTrue((own["interval_high"] - own["value"] >= 0.999 * t * own["standard_error"]).all())
        self.assertTrue((last["difference_low"][last["statistic"] == "mean"] > 0).all())

    def test_differences_are_those_of_pairs(self):
        own = stilb.sweep(self.scene, {KEY: [0.3, 0.5]}, paths=1024)
        results = []
        for reflectance in (0.3, 0.5):
            scene = stilb.load(self.file, set={KEY: reflectance})
            results.append(scene.measure(paths=1024, method="path"))
        pair = stilb.paired(results[1], results[0])
        rows = own[own[KEY] == 0.5].set_index(["sensor", "statistic"])
        for sensor, statistic in rows.index:
            difference = getattr(pair[sensor], statistic)
            row = rows.loc[(sensor, statistic)]
            np.testing.assert_allclose(row[["difference", "difference_low", "difference_high"]].astype(float),
                                       [difference.value, *difference.interval], rtol=1e-9)

    def test_shares_have_rows(self):
        keys = {KEY: [0.3, 0.5], "lights.bulb.flux": [400, 800]}
        own = stilb.sweep(self.scene, keys, zip=True, paths=512, sensors="desk", by="bounce")
        means = own[(own["statistic"] == "mean") & (own[KEY] == 0.5)].set_index("share")
        self.assertEqual(list(means.index[:3]), ["", "0", "1"])
        for column in ("value", "difference"):
            self.assertAlmostEqual(means[column].iloc[1:].sum(), means[column].iloc[0])
        self.assertAlmostEqual(means.loc["0", "difference"], means.loc["0", "value"] / 2)
        whole = stilb.sweep(self.scene, keys, zip=True, paths=512, sensors="desk")
        self.assertNotIn("share", whole.columns)
        np.testing.assert_array_equal(own[own["share"] == ""]["value"], whole["value"])

    def test_sensors_that_the_first_variant_has_not_have_no_difference(self):
        desk = self.scene.sensors["desk"].to_dict()
        own = stilb.sweep(self.scene, {"sensors.desk": [desk, {**desk, "count": [2, 2]}], "sensors.eye.position": [[1, 1, 1], [2, 2, 1]]},
                          zip=True, paths=64)
        self.assertTrue(own["value"].notna().all())

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

    def test_wrong_arguments_are_refused(self):
        for arguments, message in [((self.scene, [1, 2]), "variations: found a value of type list. Allowed: keys with lists"),
                                   ((self.scene, {KEY: 0.5}), rf"variations: {KEY} has the value 0.5. Allowed: .* \[0.5\]"),
                                   ((self.scene, {"objects.room.material": "wall"}), r"has the value 'wall'. Allowed: .* \['wall'\]"),
                                   ((str(self.file), {KEY: [0.5]}), "scene: found a value of type str. Allowed: a scene, such as")]:
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                stilb.sweep(*arguments, paths=64)
        with self.assertRaisesRegex(stilb.InputError, "processes: '2' is not allowed. Allowed: a whole number from 1"):
            stilb.sweep(self.scene, {KEY: [0.5]}, processes="2")
        for values in (np.array([0.5]), (0.5 for _ in range(1))):
            self.assertEqual(list(stilb.sweep(self.scene, {KEY: values}, paths=64)[KEY].unique()), [0.5])


if __name__ == "__main__":
    unittest.main()
