"""stilb measure: tables, JSON, CSV, limits, interruption."""

import csv
import json
import math
import signal
import subprocess
import time
import unittest

from command_line import CAMERA, MOST_SECONDS, PROGRAM, ROOM, CommandLineTest, run, wait_for_error


class MeasureTest(CommandLineTest):
    def test_json_has_all_that_the_contract_names(self):
        document = self.measure("--error", "5%")
        for key in ("stilb", "scene", "method", "seed", "elapsed_s", "paths", "replicates", "converged", "sensors"):
            self.assertIn(key, document)
        self.assertIs(document["converged"], True)
        self.assertEqual([s["name"] for s in document["sensors"]], ["desk", "wall"])
        for sensor in document["sensors"]:
            self.assertEqual((sensor["quantity"], sensor["unit"]), ("illuminance", "lx"))
            self.assertLessEqual({"mean", "minimum", "maximum", "uniformity"}, set(sensor["summary"]))
            for value in sensor["values"]:
                self.assertEqual(
                    set(value), {"position", "normal", "value", "standard_error", "interval", "rgb"})
                low, high = value["interval"]
                self.assertLess(low, value["value"])
                self.assertGreater(high, value["value"])
                red, green, blue = value["rgb"]
                self.assertAlmostEqual(0.2126 * red + 0.7152 * green + 0.0722 * blue, value["value"], 6)
        desk, wall = document["sensors"]
        self.assertEqual((desk["type"], desk["count"], wall["type"]), ("grid", [3, 2], "illuminance"))
        positions = [value["position"] for value in desk["values"]]
        self.assertEqual([p[0] for p in positions], [1.75, 2.25, 2.75] * 2)  # u fastest
        self.assertEqual([p[1] for p in positions], [1.25] * 3 + [1.75] * 3)

    def test_one_sensor(self):
        document = self.measure("--error", "5%", "--sensor", "wall")
        self.assertEqual([s["name"] for s in document["sensors"]], ["wall"])

    def test_several_sensors(self):
        document = self.measure("--error", "5%", "--sensor", "wall", "--sensor", "desk")
        self.assertEqual({s["name"] for s in document["sensors"]}, {"desk", "wall"})
        self.expect_wrong_input(["measure", self.scene, "--sensor", "wall", "desk"], '"desk" is one argument too many')

    def test_cameras_are_left_out(self):
        self.scene = self.write("view.toml", ROOM + CAMERA)
        document = self.measure("--error", "5%")
        self.assertEqual([s["name"] for s in document["sensors"]], ["desk", "wall"])

    def test_no_reflections_is_the_inverse_square_law(self):
        document = self.measure("--bounces", "0", "--sensor", "wall", "--paths", "1024")
        squared = 2**2 + 0.8**2
        exact = 1000 / (4 * math.pi) / squared * 2 / math.sqrt(squared)
        self.assertAlmostEqual(document["sensors"][0]["values"][0]["value"], exact, delta=1e-4 * exact)

    def test_target_not_reached(self):
        document = self.measure("--error", "0.0001%", "--time", "1", code=3)
        self.assertIs(document["converged"], False)
        self.assertEqual(len(document["sensors"][0]["values"]), 6)
        result = run("measure", self.scene, "--error", "0.0001%", "--time", "0.5")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stdout, r"\nThe requested error of 0.0001 % is not reached: the error is [0-9.]+ %\.\n$")

    def test_a_working_plane_without_coordinates(self):
        document = self.measure("--grid", "z=0.8,margin=0.6", "--sensor", "plane", "--error", "5%")
        (plane,) = document["sensors"]
        self.assertEqual(plane["type"], "area")
        self.assertEqual({round(v["position"][2], 4) for v in plane["values"]}, {0.8})
        picture = self.folder / "plane.png"
        results = self.folder / "plane.json"
        run("measure", self.scene, "--grid", "z=0.8", "--sensor", "plane", "--error", "5%", "--falsecolor", picture, "-o", results)
        again = self.folder / "again.png"
        run("falsecolor", results, "-o", again, "--isolines")
        self.assertEqual(picture.read_bytes(), again.read_bytes())
        for wrong, part in (("z", "no length"), ("z=low", "z=low is no length"), ("margin=9", "away from its walls"),
                            ("hight=2", "there is no \"hight=2\"")):
            result = run("measure", self.scene, "--grid", wrong)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(part, result.stderr)

    def test_interrupted(self):
        for name in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([PROGRAM, "measure", self.scene, "--json", "--error", "0.00001%", "--time", "50",
                                        "--progress"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            wait_for_error(process)
            process.send_signal(name)
            output, errors = process.communicate(timeout=MOST_SECONDS)
            self.assertEqual(process.returncode, 3, errors)
            document = json.loads(output)
            self.assertIs(document["converged"], False)
            self.assertLess(document["elapsed_s"], 40)
            self.assertGreater(document["sensors"][0]["values"][0]["value"], 0)

    def test_interrupted_during_set_up(self):
        process = subprocess.Popen([PROGRAM, "measure", self.scene, "--json", "--method", "radiosity", "--patch", "0.02"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=MOST_SECONDS)
        self.assertEqual((process.returncode, output), (3, ""), errors)
        self.assertIn("interrupted during set-up", errors)
        self.assertIn("no result", errors)

    def test_time_holds_for_the_set_up(self):
        start = time.monotonic()
        result = run("measure", self.scene, "--method", "radiosity", "--patch", "0.02", "--time", "1")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("time limit reached", result.stderr)
        self.assertLess(time.monotonic() - start, 40)

    def test_threads_and_repetitions_change_nothing(self):
        def document(threads):
            result = self.measure("--paths", "20000", "--threads", threads)
            del result["elapsed_s"]
            return result

        first = document(1)
        for threads in (1, 1, 2, 2, 2):
            self.assertEqual(document(threads), first)

    def test_paths_are_rounded_up_as_the_help_says(self):
        text = run("measure", "--help").stdout
        for method, multiple in (("light-paths", 2048), ("guided", 32), ("local", 2048), ("double-local", 2048), ("path", 32),
                                 ("radiosity", 32), ("ray-bundle", 512), ("particles", 131072)):
            with self.subTest(method=method):
                self.assertRegex(text, rf"\b{method}\b[^;]* to a multiple of {multiple}\b")
                patch = ("--patch", "1") if method in ("radiosity", "ray-bundle", "particles") else ()
                done = self.measure("--method", method, "--paths", "1", *patch)["paths"]
                self.assertGreaterEqual(done, multiple)
                self.assertEqual(done % multiple, 0)
                if multiple == 32:
                    self.assertEqual(self.measure("--method", method, "--paths", "33", *patch)["paths"], 64)

    def test_the_table_names_the_samples(self):
        for method, samples in (("auto", "(paths|light paths|samples)"), ("light-paths", "light paths"), ("path", "paths"), ("ray-bundle", "steps"), ("radiosity", "samples"),
                                ("particles", "particles")):
            patch = ("--patch", "1") if method in ("radiosity", "ray-bundle", "particles") else ()
            with self.subTest(method=method):
                table = run("measure", self.scene, "--method", method, "--paths", "1", *patch).stdout
                self.assertRegex(table, rf"\n{method}( \(.*\))?, [0-9]+ {samples} in [0-9.]+ s: all {samples} done; error ")
                self.assertEqual("auto (" in table, method == "auto")

    def test_the_error_of_patches(self):
        document = self.measure("--method", "particles", "--patch", "1", "--paths", "1")
        for sensor in document["sensors"]:
            self.assertGreater(sensor["patch_error"], 0)
            for value in sensor["values"]:
                low, high = value["interval"]
                self.assertGreater((high - low) / 2, 2.03 * value["standard_error"] + 0.99 * value["patch_error"])
        self.assertNotIn("patch_error", self.measure("--paths", "1")["sensors"][0])

    def test_patches_too_coarse(self):
        self.scene = self.write("coarse.toml", ROOM.replace("[2, 1.5, 2]", "[2, 1.5, 2.3]"))  # the ceiling is at 2.5 m
        for method in ("radiosity", "particles", "ray-bundle"):
            with self.subTest(method=method):
                document = self.measure("--method", method, "--patch", "4", "--error", "0.1%", "--time", "50", code=3)
                self.assertEqual((document["converged"], document["stopped"]), (False, "patches too coarse"))

    def test_whole_numbers_are_written_as_in_scene_files(self):
        def document(*arguments):
            result = self.measure(*arguments)
            del result["elapsed_s"]
            return result

        self.assertEqual(document("--paths", "1e4", "--seed", "1.2e1", "--bounces", "3.0", "--threads", "1e0"),
                         document("--paths", "10000", "--seed", "12", "--bounces", "3", "--threads", "1"))
        self.assertEqual(document("--paths", "4096", "--seed", "010")["seed"], 10)  # not octal

    def test_seeds_differ(self):
        values = [self.measure("--paths", "5000", "--seed", seed)["sensors"][0]["values"] for seed in (1, 2)]
        self.assertNotEqual(*values)

    def test_methods_agree(self):
        means = {}
        for method in ("auto", "local", "path"):
            summary = self.measure("--method", method, "--error", "3%", "--sensor", "desk")["sensors"][0]["summary"]
            means[method] = summary["mean"]
        for method in ("local", "path"):
            self.assertAlmostEqual(means[method] / means["auto"], 1, delta=0.05)

    def test_patch_flags_of_other_methods(self):
        for flag, value, message in (("--window", "cubes", '--window: "cubes" is not allowed. Did you mean "cube"?'),
                                     ("--resolution", 99999, "--resolution: 99999 is out of range")):
            self.assertIn(f"stilb: {message}", run("measure", self.scene, "--method", "ray-bundle", flag, str(value)).stderr)
        for method, flag, right in (("particles", "--window", "radiosity"), ("radiosity", "--directions", "ray-bundle"),
                                    ("path", "--directions", "ray-bundle"), ("path", "--patch", "--first-shot")):
            value = {"--window": "hemicube", "--directions": "pair", "--patch": "1"}[flag]
            result = run("measure", self.scene, "--method", method, flag, value)
            self.assertEqual(result.returncode, 2)
            for part in (flag, method, right):
                self.assertIn(part, result.stderr)

    def test_patches_and_lights_are_reported(self):
        for method, options in (("ray-bundle", ()), ("radiosity", ("--window", "cube")), ("path", ("--first-shot", "auto"))):
            def document(threads):
                result = self.measure("--method", method, "--patch", "1", "--resolution", "32", *options,
                                      "--paths", "2048", "--threads", threads)
                del result["elapsed_s"]
                self.assertGreater(result.pop("first_shot_set_up_s"), 0)
                return result

            with self.subTest(method=method):
                first = document(1)
                self.assertEqual(document(2), first)
                patches, shot = first["patches"], first["patches"]["first_shot"]
                self.assertGreater(patches["count"], 10)
                self.assertEqual((patches["size_m"], shot["variant"], shot["resolution"]), (1, "incoming", 32))
                self.assertGreater(shot["bytes_per_patch"], 0)
                self.assertEqual(shot["lights"], [{"name": "bulb", "replaced": True, "samples": 1, "reason": "a point"}])

    def test_path_has_no_patches_unless_told(self):
        self.assertNotIn("patches", self.measure("--method", "path", "--paths", "2048"))

    def test_csv_files_hold_the_readings(self):
        document = self.measure("--error", "5%", "--csv", self.folder / "tables")
        for sensor in document["sensors"]:
            with open(self.folder / "tables" / f"{sensor['name']}.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), len(sensor["values"]))
            for row, value in zip(rows, sensor["values"]):
                self.assertAlmostEqual(float(row["illuminance_lx"]), value["value"], delta=1e-4 * value["value"])
                self.assertAlmostEqual(float(row["x_m"]), value["position"][0], 5)

    def test_without_lights_everything_is_dark(self):
        lights = ROOM.index("[lights.bulb]")
        self.scene = self.write("dark.toml", ROOM[:lights] + ROOM[ROOM.index("[sensors.desk]"):])
        for method in ("auto", "local", "path", "radiosity", "particles"):
            with self.subTest(method=method):
                result = self.measure("--method", method, "--paths", "1")
                self.assertEqual({value["value"] for sensor in result["sensors"] for value in sensor["values"]}, {0})

    def test_picture(self):
        picture = self.folder / "desk.png"
        self.measure("--error", "5%", "--falsecolor", picture)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_picture_is_that_of_the_results_file(self):
        straight, results, read = (self.folder / name for name in ("straight.png", "room.json", "read.png"))
        document = run("measure", self.scene, "--paths", "4096", "--json", "--falsecolor", straight).stdout
        results.write_text(document, encoding="utf-8")
        self.assertEqual(run("falsecolor", results, "-o", read, "--isolines").returncode, 0)
        self.assertEqual(straight.read_bytes(), read.read_bytes())
        self.assertEqual(json.loads(document)["scene_name"], "A room")

    def test_picture_without_a_grid_is_refused_before_the_run(self):
        start = time.monotonic()
        result = run("measure", self.scene, "--sensor", "wall", "--falsecolor", self.folder / "x.png", "--time", "30")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no grid and no area, and only these can be drawn", result.stderr)
        self.assertLess(time.monotonic() - start, 20)

    def test_picture_with_errors(self):
        results, plain, numbers = (self.folder / name for name in ("room.json", "plain.svg", "numbers.svg"))
        self.measure("--paths", "4096", "-o", results)
        for picture, flags in ((plain, ["--numbers"]), (numbers, ["--numbers", "--errors"])):
            self.assertEqual(run("falsecolor", results, "-o", picture, "--isolines", *flags).returncode, 0)
        self.assertGreater(numbers.read_text().count("<use"), plain.read_text().count("<use") + 20)

    def test_table(self):
        result = run("measure", self.scene, "--error", "5%")
        self.assertEqual(result.returncode, 0)
        for part in ("desk", "wall", "mean", "uniformity", "±"):
            self.assertIn(part, result.stdout)
        self.assertEqual(result.stderr, "")  # no progress where stderr is no terminal

    def printed_grid(self, *arguments):
        """The decimals that the table shows, checked against the values in the JSON; and the summary there."""
        arguments = ("--sensor", "desk", *arguments)
        lines = run("measure", self.scene, *arguments).stdout.splitlines()
        first = next(i for i, line in enumerate(lines) if "mean" in line) + 1
        rows = [line.split() for line in lines[first:first + 2]]
        (sensor,) = self.measure(*arguments)["sensors"]
        decimals = len(rows[0][0].partition(".")[2])
        cells = [f"{value['value']:.{decimals}f}" for value in sensor["values"]]
        self.assertEqual(rows, [cells[3:], cells[:3]])  # v points upwards
        return decimals, sensor["summary"]

    def test_grids_show_three_digits_of_their_largest_value(self):
        for flux, decimals in ((1e5, 0), (1e4, 0), (1e3, 1), (1e2, 2), (10, 3)):  # 7 to 8 lx at 100 lm
            with self.subTest(flux=flux):
                self.scene = self.write("room.toml", ROOM.replace("flux = 1000", f"flux = {flux}"))
                self.assertEqual(self.printed_grid("--error", "0.5%")[0], decimals)

    def test_grids_show_no_digits_beyond_the_error(self):
        decimals, summary = self.printed_grid("--method", "particles", "--patch", "0.05", "--paths", "1")
        low, high = summary["maximum_interval"]
        self.assertTrue(1 < (high - low) / 2 < 10, summary)
        self.assertLess(summary["maximum"], 99)  # three digits would be one decimal
        self.assertEqual(decimals, 0)

    def test_warnings_and_quiet(self):
        scene = self.write("spare.toml", ROOM + '[materials.spare]\ntype = "black"\n')
        arguments = ["measure", scene, "--error", "5%"]
        self.assertRegex(run(*arguments).stderr, r"^warning: .*spare")
        self.assertEqual(run(*arguments, "--quiet").stderr, "")

    def test_warnings_have_kinds(self):
        before, after = ROOM.split("[lights.bulb]")
        scene = self.write("dark.toml", before + "[sensors" + after.split("[sensors", 1)[1])
        result = json.loads(run("measure", scene, "--paths", "64", "--json", "--quiet").stdout)
        self.assertEqual(len(result["warnings"]), len(result["warning_kinds"]))
        of_dark = result["warning_kinds"].index("no-light")
        self.assertIn("no light: the scene is dark", result["warnings"][of_dark])
        lit = json.loads(run("measure", self.write("lit.toml", ROOM), "--paths", "64", "--json", "--quiet").stdout)
        self.assertNotIn("no-light", lit["warning_kinds"])


if __name__ == "__main__":
    unittest.main()
