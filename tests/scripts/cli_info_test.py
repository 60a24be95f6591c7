"""stilb info."""

import json
import math
import os
import subprocess
import unittest

from command_line import CAMERA, PROGRAM, ROOM, ROOT, CommandLineTest, run


class InfoTest(CommandLineTest):
    def info(self, path):
        result = run("info", path, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_scene(self):
        report = self.info(self.scene)
        self.assertEqual(report["name"], "A room")
        self.assertEqual(report["warnings"], [])
        room, cabinet = report["objects"]
        self.assertEqual((room["triangles"], room["closed"], room["extent"]), (12, True, [[0, 0, 0], [4, 3, 2.5]]))
        self.assertAlmostEqual(room["area_m2"], 59)
        self.assertEqual(cabinet["materials"], ["wall"])
        self.assertAlmostEqual(report["total_flux_lm"], 1000)
        self.assertAlmostEqual(report["lights"][0]["intensity_cd"], 1000 / (4 * math.pi))
        self.assertAlmostEqual(report["materials"][0]["reflectance"], 0.2126 * 0.7 + 0.7152 * 0.5 + 0.0722 * 0.3)
        self.assertEqual([s["points"] for s in report["sensors"]], [6, 1])
        self.assertGreater(report["memory"]["peak_bytes"], report["memory"]["meshes_bytes"])

    @unittest.skipIf("STILB_MOST_SECONDS" in os.environ, "sanitizers need memory of their own")
    def test_memory_of_many_readings(self):
        """What info says is what measure takes, in scenes in which replicates have one strand, and several."""
        def peak_bytes(count, method):
            scene = self.write("grid.toml", ROOM[:ROOM.index("[sensors.")] + f"""
[sensors.many]
type = "grid"
corner = [0.1, 0.1, 1]
edge_u = [3.8, 0, 0]
edge_v = [0, 2.8, 0]
count = [{count}, {count}]
""")
            command = [PROGRAM, "measure", scene, "--method", method, "--paths", "8", "--quiet"]
            with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            return 1024 * usage.ru_maxrss, self.info(scene)["memory"]["readings_bytes"]

        for method in ("local", "path"):
            one, _ = peak_bytes(1, method)
            for count in (250, 500):
                all_of_them, stated = peak_bytes(count, method)
                self.assertLess(abs(all_of_them - one - stated), 0.25 * stated, (method, count, all_of_them, one, stated))

    def test_sensors_of_luminance(self):
        scene = self.write("view.toml", ROOM + CAMERA + """
[sensors.glare]
type = "luminance"
position = [0.5, 2.5, 1.2]
targets = [[2, 1.5, 2], [4, 1, 1]]

[sensors.floor]
type = "goniometer"
point = [2, 2, 0]
normal = [0, 0, 1]
plane = 0
step = 5
""")
        report = self.info(scene)
        self.assertEqual(report["warnings"], [])
        _, _, view, glare, floor = report["sensors"]
        self.assertEqual(view, {"name": "view", "type": "camera", "resolution": [640, 480], "projection": "fisheye",
                                "fov_deg": 180, "filter": "box", "position": [0.5, 2.5, 1.6], "target": [4, 1, 1]})
        self.assertEqual((glare["type"], glare["points"]), ("luminance", 2))
        self.assertEqual((floor["type"], floor["points"], floor["extent"]), ("goniometer", 35, [[2, 2, 0]] * 2))
        text = run("info", scene).stdout
        for part in ("640 x 480 pixels, fisheye, 180 degrees across, from (0.5, 2.5, 1.6) to (4, 1, 1)",
                     "2 lines of sight, at (0.5, 2.5, 1.2)", "35 directions, at (2, 2, 0)"):
            self.assertIn(part, text)

    def test_text_shows_all_sections(self):
        result = run("info", self.scene)
        self.assertEqual(result.returncode, 0)
        for part in ("A room", "Materials (1)", "Objects (2)", "Lights (1), 1000 lm in all", "Sensors (2)", "Run:",
                     "Memory to read it:", "No warnings"):
            self.assertIn(part, result.stdout)

    def test_text_shows_every_material(self):
        parameters = {"diffuse": "reflectance = 0.5", "phong": "diffuse = 0.2\nspecular = 0.3\nexponent = 20",
                      "rough": "reflectance = 0.8\nroughness = 0.2", "mirror": "reflectance = 0.9",
                      "ward": "diffuse = 0.2\nspecular = 0.3\nroughness = [0.1, 0.2]",
                      "plastic": "diffuse = 0.3\nior = 1.5\nroughness = 0.1", "glass": "ior = 1.5",
                      "pane": "ior = 1.52\ninternal_transmittance = 0.96", "black": ""}
        scene = self.write("materials.toml", "\n".join(
            f'[materials.my_{name}]\ntype = "{name}"\n{lines}' for name, lines in parameters.items()))
        text = run("info", scene).stdout
        for name in parameters:
            self.assertRegex(text, rf"my_{name} +{name} +reflectance")
        self.assertIn("(transmittance 0.881, ior 1.52)", text)

    def test_warnings(self):
        scene = self.write("odd.toml", ROOM.replace("corner = [1.5, 1, 0.75]", "corner = [0.2, 0, 0.75]") + """
[materials.rug]
type = "black"
[objects.rug]
shape = "rectangle"
corner = [2, 1, 0]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "rug"
[objects.outside]
shape = "sphere"
center = [9, 9, 9]
radius = 1
material = "rug"
""")
        rug, desk, outside = self.info(scene)["warnings"]
        self.assertRegex(rug, '"room" and "rug" overlap')
        self.assertRegex(desk, 'sensor "desk": .* of 6 points lie inside object "cabinet"')
        self.assertRegex(outside, '"outside": no light reaches it')

    def test_measure_render_and_solve_say_what_info_says(self):
        scene = self.write("above.toml", ROOM[:ROOM.index("[sensors.desk]")].replace("[2, 1.5, 2]", "[2, 1.5, 2.3]") + """
[objects.ceiling]
shape = "rectangle"
corner = [0, 0, 2.2]
edge_u = [0, 3, 0]
edge_v = [4, 0, 0]
material = "wall"
[objects.panel]
shape = "rectangle"
corner = [2, 1, 2.2]
edge_u = [0, 0.5, 0]
edge_v = [0.5, 0, 0]
material = "wall"
[lights.panel]
type = "area"
object = "panel"
flux = 1000
""" + ROOM[ROOM.index("[sensors.desk]"):] + CAMERA.replace("[640, 480]", "[16, 12]"))
        expected = self.info(scene)["warnings"]
        self.assertEqual(len(expected), 2)
        self.assertRegex(expected[0], 'lamp "panel" lies in the plane of object "ceiling".*the lamp is taken')
        self.assertRegex(expected[1], 'light "bulb": none of its light reaches a sensor: object "ceiling" is in the way')
        measured = json.loads(run("measure", scene, "--paths", "1", "--json").stdout)["warnings"]
        self.assertEqual(measured[:2], expected)
        for command in (("render", scene, "-o", self.folder / "view.exr", "--paths", "2"),
                        ("solve", scene, "-o", self.folder / "light.solution", "--paths", "8", "--patch", "1")):
            printed = run(*command).stderr
            self.assertEqual(printed.count(expected[0]), 1)
            of_camera = expected[1].replace("reaches a sensor", "reaches what the camera sees")
            self.assertEqual(printed.count(of_camera), 1 if command[0] == "render" else 0)

    def test_luminaire(self):
        for name in ("luminaire.ies", "luminaire.ldt"):
            luminaire = self.info(ROOT / "scenes/office" / name)["luminaires"][0]
            self.assertAlmostEqual(luminaire["flux_lm"], 3800, delta=20)
            self.assertIn("3800 lm", luminaire["flux_check"])
            self.assertEqual(luminaire["power_w"], 31)
            self.assertNotIn("ugr", luminaire)

    def test_ugr_tables(self):
        """Beside the tables that the Python package eulumdat-ugr 1.0.2 gives for the same file."""
        path = ROOT / "scenes/office/luminaire.ldt"
        ugr = json.loads(run("info", path, "--ugr", "--json").stdout)["luminaires"][0]["ugr"]
        self.assertEqual((len(ugr["rooms_h"]), ugr["reflectances"][1]), (19, [0.7, 0.3, 0.2]))
        self.assertAlmostEqual(ugr["flux_lm"], 3800)
        self.assertAlmostEqual(ugr["correction"], 8 * math.log10(3.8))
        usual, wide = ugr["tables"]
        self.assertEqual((usual["spacing_h"], wide["spacing_h"]), (0.25, 1))
        for room, crosswise, endwise in (([2, 2], (18.87, 20.47, 19.23, 20.78, 21.09), (17.63, 19.23, 17.99, 19.54, 19.85)),
                                         ([4, 8], (19.85, 20.64, 20.32, 21.08, 21.55), (18.43, 19.22, 18.90, 19.66, 20.13)),
                                         ([12, 8], (19.73, 20.25, 20.24, 20.74, 21.30), (18.35, 18.86, 18.86, 19.35, 19.92))):
            for table, peer in ((usual["crosswise"], crosswise), (usual["endwise"], endwise)):
                for rating, other in zip(table[ugr["rooms_h"].index(room)], peer, strict=True):
                    self.assertAlmostEqual(rating, other, delta=0.3)
        text = run("info", path, "--ugr").stdout
        self.assertIn("UGR for 3800 lm (uncorrected, for 1000 lm: 4.6 less), luminaires 0.25 H apart\n", text)
        self.assertRegex(text, r"\n +12H +8H( +[0-9]+\.[0-9]){10}\n")
        self.assertRegex(text, r"\n +With luminaires 1 H apart: [+-][0-9.]+ to [+-][0-9.]+ crosswise, [^\n]+ endwise\n")

    def test_ugr_needs_a_luminaire_with_an_opening(self):
        self.expect_wrong_input(["info", self.scene, "--ugr"], "is no luminaire file. Allowed with --ugr: IES LM-63, EULUMDAT.")
        panel = (ROOT / "scenes/office/luminaire.ies").read_text()
        point = self.write("point.ies", panel.replace(" 0.55 0.55 0\n", " 0 0 0\n"))
        self.expect_wrong_input(["info", point, "--ugr"], "point.ies: states no luminous opening")

    def test_mesh(self):
        mesh = self.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng side\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 1 2\n")
        part = self.info(mesh)["objects"][0]
        self.assertEqual((part["triangles"], part["vertices"], part["open_edges"]), (3, 4, 3))
        self.assertEqual((part["degenerate_triangles_left_out"], part["groups"]), (1, ["side"]))
        self.assertAlmostEqual(part["area_m2"], 1 + math.sqrt(3) / 2)

    def test_garbage_is_wrong_input(self):
        for name in ("x.ies", "x.ldt", "x.obj", "x.ply", "x.toml"):
            self.expect_wrong_input(["info", self.write(name, "\x00\x01 nothing")], name)


if __name__ == "__main__":
    unittest.main()
