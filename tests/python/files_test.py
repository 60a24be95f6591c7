"""What the package writes and reads beside scenes: the files are those of the command line."""

import json
import os
import pickle
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy as np
import stilb
from room import PROGRAM, TOML, built, program

PATHS = 2048
os.environ["PATH"] = f"{Path(PROGRAM).parent}:{os.environ['PATH']}"  # where pip would have put the program


def octahedron(radius):
    vertices = radius * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    faces = [[x, y, z] if (x + y + z) % 2 == 0 else [y, x, z] for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in vertices) + "".join(
        f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "room.toml"
        self.file.write_text(TOML)

    def ran(self, *arguments):
        result = program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_exports_are_those_of_the_command_line(self):
        for format in ("radiance", "mitsuba"):
            files = stilb.load(self.file).export(self.folder / "own" / format, format)
            self.ran("export", self.file, "--format", format, "-o", self.folder / "typed" / format)
            typed = [path for path in (self.folder / "typed" / format).rglob("*") if path.is_file()]
            self.assertEqual({path.name for path in files}, {path.name for path in typed})
            for path in typed:
                own = self.folder / "own" / format / path.relative_to(self.folder / "typed" / format)
                self.assertEqual(own.read_bytes(), path.read_bytes(), path)
        with self.assertRaisesRegex(stilb.InputError, "there is no format mitsuba4. Did you mean \"mitsuba\""):
            built().export(self.folder / "other", "mitsuba4")

    def test_built_scenes_are_exported_with_warnings(self):
        scene = built()
        scene.materials["wall"] = stilb.Ward(diffuse=0.5, specular=0.1, roughness=(0.1, 0.2))
        with self.assertWarns(stilb.ResultWarning) as caught:
            scene.export(self.folder / "own", "mitsuba")
        self.assertEqual(caught.filename, __file__)
        self.assertTrue((self.folder / "own/measure.py").is_file())

    def test_points_are_those_of_the_command_line(self):
        (self.folder / "grid.pts").write_text("# points\n1 1 0.75 0 0 2\n2 1 0.75 0 0 1\n\n2 2 1 1 0 0\n")
        points, normals = stilb.read_points(self.folder / "grid.pts")
        self.assertEqual((points.shape, normals.shape), ((3, 3), (3, 3)))
        np.testing.assert_array_equal(normals[0], [0, 0, 1])
        reading = stilb.load(self.file).illuminance(points, normals, paths=PATHS)
        typed = program("measure", self.file, "--points", self.folder / "grid.pts", "--paths", PATHS, "--json")
        values = [value["value"] for value in json.loads(typed.stdout)["sensors"][0]["values"]]
        np.testing.assert_array_equal(reading.value, values)
        (self.folder / "wrong.pts").write_text("1 1 0.75\n")
        with self.assertRaisesRegex(stilb.InputError, "wrong.pts:1: "):
            stilb.read_points(self.folder / "wrong.pts")

    def test_false_colours_are_those_of_the_command_line(self):
        result = stilb.load(self.file).measure(paths=PATHS)
        (self.folder / "room.json").write_text(result.to_json())
        self.ran("falsecolor", self.folder / "room.json", "-o", self.folder / "typed.svg", "--isolines", "--errors", "--max", 80)
        result.falsecolor(self.folder / "own.svg", isolines=True, errors=True, maximum=80)
        self.assertEqual((self.folder / "own.svg").read_bytes(), (self.folder / "typed.svg").read_bytes())
        pickle.loads(pickle.dumps(result)).falsecolor(self.folder / "again.svg", isolines=True, errors=True, maximum=80)
        self.assertEqual((self.folder / "again.svg").read_bytes(), (self.folder / "typed.svg").read_bytes())
        with self.assertRaisesRegex(KeyError, "no result of a sensor 'desc'"):
            result.falsecolor(self.folder / "own.svg", sensors=["desc"])
        with self.assertRaisesRegex(stilb.InputError, "own.jpg"):
            result.falsecolor(self.folder / "own.jpg")
        with unittest.mock.patch.dict(os.environ, {"PATH": "/nowhere"}), self.assertRaisesRegex(FileNotFoundError, "program stilb"):
            result.falsecolor(self.folder / "own.svg")

    def test_false_colours_of_pictures(self):
        image = stilb.load(self.file).render("view", paths=4)
        image.save(self.folder / "view.exr")
        self.ran("falsecolor", self.folder / "view.exr", "-o", self.folder / "typed.svg", "--log", "--numbers")
        image.falsecolor(self.folder / "own.svg", log=True, numbers=True)
        self.assertEqual((self.folder / "own.svg").read_bytes(), (self.folder / "typed.svg").read_bytes())

    def test_reports_of_scenes(self):
        loaded, made = stilb.load(self.file), built()
        made.name = "a room in code"
        for scene, title in [(loaded, "room"), (made, "a room in code")]:
            scene.report(self.folder / "room.html", paths=PATHS, view_passes=2, sensors=["desk", "view"], readings=True)
            page = (self.folder / "room.html").read_text()
            mean = scene.measure(paths=PATHS, sensors=["desk"])["desk"].mean
            for text in (title, "desk", f"{mean:.1f}"[:4], "data:image/png"):
                self.assertIn(text, page)
            self.assertNotIn("eye</", page)
        with self.assertWarnsRegex(stilb.ResultWarning, "ended before its goal"):
            loaded.report(self.folder / "room.html", error=1e-6, time=3, sensors=["desk"])
        with self.assertRaisesRegex(stilb.InputError, "chair"):
            loaded.report(self.folder / "room.html", sensors=["chair"])
        with self.assertRaisesRegex(TypeError, "unknown argument eror"):
            loaded.report(self.folder / "room.html", eror=1)

    def test_fits_are_those_of_the_command_line(self):
        (self.folder / "body.obj").write_text(octahedron(0.2))
        made = stilb.fit(self.folder / "body.obj", self.folder / "own.json", degree=16, center=(0, 0, 0))
        self.ran("fit", self.folder / "body.obj", "-o", self.folder / "typed.json", "--degree", 16, "--center", "0,0,0")
        self.assertEqual((self.folder / "own.json").read_bytes(), (self.folder / "typed.json").read_bytes())
        self.assertAlmostEqual(made.size, 0.4)
        self.assertEqual(made.rms_error.shape, (17,))
        self.assertLess(made.rms_error[16], made.rms_error[4] / 2)
        self.assertTrue(np.all(made.largest_error >= made.rms_error))
        self.assertRegex(repr(made), "degree 16, rms error [0-9.]+ % of the size")
        scene = built()
        scene.objects["body"] = stilb.Harmonics(file=made.path, material="wall", translate=(3, 2, 1))
        self.assertEqual(scene.check(), [])
        searched = stilb.fit(self.folder / "body.obj", self.folder / "own.json", degree=4)
        np.testing.assert_allclose(searched.center, [0, 0, 0], atol=0.01)
        for options, message in [({"degree": 129}, "degree: 129 is not allowed. Allowed: from 0 to 128"),
                                 ({"degree": 4, "tolerance": 1}, "tolerance: 1 is not allowed")]:
            with self.assertRaisesRegex(stilb.InputError, message):
                stilb.fit(self.folder / "body.obj", self.folder / "own.json", **options)

    def test_meshes_with_holes_are_warned_of(self):
        text = octahedron(0.2).rsplit("f", 1)[0]
        (self.folder / "open.obj").write_text(text)
        with self.assertRaises(stilb.InputError):
            stilb.fit(self.folder / "open.obj", self.folder / "own.json", degree=8)
        with self.assertWarnsRegex(stilb.ResultWarning, "open.obj: in 12.* % of the directions there is no surface"):
            stilb.fit(self.folder / "open.obj", self.folder / "own.json", degree=8, center=(0, 0, 0), force=True)


if __name__ == "__main__":
    unittest.main()
