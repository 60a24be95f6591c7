"""stilb fit."""

import csv
import json
import math
import re
import unittest

from command_line import BOX, CommandLineTest, run


class FitTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("box.obj", BOX)
        # A plate apart from the box: no centre sees both all round.
        plate = BOX.replace("v 2", "v 3.1").replace("v 0", "v 3")
        corners = re.sub(r"\d+", lambda number: str(int(number[0]) + 8), plate[plate.index("f"):])
        self.two = self.write("two.obj", BOX + plate[: plate.index("f")] + corners)
        self.series = self.folder / "series.json"

    def fit(self, *arguments):
        result = run("fit", *arguments, "-o", self.series, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout), result.stderr

    def test_report_and_file(self):
        report, warnings = self.fit(self.mesh, "--degree", 12)
        self.assertEqual(warnings, "")
        self.assertEqual((report["mesh"]["faces"], report["mesh"]["vertices"], report["mesh"]["size"]), (12, 8, 2))
        self.assertEqual(report["mesh"]["bare_bytes"], 12 * (12 + 8))
        self.assertAlmostEqual(report["center"]["margin"], 0.25, places=5)
        self.assertEqual((report["star_shape"]["folded_share"], report["star_shape"]["missed_share"]), (0, 0))
        errors = report["errors"]
        self.assertEqual([error["degree"] for error in errors], list(range(13)))
        self.assertTrue(all(a["rms"] > b["rms"] for a, b in zip(errors[2::2], errors[4::2])))
        self.assertTrue(all(error["rms"] < error["maximum"] for error in errors))
        series = json.loads(self.series.read_text())
        self.assertEqual((series["format"], series["version"], series["degree"]), ("stilb-harmonics", 1, 12))
        self.assertEqual(len(series["coefficients"]), 13**2)
        self.assertEqual(series["mesh"], "box.obj")
        self.assertAlmostEqual(series["rms_error"], errors[-1]["rms"], places=5)
        self.assertEqual(report["series"]["bytes"], self.series.stat().st_size)
        # The mean of the radius is between half the shortest edge and half the diagonal.
        self.assertTrue(0.5 < series["coefficients"][0] / math.sqrt(4 * math.pi) < 1.25)

    def test_text_and_table(self):
        table = self.folder / "errors.csv"
        result = run("fit", self.mesh, "-o", self.series, "--degree", 20, "--csv", table)
        self.assertEqual(result.returncode, 0, result.stderr)
        errors = self.fit(self.mesh, "--degree", 20)[0]["errors"]
        with table.open(newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertEqual(rows, errors)
        for part in ("8 vertices, 12 faces", "longest edge", "rms error", "\n    16 ", "\n    20 ", "200978 directions",
                     "128 x 256"):
            self.assertIn(part, result.stdout)

    def test_what_is_not_star_shaped_is_refused(self):
        arguments = ["fit", self.two, "-o", self.series, "--degree", 8]
        self.expect_wrong_input(arguments, "two.obj: not star-shaped", "theta", "% of the size", "center", "force")
        self.assertFalse(self.series.exists())
        report, warnings = self.fit(self.two, "--degree", 8, "--center", "1,0.5,0.5", "--force")
        self.assertIn("are lost", warnings)
        self.assertEqual(report["warnings"][0] + "\n", warnings.removeprefix("warning: "))
        self.assertIsNone(report["center"]["margin"])
        worst = report["star_shape"]["worst_folds"][0]
        self.assertTrue(worst["direction"][0] > 0.9 and worst["depth"] > 0.3)
        share = report["star_shape"]["folded_share"]
        self.fit(self.two, "--degree", 8, "--center", "1,0.5,0.5", "--tolerance", 1.1 * share)
        _, warnings = self.fit(self.two, "--degree", 8, "--center", "1,0.5,0.5", "--force", "--quiet")
        self.assertEqual(warnings, "")

    def test_flags_that_mean_nothing(self):
        arguments = ["fit", self.mesh, "-o", self.series, "--degree", 8]
        self.expect_wrong_input([*arguments, "--center", "1,2"], '--center "1,2": expected x,y,z')
        self.expect_wrong_input([*arguments, "--tolerance", "3"], '--tolerance "3"', "0.5%")
        self.expect_wrong_input([*arguments, "--center", "50,0,0", "--force"], "box.obj: ", "center inside")
        self.expect_wrong_input([*arguments, "--csv", "errors.txt"], "errors.txt", ".csv")
        self.expect_wrong_input([*arguments, "--csv", self.folder / "no/errors.csv"], "no folder")
        self.expect_wrong_input(["fit", self.mesh, "-o", self.series, "--degree", 129], "--degree")
        self.expect_wrong_input(["fit", self.mesh, "-o", self.series], "--degree")
        self.expect_wrong_input(["fit", self.mesh, "-o", self.folder / "no/s.json", "--degree", 8], "no folder")
        self.expect_wrong_input(["fit", self.scene, "-o", self.series, "--degree", 8], "room.toml")

    def test_negative_centres(self):
        report, _ = self.fit(self.write("shifted.obj", BOX.replace("v 0", "v -2")), "--degree", 6, "--center", "-1,0.5,0.5")
        self.assertEqual(report["center"]["position"], [-1, 0.5, 0.5])


if __name__ == "__main__":
    unittest.main()
