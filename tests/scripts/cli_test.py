"""The command line as a user meets it: exit codes, messages, help, pictures."""

import csv
import json
import os
import signal
import subprocess
import unittest

from command_line import CAMERA, MOST_SECONDS, PROGRAM, ROOM, ROOT, CommandLineTest, run


class WrongInputTest(CommandLineTest):
    def test_no_command(self):
        self.expect_wrong_input([], "a command is missing", "measure")

    def test_unknown_command(self):
        self.expect_wrong_input(["mesure", self.scene], 'no command "mesure"', 'Did you mean "measure"?')

    def test_unknown_flag(self):
        self.expect_wrong_input(["measure", self.scene, "--treads", "2"], "--treads")

    def test_missing_scene(self):
        for command in ("measure", "info"):
            self.expect_wrong_input([command, self.folder / "no.toml"], "no.toml", "cannot be read")

    def test_misspelt_key(self):
        scene = self.write("typo.toml", ROOM.replace("reflectance", "reflectence"))
        line = ROOM[: ROOM.index("reflectance")].count("\n") + 1
        for command in ("measure", "info"):
            self.expect_wrong_input([command, scene], f"typo.toml:{line}:", "reflectence", 'Did you mean "reflectance"?')

    def test_misspelt_sensor(self):
        self.expect_wrong_input(["measure", self.scene, "--sensor", "desc"], 'Did you mean "desk"?', "wall")

    def test_cameras_are_not_measured(self):
        scene = self.write("view.toml", ROOM + CAMERA)
        self.expect_wrong_input(["measure", scene, "--sensor", "view"], 'sensor "view" is a camera', "render")
        scene = self.write("views.toml", ROOM[: ROOM.index("[sensors.desk]")] + CAMERA)
        self.expect_wrong_input(["measure", scene], "views.toml: no sensor to measure: all are cameras", "Render")

    def test_wrong_arguments(self):
        self.expect_wrong_input(["measure", self.scene, "--eror", "1%"], "no flag --eror", 'Did you mean "--error"?',
                                "stilb measure --help")
        self.expect_wrong_input(["measure", self.scene, "other.toml"], '"other.toml" is one argument too many')
        self.expect_wrong_input(["solve", self.scene], "--output FILE is missing. It gives the solution to write (- is stdout).",
                                "stilb solve --help")
        self.expect_wrong_input(["fit", "head.obj", "-o", "head.json"], "--degree N is missing. It gives the degree of the series")
        self.expect_wrong_input(["measure"], "SCENE is missing. It gives the scene file")
        self.expect_wrong_input(["render", self.scene, "-o"], "--output needs a value: --output FILE. See")
        self.expect_wrong_input(["measure", self.scene, "--quiet=x"], '--quiet takes no value. Leave out "=x".')
        self.expect_wrong_input(["measure", self.scene, "--paths", "3", "--paths", "4"], "--paths is given 2 times. Give it once.")
        self.expect_wrong_input(["measure", self.scene, "--paths", "0"], "--paths: 0 is out of range",
                                "Give a whole number from 1 to 9007199254740992.")
        self.expect_wrong_input(["solve", self.scene, "-o", "x.solution", "--degree", "99"], "from 0 to 12")
        self.expect_wrong_input(["measure", self.scene, "--threads", "1e9"], "--threads", "from 0 to 4096")
        self.expect_wrong_input(["render", self.scene, "-o", "x.png", "--exposure", "0"], "Give a number above 0.")
        self.write("view.toml", ROOM + CAMERA)
        for white in ("warm", "900", "nan", ""):
            self.expect_wrong_input(["render", self.folder / "view.toml", "-o", "x.png", "--white", white],
                                    f"--white {white}: expected auto or a colour temperature from 1000 to 25000 K")

    def test_numbers(self):
        for flag in ("--time", "--patch"):
            self.expect_wrong_input(["measure", self.scene, flag, "long"], f'{flag}: "long" is not a number')

    def test_folders_are_named_as_such(self):
        for command in (["measure"], ["info"], ["render", "-o", self.folder / "x.png"]):
            self.expect_wrong_input([*command, self.folder], f"{self.folder}: cannot be read, because it is a folder")

    def test_whole_numbers(self):
        for typed in ("1.5", "1e-3", "many", "1e4x"):
            self.expect_wrong_input(["measure", self.scene, "--paths", typed], f'--paths: "{typed}" is not a whole number', "2e4")
        self.expect_wrong_input(["measure", self.scene, "--bounces", "0.5"], '--bounces: "0.5" is not a whole number')
        self.expect_wrong_input(["measure", self.scene, "--seed", "1e30"], "--seed", "Write all of its digits")
        self.expect_wrong_input(["measure", self.scene, "--paths", "-1e4"], "--paths: -10000 is out of range")

    def test_the_first_unexpected_argument_is_named(self):
        suggestion = 'no flag --errors. Did you mean "--error"?'
        for arguments in (["--errors", "1%"], ["--errors=1%"], ["--errors", "1%", "--bogus"]):
            for typed in ([self.scene, *arguments], [*arguments, self.scene]):
                self.expect_wrong_input(["measure", *typed], suggestion)
        self.expect_wrong_input(["measure", self.scene, "1%", "--errors"], '"1%" is one argument too many')
        self.expect_wrong_input(["measure", self.scene, "-json"], 'no flag -json. Did you mean "--json"?')

    def test_arguments_before_the_command(self):
        for arguments in (["--json", "measure", self.scene], ["--json", "measure"]):
            self.expect_wrong_input(arguments, "--json stands before the command", "stilb measure ... --json")
        for flag in (["--error", "1%"], ["--error=1%"]):
            self.expect_wrong_input([*flag, "measure", self.scene], "--error stands before the command")
        self.expect_wrong_input(["--bogus", "measure", self.scene], "no flag --bogus", "stilb measure --help")
        self.expect_wrong_input(["--eror", "1%", "measure", self.scene], "no flag --eror", 'Did you mean "--error"?')
        self.expect_wrong_input([self.scene, "measure"], "is one argument too many", "follow the name of the command, measure")
        self.expect_wrong_input(["--hlp"], "no flag --hlp", 'Did you mean "--help"?')

    def test_misspelt_method(self):
        self.expect_wrong_input(["measure", self.scene, "--method", "locl"], "locl", "local")

    def test_values_out_of_range(self):
        for flag, value in [("--error", "0"), ("--error", "200%"), ("--error", "nan"), ("--time", "-1"),
                            ("--paths", "-5"), ("--bounces", "-1"), ("--threads", "-2"), ("--seed", "x"), ("--seed", "-1")]:
            with self.subTest(flag=flag, value=value):
                self.expect_wrong_input(["measure", self.scene, f"{flag}={value}"], flag.lstrip("-"))

    def test_files_that_cannot_be_written_are_named_before_computing(self):
        (self.folder / "folder.png").mkdir()
        pictures = ["desk.jpg", "no/folder/desk.png", "room.toml/desk.png", "folder.png", "/proc/desk.png"]
        folders = ["room.toml", "room.toml/tables", "/proc/tables", "/proc"]
        for flag, names in (("--falsecolor", pictures), ("--csv", folders)):
            for name in names:
                with self.subTest(flag=flag, name=name):  # the table is printed first, but nothing may be printed
                    self.expect_wrong_input(["measure", self.scene, flag, self.folder / name], name)
        self.scene.write_text(ROOM + CAMERA)
        self.expect_wrong_input(["render", self.scene, "-o", "/proc/view.exr"], "/proc/view.exr", "writable")
        self.expect_wrong_input(["solve", self.scene, "-o", "/proc/room.solution"], "/proc/room.solution", "writable")

    def test_a_check_before_computing_leaves_files_alone(self):
        old = b"\x89PNG\r\n\x1a\n an older picture"
        picture = self.folder / "desk.png"
        picture.write_bytes(old)
        files = set(self.folder.iterdir())
        self.expect_wrong_input(["measure", self.scene, "--falsecolor", picture, "--csv", self.scene], "room.toml")
        self.assertEqual((picture.read_bytes(), set(self.folder.iterdir())), (old, files))


@unittest.skipUnless(os.path.exists("/dev/full"), "this system has no /dev/full")
class FullDiskTest(CommandLineTest):
    def test_output_that_is_not_written_is_noticed(self):
        results = self.write("long.toml", ROOM.replace("count = [3, 2]", "count = [60, 40]"))  # longer than the buffer
        for command in (["measure", self.scene], ["measure", results, "--paths", "1", "--json"], ["info", self.scene], ["help"],
                        ["--version"]):
            with self.subTest(command=command), open("/dev/full", "w") as full:
                result = subprocess.run([PROGRAM, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True,
                                        timeout=MOST_SECONDS)
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, r"^stilb: standard output cannot be written[^\n]*\n$")


    def test_what_is_computed_is_printed_all_the_same(self):
        self.scene.write_text(ROOM + CAMERA.replace("[640, 480]", "[16, 12]"))
        few, patch = ["--paths", 64], ["--paths", 16, "--patch", 2]
        (self.folder / "table").mkdir()
        for name, command, printed in (
                ("out.json", ["measure", self.scene, *few, "-o"], r"desk[^\0]*mean .* lx"),
                ("desk.png", ["measure", self.scene, *few, "--sensor", "desk", "--falsecolor"], "mean .* lx"),
                ("table/desk.csv", ["measure", self.scene, *few, "--csv"], "mean .* lx"),
                ("room.solution", ["solve", self.scene, *patch, "-o"], "16 steps in"),
                ("view.exr", ["render", self.scene, "--paths", 4, "-o"], "mean luminance"),
                ("view.png", ["render", self.scene, "--paths", 4, "-o"], "mean luminance"),
                ("page.html", ["report", self.scene, *few, "--view-passes", 2, "-o"], "64 paths in"),
                ("walk.html", ["view", self.scene, *patch, "-o"], "16 steps in")):
            with self.subTest(output=name):
                output = self.folder / name
                output.symlink_to("/dev/full")
                result = run(*command, output.parent if "--csv" in command else output)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stdout, printed)
                self.assertRegex(result.stderr, rf"stilb: cannot write '.*{output.name}'.*space left")
                self.assertNotIn("MB", result.stdout)

    def test_one_file_that_cannot_be_written_costs_no_other(self):
        (self.folder / "desk.png").symlink_to("/dev/full")
        result = run("measure", self.scene, "--paths", 64, "--sensor", "desk", "--falsecolor", "desk.png", "-o", "out.json",
                     "--csv", "table", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        json.loads((self.folder / "out.json").read_text())
        self.assertTrue((self.folder / "table/desk.csv").exists())

    def test_a_preview_that_cannot_be_written_ends_no_picture(self):
        self.scene.write_text(ROOM + CAMERA.replace("[640, 480]", "[16, 12]"))
        (self.folder / "now.png").symlink_to("/dev/full")
        result = run("render", self.scene, "--paths", 64, "-o", "view.png", "--preview", "now.png", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("now.png", result.stderr)
        self.assertTrue((self.folder / "view.png").read_bytes().endswith(b"IEND\xaeB`\x82"))


class StreamsTest(CommandLineTest):
    """Standard streams that are closed, or whose reader goes."""

    def bash(self, command):
        return subprocess.run(["bash", "-c", command, "bash", PROGRAM], cwd=self.folder, capture_output=True, text=True,
                              timeout=MOST_SECONDS)

    def test_closed_streams_are_no_files(self):
        for closed, code in ((">&- 2>&-", 1), ("<&- >&- 2>&-", 1), (">&-", 1), ("2>&-", 0), ("<&- 2>&-", 0)):
            with self.subTest(closed=closed):
                output = self.folder / "out.json"
                output.unlink(missing_ok=True)
                result = self.bash(f'"$1" measure room.toml --paths 64 -o out.json {closed}')
                self.assertEqual(result.returncode, code)
                self.assertEqual(len(json.loads(output.read_text())["sensors"]), 2)
                self.assertEqual("desk" in result.stdout, code == 0)
                self.assertEqual("standard output cannot be written" in result.stderr, closed == ">&-")
        for command in ("info room.toml", "measure nothing.toml", "solve room.toml --paths 8 --patch 2 -o x.solution", "help"):
            self.assertIn(self.bash(f'"$1" {command} <&- >&- 2>&-').returncode, (1, 2), command)
        self.assertEqual((self.folder / "x.solution").read_bytes()[:8], b"STILBSOL")

    def test_messages_that_cannot_be_written_end_nothing(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("this system has no /dev/full")
        result = self.bash('"$1" measure room.toml --paths 64 --progress 2> /dev/full')
        self.assertEqual(result.returncode, 0)
        self.assertIn("desk", result.stdout)
        self.assertEqual(self.bash('"$1" measure nothing.toml 2> /dev/full').returncode, 2)

    def test_a_reader_that_goes_ends_the_output_only(self):
        self.write("long.toml", ROOM.replace("count = [3, 2]", "count = [60, 40]"))
        result = self.bash('"$1" measure long.toml --paths 64 --json -o out.json | head -n 1; exit ${PIPESTATUS[0]}')
        self.assertEqual((result.returncode, result.stdout, result.stderr), (128 + signal.SIGPIPE, "{\n", ""))
        json.loads((self.folder / "out.json").read_text())

    def test_a_reader_of_progress_that_goes_ends_no_run(self):
        result = self.bash('("$1" measure room.toml --time 3 --error 0.00001% --progress -o out.json 2>&1 > table; '
                           'echo $? > code) | head -n 1')
        self.assertRegex(result.stdout, r"^\d")
        self.assertEqual((self.folder / "code").read_text(), "3\n")
        self.assertEqual(json.loads((self.folder / "out.json").read_text())["stopped"], "time over")
        self.assertIn("desk", (self.folder / "table").read_text())

    def test_names_are_as_long_as_they_may_be(self):
        name = "ä" * 125 + ".json"  # 255 bytes
        self.assertEqual(run("measure", self.scene, "--paths", 64, "-o", name, cwd=self.folder).returncode, 0)
        json.loads((self.folder / name).read_text())


class RenderTest(CommandLineTest):
    def test_a_first_look_needs_no_lamp_and_no_camera(self):
        dark = ROOM[: ROOM.index("[lights.")]
        scene = self.write("dark.toml", dark)
        picture = self.folder / "dark.png"
        for arguments in ((scene, "--preview"), ("--preview", scene)):
            result = run("render", *arguments, "-o", picture)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("A first look: one lamp at the camera", result.stdout)
            self.assertGreater(picture.stat().st_size, 1000)
            picture.unlink()
        self.expect_wrong_input(["render", scene], "-o is missing")

    def render(self, scene, picture, *flags):
        file = self.write("view.toml", scene + CAMERA.replace("[640, 480]", "[64, 48]").replace("fisheye", "perspective"))
        result = run("render", file, "-o", self.folder / picture, "--paths", "4", *flags)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_white_balance(self):
        """The message names the white; without another light than that of the lamps, it is theirs."""
        warm = ROOM.replace("flux = 1000", "flux = 1000\ncct = 3000")
        self.assertRegex(self.render(warm, "a.png"), r"a\.png: exposure [\d.e-]+ per cd/m², white 3000 K\n")
        self.assertIn("white 4000 K", self.render(warm, "b.png", "--white", "4000"))
        pictures = [(self.folder / name).read_bytes() for name in ("a.png", "b.png")]
        self.assertNotEqual(*pictures)
        for number, flags in enumerate(([], ["--white", "2700"])):
            self.assertNotIn("white", self.render(warm, f"{number}.hdr", *flags))

    def test_darkness(self):
        """No share of nothing."""
        dark = ROOM[:ROOM.index("[lights.bulb]")] + ROOM[ROOM.index("[sensors.desk]"):]
        printed = self.render(dark, "dark.png")
        self.assertIn("mean standard error of a pixel: 0 cd/m²\n", printed)
        self.assertNotIn("nan %", printed)
        self.assertIn("exposure 1 per cd/m²", printed)


class FalsecolorTest(CommandLineTest):
    def radiance_picture(self):
        """Two grey pixels as Radiance writes them."""
        picture = self.folder / "view.hdr"
        pixels = bytes([128, 128, 128, 129, 200, 200, 200, 130])
        picture.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixels)
        return picture

    def test_pictures(self):
        drawing = self.folder / "view.png"
        result = run("falsecolor", self.radiance_picture(), "-o", drawing, "--log", "--isolines", "--numbers")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(drawing.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_wrong_input(self):
        picture = self.radiance_picture()
        drawing = self.folder / "view.png"
        self.expect_wrong_input(["falsecolor", picture, "-o", drawing, "--sensor", "desk"], "--sensor")
        self.expect_wrong_input(["falsecolor", picture, "-o", drawing, "--errors"], "--errors", "SE.Y")
        self.expect_wrong_input(["falsecolor", self.folder / "none.exr", "-o", drawing], "none.exr", "cannot be read")
        picture.write_bytes(picture.read_bytes()[:-1])
        self.expect_wrong_input(["falsecolor", picture, "-o", drawing], "view.hdr", "row 1 of 1")


class ReproduceTest(CommandLineTest):
    def test_unknown_figure(self):
        self.expect_wrong_input(["reproduce", "sobolew", "-o", self.folder], 'Did you mean "sobolev"?', "room", "polar")

    def test_another_head(self):
        mesh, folder = self.write("head.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), self.folder / "figures"
        head = ["reproduce", "harmonics", "-o", folder, "--mesh"]
        self.expect_wrong_input([*head, self.folder / "none.ply"], "none.ply", "cannot be read")
        self.expect_wrong_input([*head, mesh], "head.obj:3")
        self.expect_wrong_input([*head, self.scene], "room.toml", "use .obj, .ply")
        for figure in (["room"], []):
            self.expect_wrong_input(["reproduce", *figure, "-o", folder, "--mesh", mesh], "--mesh", "harmonics")

    def test_sobolevs_problem(self):
        result = run("reproduce", "sobolev", "-o", self.folder / "figures")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual({file.name for file in (self.folder / "figures").iterdir()},
                         {"sobolev.csv", "sobolev.png", "sobolev.svg"})
        with open(self.folder / "figures/sobolev.csv", newline="") as file:
            rows = [{name: float(cell) for name, cell in row.items()} for row in csv.DictReader(file)]
        # Independent errors: of 101 intervals of 95 %, more than 12 fail twice in a thousand times.
        name = "double_local_each_2000"
        missed = [row for row in rows if not row[f"{name}_lower_lx"] <= row["exact_lx"] <= row[f"{name}_upper_lx"]]
        self.assertEqual(len(rows), 101)
        self.assertLessEqual(len(missed), 12)

    def test_the_rooms_are_read_without_warnings(self):
        for scene in ("scenes/paper/room.toml", "scenes/head/head.toml"):
            result = run("info", ROOT / scene, "--json")
            self.assertEqual(json.loads(result.stdout)["warnings"], [])


class HelpTest(CommandLineTest):
    def test_examples_come_first(self):
        for command in ("measure", "solve", "render", "view", "fit", "info", "falsecolor", "reproduce"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            examples, rest = result.stdout.split("\n\n", 1)
            self.assertTrue(examples.startswith("Examples:\n  stilb "), examples)
            self.assertIn(f"  stilb {command} ", examples)
            self.assertIn("Options:", rest)

    def test_verify_takes_cases_or_those_of_cie171(self):
        self.expect_wrong_input(["verify", "--cie171", "--case", "sobolev"], "--case and --cie171", "one of them")
        self.expect_wrong_input(["verify", "--cie171", "--method", "path", "--method", "auto"], "one --method at most")

    def test_a_flag_that_may_be_repeated_takes_one_value_at_a_time(self):
        for command, flag in (("measure", "--sensor"), ("verify", "--case"), ("verify", "--method")):
            self.assertRegex(run(command, "--help").stdout, f"{flag} NAME +[A-Z].* \\(may be repeated\\)\n")

    def test_flags_of_patches_have_a_page_of_their_own(self):
        topic = run("help", "patches")
        self.assertEqual((topic.returncode, topic.stderr), (0, ""))
        for command in ("measure", "render", "report"):
            text = run(command, "--help").stdout
            self.assertIn("stilb help patches", text)
            self.assertIn("--patch ", text)
            for flag in ("--first-shot", "--window", "--resolution", "--visibility", "--directions"):
                self.assertNotIn(flag, text)
                self.assertRegex(topic.stdout, rf"{flag} [A-Z]+ ")
        self.assertIn("--first-shot", run("solve", "--help").stdout)
        self.assertIn('Did you mean "patches"?', run("help", "patche").stderr)

    def test_help_is_a_command_too(self):
        for command in ([], ["measure"], ["help"]):
            result = run("help", *command)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(result.stdout, run(*command, "--help").stdout)
        self.assertIn("  help  ", run("--help").stdout)
        self.expect_wrong_input(["help", "mesure"], 'no command "mesure"', 'Did you mean "measure"?')

    def test_version(self):
        for flag in ("--version", "-V"):
            result = run(flag)
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stdout, r"^\d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    unittest.main()
