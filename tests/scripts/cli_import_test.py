"""Scenes in glTF and OBJ on the command line, and stilb import. The files in tests/data are Blender's exports."""

import json
import shutil
import struct
import subprocess
import unittest
import zlib

from command_line import MOST_SECONDS, PROGRAM, ROOT, CommandLineTest, run

DATA = ROOT / "tests/data"
DESK = 'sensors.desk={type="illuminance", positions=[[1, 1, 0.75], [2, 1.5, 0.75]], normal=[0, 0, 1]}'


class ImportTest(CommandLineTest):
    def info(self, path, *arguments):
        result = run("info", path, "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def values(self, scene, *arguments):
        result = run("measure", scene, "--json", "--paths", 4096, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [value["value"] for sensor in json.loads(result.stdout)["sensors"] for value in sensor["values"]]

    def test_a_room_of_blender(self):
        info = self.info(DATA / "blender_room.glb")
        lights = {light["name"]: light for light in info["lights"]}
        # 10 W of a point in Blender: 10 * 683 lm.
        self.assertAlmostEqual(lights["bulb"]["flux_lm"], 6830, delta=1)
        # 2000 cd/m2 times a colour of the luminance 0.914, on both sides of 0.36 m2.
        for name in ("panel", "panel (back)"):
            self.assertAlmostEqual(lights[name]["flux_lm"], 3.14159265 * 0.36 * 2000 * 0.91404, delta=0.5)
        self.assertEqual([material["type"] for material in info["materials"]],
                         ["plastic", "plastic", "rough", "plastic", "pane"])
        areas = {item["name"]: item["area_m2"] for item in info["objects"]}
        self.assertAlmostEqual(areas["room"], 59, delta=1e-4)
        self.assertEqual(info["warnings"], [])

    def test_a_folder_measures_as_the_file(self):
        for name in ("blender_room.glb", "blender_room.obj"):
            with self.subTest(name=name):
                output = self.folder / name
                result = run("import", DATA / name, "-o", output, "--set", DESK)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("scene.toml: ", result.stdout)
                of_folder = self.values(output / "scene.toml")
                for a, b in zip(self.values(DATA / name, "--set", DESK), of_folder, strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-6 * a)

    def test_options_of_the_run_are_kept(self):
        output = self.folder / "room"
        result = run("import", DATA / "blender_room.glb", "-o", output, "--set", "run.seed=5", "--set", "run.error=0.1",
                     "--set", "run.target=mean", "--set", "run.time=20", "--set", "run.bounces=3", "--set", "run.patch=2")
        self.assertEqual(result.returncode, 0, result.stderr)
        options = self.info(output / "scene.toml")["run"]
        expected = self.info(DATA / "blender_room.glb", "--set", "run.seed=5", "--set", "run.error=0.1", "--set",
                             "run.target=mean", "--set", "run.time=20", "--set", "run.bounces=3", "--set", "run.patch=2")["run"]
        self.assertEqual(options, expected)
        self.assertEqual((options["seed"], options["bounces"], options["patch_m"]), (5, 3, 2))

    def test_a_radiance_scene_measures_as_its_folder(self):
        room, output = DATA / "radiance/room.rad", self.folder / "room"
        self.assertEqual(run("import", room, "-o", output, "--set", DESK).returncode, 0)
        for a, b in zip(self.values(room, "--set", DESK), self.values(output / "scene.toml"), strict=True):
            self.assertAlmostEqual(a, b, delta=0.04 * a)  # four standard errors of 4096 paths

    def test_ifc_needs_the_python_package(self):
        building = self.write("house.ifc", "ISO-10303-21;\nHEADER;\n")
        self.expect_wrong_input(["import", building, "-o", self.folder / "house", "--scale", "0.001"], "house.ifc",
                                "do not go with IFC")
        self.expect_wrong_input(["measure", building], "house.ifc: not a scene but a building in IFC", "stilb import")
        result = subprocess.run([PROGRAM, "import", building, "-o", self.folder / "house"], capture_output=True, text=True,
                                env={"PATH": str(self.folder)}, timeout=MOST_SECONDS)
        self.assertEqual(result.returncode, 2)
        self.assertIn('pip install "stilb[ifc]"', result.stderr)

    def test_obj_says_what_it_chose(self):
        result = run("import", DATA / "blender_room.obj", "-o", self.folder / "out")
        self.assertIn("It is taken as 4 x 3 m large and 2.5 m high", result.stderr)
        self.assertIn('up = "y", because', result.stderr)
        self.assertIn("scale = 1 (metres), because the model is then as high as one storey", result.stderr)
        result = run("import", DATA / "blender_room.obj", "-o", self.folder / "out", "--scale", "0.5", "--up", "y",
                     "--light-scale", "2")
        self.assertNotIn("scale =", result.stdout + result.stderr)
        info = self.info(self.folder / "out/scene.toml")
        self.assertAlmostEqual(info["objects"][0]["area_m2"], 59 / 4, delta=1e-4)
        self.assertAlmostEqual(info["lights"][0]["luminance_cd_m2"], 2 * 2000 * 0.91404, delta=0.1)

    def test_textures_are_shown_if_wanted(self):
        # Two grey halves, as PNG writes them: a filter byte before each row of one byte a pixel.
        def chunk(kind, content):
            return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
        header = struct.pack(">IIBBBBB", 4, 4, 8, 0, 0, 0, 0)
        (self.folder / "halves.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
            chunk(b"IDAT", zlib.compress(4 * b"\0\xff\xff\x80\x80")) + chunk(b"IEND", b""))
        self.write("room.mtl", "newmtl paper\nKd 0.5 0.5 0.5\nmap_Kd halves.png\n")
        room = self.write("room.obj", "mtllib room.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                          "vt 0 1\nusemtl paper\nf 1/1 2/2 3/3 4/4\n")
        grey = 0.5 * ((128 / 255 + 0.055) / 1.055)**2.4
        mean = self.info(room, "--set", "import.scale=1", "--set", "import.up=z")
        self.assertAlmostEqual(mean["materials"][0]["reflectance"], (0.5 + grey) / 2, delta=5e-4)
        self.assertIn("material paper: the texture counts by its mean over the surface; import.textures=true shows it.",
                      mean["notes"])
        result = run("import", room, "-o", self.folder / "out", "--scale", "1", "--up", "z", "--textures")
        self.assertIn("material paper: its texture is 6 faces of 2 colours.", result.stdout, result.stderr)
        materials = {item["name"]: item["reflectance"] for item in self.info(self.folder / "out/scene.toml")["materials"]}
        self.assertEqual(sorted(materials), ["paper (texture 1)", "paper (texture 2)"])
        self.assertAlmostEqual(materials["paper (texture 1)"], grey, delta=1e-6)
        self.assertAlmostEqual(materials["paper (texture 2)"], 0.5, delta=1e-6)
        result = run("info", self.folder / "out/scene.toml")
        self.assertRegex(result.stdout, r"Materials \(1\)\n  paper \(texture\)  diffuse   reflectance 0.108 to 0.5, 2 colours")
        radiance = DATA / "radiance/room.rad"
        self.expect_wrong_input(["info", radiance, "--set", "import.textures=true"], "import.textures does not go with them")
        self.expect_wrong_input(["info", room, "--set", "import.textures=1"], "import.textures")

    def test_names_in_latin_1_do_not_lose_the_results(self):
        (self.folder / "room.mtl").write_bytes(b"newmtl W\xe4nde\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n")
        room = self.folder / "room.obj"
        room.write_bytes(b"mtllib room.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 3\nv 4 0 3\nv 4 4 3\nv 0 4 3\n"
                         b"g Fu\xdfboden\nusemtl W\xe4nde\nf 1 2 3 4\ng K\xfcche\nusemtl lamp\nf 5 8 7 6\n")
        options = ["--set", "import.scale=1", "--set", "import.up=z", "--set", DESK]
        self.assertGreater(self.values(room, *options)[0], 10)
        info = self.info(room, *options)
        self.assertEqual([item["name"] for item in info["objects"]], ["Fu\u00dfboden", "K\u00fcche"])
        self.assertEqual(info["materials"][0]["name"], "W\u00e4nde")

    def test_sensors_are_added_one_by_one(self):
        info = self.info(DATA / "blender_room.obj", "--set", DESK, "--set", DESK.replace("desk", "shelf"), "--set",
                         'sensors.wall.type="luminance"', "--set", "sensors.wall.position=[1, 1, 1]", "--set",
                         "sensors.wall.direction=[0, 1, 0]")
        self.assertEqual([sensor["name"] for sensor in info["sensors"]], ["desk", "shelf", "wall"])

    def test_an_obj_without_materials_is_shown_as_a_mesh(self):
        plain = self.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.assertIn("groups", self.info(plain)["objects"][0])
        self.assertIn("materials", self.info(plain, "--set", "import.scale=1"))

    def test_wrong_input_is_named(self):
        cut_off = self.folder / "cut_off.glb"
        cut_off.write_bytes((DATA / "blender_room.glb").read_bytes()[:5000])
        self.expect_wrong_input(["measure", cut_off], "cut_off.glb: no glTF 2.0 that can be read")
        self.expect_wrong_input(["import", self.scene, "-o", self.folder / "out"], "no scene of another format")
        room = DATA / "blender_room.glb"
        self.expect_wrong_input(["info", room, "--set", "materials.wall.reflectance=0.5"], "stilb import")
        self.expect_wrong_input(["info", room, "--set", "import.scale=-1"], "import.scale: -1 is not allowed")
        self.expect_wrong_input(["info", room, "--set", "import.sclae=1"], 'Did you mean "scale"')
        shutil.copy(self.scene, self.folder / "scene.toml")
        self.expect_wrong_input(["import", room, "-o", self.folder], "was not written by stilb import")

    def test_solutions_notice_another_file(self):
        copy, solution = self.folder / "room.glb", self.folder / "room.solution"
        shutil.copy(DATA / "blender_room.glb", copy)
        self.assertEqual(run("solve", copy, "-o", solution, "--patch", 1, "--paths", 8).returncode, 0)
        page = ["view", solution, "-o", self.folder / "x.html"]
        result = run(*page)
        self.assertEqual(result.returncode, 0, result.stderr)
        copy.write_bytes(copy.read_bytes().replace(b"bulb", b"lamp"))
        self.expect_wrong_input(page, "Solve it again")


if __name__ == "__main__":
    unittest.main()
