"""The files of the command line: what may be written over, what is read as what, and what an interruption leaves."""

import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from command_line import BOX, CAMERA, MOST_SECONDS, PROGRAM, ROOM, ROOT, CommandLineTest, run, wait_for_error

LAMP = """
[lights.lamp]
type = "photometry"
file = "lamp.ldt"
position = [1, 1, 2]
"""
SMALL_CAMERA = CAMERA.replace("[640, 480]", "[16, 12]")


class FilesTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / "scenes/office/luminaire.ldt", self.folder / "lamp.ldt")
        self.scene = self.write("room.toml", ROOM + LAMP + SMALL_CAMERA)
        self.mesh = self.write("box.obj", BOX)
        self.picture = self.folder / "view.hdr"
        self.picture.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                 + bytes([128, 128, 128, 129, 200, 200, 200, 130]))


class OverwritingTest(FilesTest):
    def expect_unchanged(self, path, arguments, *parts):
        before = path.read_bytes()
        self.expect_wrong_input(arguments, path.name, *parts)
        self.assertEqual(path.read_bytes(), before)

    def test_files_that_are_read_stay(self):
        (self.folder / "link.solution").symlink_to(self.scene)
        shutil.copy(self.picture, self.folder / "panorama.hdr")
        around = self.write("around.toml", self.scene.read_text()
                            + '[lights.sky]\ntype = "environment"\nfile = "panorama.hdr"\n')
        cases = (("room.toml", "solve", self.scene, "-o", self.scene),
                 ("room.toml", "solve", self.scene, "-o", self.folder / "link.solution"),
                 ("lamp.ldt", "solve", self.scene, "-o", self.folder / "./lamp.ldt"),
                 ("panorama.hdr", "render", around, "-o", self.folder / "panorama.hdr"),
                 ("panorama.hdr", "render", around, "-o", self.folder / "x.exr", "--preview", self.folder / "panorama.hdr"),
                 ("box.obj", "fit", self.mesh, "-o", self.mesh, "--degree", 4))
        for name, *arguments in cases:
            with self.subTest(arguments=arguments):
                self.expect_unchanged(self.folder / name, arguments, "cannot be written over", "another file")

    def test_files_that_are_read_stay_under_another_name(self):
        picture, link = self.picture.rename(self.folder / "view.png"), self.folder / "room.png"
        self.expect_unchanged(picture, ["falsecolor", picture, "-o", picture], "cannot be written over")
        link.symlink_to(self.scene)
        for arguments in (["measure", self.scene, "--falsecolor", link], ["render", self.scene, "-o", link],
                          ["render", self.scene, "-o", self.folder / "x.exr", "--preview", link]):
            with self.subTest(arguments=arguments):
                self.expect_unchanged(link, arguments, "cannot be written over", "room.toml")

    def test_files_of_other_kinds_stay(self):
        notes, series = self.write("notes.txt", "My notes\n"), self.folder / "box.json"
        self.assertEqual(run("fit", self.mesh, "-o", series, "--degree", 4).returncode, 0)
        cases = ((notes, "solve", self.scene, "-o", notes), (series, "solve", self.scene, "-o", series),
                 (self.scene, "fit", self.mesh, "-o", self.scene, "--degree", 4),
                 (self.picture, "fit", self.mesh, "-o", self.picture, "--degree", 4))
        for path, *arguments in cases:
            with self.subTest(arguments=arguments):
                self.expect_unchanged(path, arguments, "exists and is", "but the result is", "another file")
        drawing = self.write("notes.png", "My notes\n")
        for arguments in (["measure", self.scene, "--falsecolor", drawing], ["render", self.scene, "-o", drawing],
                          ["falsecolor", self.picture, "-o", drawing]):
            with self.subTest(arguments=arguments):
                self.expect_unchanged(drawing, arguments, "a file of another kind, but the result is a PNG picture")

    def test_files_of_the_same_kind_and_empty_ones_are_replaced(self):
        for name, *arguments in (("x.json", "fit", self.mesh, "--degree", 4), ("x.png", "falsecolor", self.picture),
                                 ("x.svg", "falsecolor", self.picture),
                                 ("x.hdr", "render", self.scene, "--paths", 2), ("x.exr", "render", self.scene, "--paths", 2),
                                 ("x.solution", "solve", self.scene, "--patch", 1, "--paths", 8)):
            output = self.write(name, "")
            for _ in range(2):
                with self.subTest(name=name):
                    result = run(*arguments, "-o", output)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertGreater(output.stat().st_size, 0)


class KindsTest(FilesTest):
    def test_what_is_no_scene_is_named(self):
        series, solution, results = (self.folder / name for name in ("head.json", "x.solution", "results.json"))
        self.assertEqual(run("fit", self.mesh, "-o", series, "--degree", 4).returncode, 0)
        self.assertEqual(run("solve", self.scene, "-o", solution, "--patch", 1, "--paths", 8).returncode, 0)
        results.write_text(run("measure", self.scene, "--paths", 64, "--json").stdout)
        cases = ((self.write("x.exr", "\x76\x2f\x31\x01"), "an OpenEXR picture", "stilb falsecolor", "x.exr -o x.png"),
                 (self.picture, "a Radiance picture", "stilb falsecolor", "view.hdr -o view.png"),
                 (series, "a surface by spherical harmonics", 'of shape "harmonics"'),
                 (solution, "a solution", "stilb render --from", "x.solution -o x.png"),
                 (results, "a document with results", "stilb falsecolor", "results.json -o results.png"),
                 (self.write("other.json", "{}"), "a JSON document", "TOML"))
        for path, *parts in cases:
            for command in (["info"], ["measure"], ["solve", "-o", "new.solution"]):
                with self.subTest(path=path.name, command=command):
                    self.expect_wrong_input([*command, path], f"{path.name}: not a scene but", *parts)

    def test_parts_of_scenes_are_shown_by_info(self):
        lamp = self.folder / "lamp.ldt"
        self.expect_wrong_input(["measure", lamp], "not a scene but a EULUMDAT luminaire", "stilb info", lamp.name)
        for path in (self.mesh, lamp):
            self.assertEqual(run("info", path).returncode, 0)


class ResultsFileTest(FilesTest):
    def test_json_as_a_file(self):
        results = self.folder / "results.json"
        result = run("measure", self.scene, "--paths", 64, "--json", "-o", results)
        self.assertEqual((result.returncode, results.read_text()), (0, result.stdout))
        result = run("measure", self.scene, "--paths", 64, "--sensor", "wall", "-o", results)
        self.assertIn("95 % intervals", result.stdout)
        self.assertEqual([sensor["name"] for sensor in json.loads(results.read_text())["sensors"]], ["wall"])
        self.assertEqual(run("falsecolor", results, "-o", self.folder / "x.png").returncode, 2)  # no grid
        for output in (self.scene, self.mesh, self.folder / "none/results.json"):
            self.expect_wrong_input(["measure", self.scene, "-o", output], output.name)


class ShortfallTest(FilesTest):
    def test_a_picture_or_solution_that_missed_its_error_is_written_and_says_so(self):
        scene = self.write("exact.toml", ROOM + CAMERA.replace("[640, 480]", "[64, 48]") + "[run]\nerror = 1e-4\ntime = 5\n")
        for command, name in ((["render"], "view.exr"), (["solve", "--patch", 1], "room.solution")):
            with self.subTest(command=command[0]):
                output = self.folder / name
                result = run(*command, scene, "-o", output)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertTrue(output.exists())
                self.assertRegex(result.stdout, r"(?m)^The requested error of 0.01 % is not reached: the error is [0-9.]+ %\. "
                                                rf"{re.escape(str(output))} has the result so far\.$")


class StandardInputTest(FilesTest):
    def feed(self, path, *arguments):
        with open(path, "rb") as file:
            piped = subprocess.Popen(["cat"], stdin=file, stdout=subprocess.PIPE)  # a pipe cannot be read twice
            result = run(*arguments, cwd=self.folder, stdin=piped.stdout)
            piped.stdout.close()
            piped.wait()
        return result

    def test_scenes(self):
        direct = run("measure", "room.toml", "--paths", 64, cwd=self.folder)
        self.assertEqual(self.feed(self.scene, "measure", "-", "--paths", 64).stdout.rpartition(" in ")[0],
                         direct.stdout.rpartition(" in ")[0])
        self.assertIn("lamp.ldt", self.feed(self.scene, "info", "-").stdout)
        result = self.feed(self.scene, "render", "-", "-o", "x.exr", "--paths", 2)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        result = self.feed(self.mesh.with_name("view.hdr"), "measure", "-")
        self.assertIn("-: not a scene but a Radiance picture", result.stderr)
        wrong = self.write("wrong.toml", ROOM.replace("reflectance", "reflectence"))
        self.assertRegex(self.feed(wrong, "measure", "-").stderr, r"-:\d+: .*reflectence")

    def test_pictures_and_results(self):
        self.assertEqual(run("measure", self.scene, "--paths", 64, "-o", self.folder / "results.json").returncode, 0)
        for path in (self.picture, self.folder / "results.json"):
            result = self.feed(path, "falsecolor", "-", "-o", "x.png")
            self.assertEqual((result.returncode, result.stderr), (0, ""))


class InterruptionTest(FilesTest):
    def start(self, *arguments, **options):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                **options)

    def endless_solve(self, output):
        return ["solve", self.scene, "-o", output, "--patch", 1, "--time", MOST_SECONDS - 10, "--progress"]

    def test_results_survive_the_end_of_the_session(self):
        measure = self.start("measure", self.scene, "--json", "--error", "0.00001%", "--time", MOST_SECONDS - 10,
                             "--progress")
        solution = self.folder / "room.solution"
        solve = self.start(*self.endless_solve(solution))
        for process in (measure, solve):
            wait_for_error(process)
            process.send_signal(signal.SIGHUP)
            process.send_signal(signal.SIGHUP)  # the shell and the system send one each
            output, errors = process.communicate(timeout=MOST_SECONDS)
            self.assertEqual(process.returncode, 3, errors)
            if process is measure:
                self.assertEqual(json.loads(output)["stopped"], "interrupted")
        self.assertEqual(solution.read_bytes()[:8], b"STILBSOL")

    def test_results_survive_a_closed_terminal(self):
        solution = self.folder / "room.solution"
        keyboard, terminal = os.openpty()
        process = subprocess.Popen([PROGRAM, *map(str, self.endless_solve(solution))], stdin=terminal, stdout=terminal,
                                   stderr=terminal, start_new_session=True)
        os.close(terminal)
        shown = b""
        while b" error " not in shown:  # until there is a result
            shown += os.read(keyboard, 4096)
        os.close(keyboard)  # from now on, writing to the terminal fails
        process.send_signal(signal.SIGHUP)
        process.wait(timeout=MOST_SECONDS)
        self.assertEqual(solution.read_bytes()[:8], b"STILBSOL")

    def test_nohup_goes_on(self):
        process = self.start("measure", self.scene, "--json", "--time", 2, "--error", "0.00001%",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        time.sleep(0.5)
        process.send_signal(signal.SIGHUP)
        output, errors = process.communicate(timeout=MOST_SECONDS)
        self.assertEqual((process.returncode, json.loads(output)["stopped"]), (3, "time over"), errors)

    def test_interrupted_fits_leave_whole_files_or_none(self):
        """Signals at moments all over the run, more of them towards its end, where the files are written."""
        series, table = self.folder / "box.json", self.folder / "errors.csv"
        fit = ["fit", self.mesh, "-o", series, "--degree", 8, "--csv", table]
        start = time.monotonic()
        self.assertEqual(run(*fit).returncode, 0)
        duration = time.monotonic() - start
        names = {path.name for path in self.folder.iterdir()}
        whole, rows = series.read_bytes(), table.read_bytes()
        for i in range(24):
            for path in (series, table):
                path.unlink(missing_ok=True)
            process = self.start(*fit)
            time.sleep(duration * (1 - (i / 24)**2))
            process.send_signal((signal.SIGINT, signal.SIGTERM, signal.SIGHUP)[i % 3])
            process.communicate(timeout=MOST_SECONDS)
            self.assertLessEqual({path.name for path in self.folder.iterdir()}, names)
            if series.exists():
                self.assertEqual(series.read_bytes(), whole)
            if table.exists():
                self.assertEqual(table.read_bytes(), rows)


class NamesAndEncodingsTest(FilesTest):
    def test_names_that_are_not_utf8(self):
        scene = self.folder / os.fsdecode(b"r\xff.toml")
        shutil.copy(self.scene, scene)
        output = self.folder / "out.json"
        self.assertEqual(run("measure", scene, "--paths", 32, "--quiet", "-o", output, errors="replace").returncode, 0)
        self.assertTrue(json.loads(output.read_text())["scene"].endswith("r\N{REPLACEMENT CHARACTER}.toml"))
        info = json.loads(run("info", scene, "--json").stdout)
        self.assertTrue(info["file"].endswith("r\N{REPLACEMENT CHARACTER}.toml"))
        self.assertEqual(run("measure", scene, "--paths", 32, "--quiet", "--falsecolor", self.folder / "desk.png",
                             errors="replace").returncode, 0)

    def test_names_of_255_bytes(self):
        output = self.folder / ("n" * 250 + ".json")
        self.assertEqual(run("measure", self.scene, "--paths", 32, "--quiet", "-o", output).returncode, 0)
        self.assertIn("sensors", json.loads(output.read_text()))

    def test_headers_of_pictures_that_are_not_utf8(self):
        self.picture.write_bytes(self.picture.read_bytes().replace(b"RADIANCE\n", b"RADIANCE\nSCENE= Gl\xfchlampe\xff\n"))
        drawing = self.folder / "view.svg"
        self.assertEqual(run("falsecolor", self.picture, "-o", drawing).returncode, 0)
        self.assertTrue(drawing.read_bytes().startswith(b"<?xml"))

    def test_byte_order_marks(self):
        mark = "\N{ZERO WIDTH NO-BREAK SPACE}"
        scene = self.write("marked.toml", mark + self.scene.read_text())
        for name, text in (("panel.rad", "void plastic w 0 0 5 .5 .5 .5 0 0\nw polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n"),
                           ("box.obj", BOX)):
            self.assertEqual(run("info", self.write(name, mark + text)).returncode, 0, name)
        points = self.write("p.pts", mark + "1 1 0.75 0 0 1\n")
        self.assertEqual(run("measure", scene, "--points", points, "--paths", 32, "--quiet").returncode, 0)
        utf16 = self.folder / "wide.toml"
        utf16.write_bytes(self.scene.read_text().encode("utf-16"))
        self.expect_wrong_input(["info", utf16], "wide.toml: is text in UTF-16. Save it as UTF-8.")

    def test_files_of_other_programs_are_named(self):
        for name, text, kind in (("a.epw", "LOCATION,Berlin,-,DEU\n", "weather data"),
                                 ("b.xml", '<?xml version="1.0"?><WindowElement/>', "scatters"),
                                 ("c.dxf", "0\nSECTION\n", "CAD drawing"), ("d.uld", "x", "ULD"),
                                 ("e.oct", "x", "octree of Radiance"), ("f.skp", "x", "3D model")):
            self.expect_wrong_input(["info", self.write(name, text)], f"{name}: not a scene but ", kind)


if __name__ == "__main__":
    unittest.main()
