"""stilb export. Needs neither Mitsuba nor Radiance: their files are checked as text."""

import unittest
from xml.etree import ElementTree

from command_line import CAMERA, ROOM, ROOT, CommandLineTest, run

GLASS = """
[materials.glass]
type = "glass"
ior = 1.5

[objects.ball]
shape = "sphere"
center = [2, 2, 1]
radius = 0.1
material = "glass"
"""


class ExportTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "exported"

    def export(self, scene, form, *arguments):
        result = run("export", scene, "--format", form, "-o", self.output, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_mitsuba_reads_well_formed_files(self):
        result = self.export(self.scene, "mitsuba")
        self.assertEqual(result.stderr, "")
        scene = ElementTree.parse(self.output / "scene.xml").getroot()
        shapes = {shape.get("id"): shape for shape in scene.iter("shape")}
        self.assertEqual(set(shapes), {"room", "cabinet"})
        materials = {material.get("id") for material in scene.iter("bsdf")}
        for shape in shapes.values():
            self.assertTrue((self.output / shape.find("string[@name='filename']").get("value")).exists())
            self.assertIn(shape.find("ref").get("id"), materials)
        self.assertIn(f"{len(list(self.output.iterdir()))} files for mitsuba", result.stdout)

    def test_the_python_files_compile(self):
        self.export(self.scene, "mitsuba")
        for name in ("measure.py", "stilb_plugins.py"):
            text = (self.output / name).read_text()
            compile(text, name, "exec")
            self.assertEqual(text, (ROOT / "src/io/export/mitsuba" / name).read_text())

    def test_radiance_gets_primitives_with_counted_arguments(self):
        self.scene.write_text(ROOM + CAMERA)
        self.export(self.scene, "radiance")
        lines = [line for line in (self.output / "scene.rad").read_text().splitlines() if line[:1] != "#"]
        blocks = [block.splitlines() for block in "\n".join(lines).strip().split("\n\n")]
        self.assertGreater(len(blocks), 20)
        for header, *counted in blocks:
            self.assertEqual(len(header.split()), 3, header)
            self.assertEqual(len(counted), 3)
            for line in counted:
                count, *arguments = line.split()
                self.assertEqual(len(arguments), int(count), line)
        self.assertTrue((self.output / "view.vf").read_text().startswith("rvu -vta -vp"))
        self.assertEqual(len((self.output / "desk.pts").read_text().splitlines()), 6)

    def test_luminaires_have_tables(self):
        office = ROOT / "scenes/office/office.toml"
        result = self.export(office, "radiance")
        self.assertIn("Radiance has no Phong model", result.stderr)
        words = (self.output / "solid0.dat").read_text().split()
        self.assertEqual(words[:7], ["2", "0", "360", "145", "0", "180", "181"])
        self.assertEqual(len(words), 7 + 145 * 181)
        self.assertTrue((self.output / "luminaire.cal").exists())

    def test_warnings_name_what_does_not_map(self):
        self.scene.write_text(ROOM + CAMERA + GLASS)
        self.assertIn("sensor view: Mitsuba has no fisheye camera", self.export(self.scene, "mitsuba").stderr)
        self.assertIn("material glass: in Radiance", self.export(self.scene, "radiance").stderr)
        self.assertEqual(self.export(self.scene, "radiance", "--quiet").stderr, "")

    def test_values_of_keys_are_replaced(self):
        self.export(self.scene, "mitsuba", "--set", "materials.wall.reflectance=0.25")
        self.assertIn("0.25 0.25 0.25", (self.output / "scene.xml").read_text())

    def test_wrong_input(self):
        self.expect_wrong_input(["export", self.scene, "--format", "mitsubba", "-o", self.output],
                                "no format mitsubba", 'Did you mean "mitsuba"?', "radiance")
        self.expect_wrong_input(["export", self.scene, "--format", "mitsuba", "-o", self.folder],
                                "holds a file of the scene", "another folder")
        self.expect_wrong_input(["export", self.scene, "--format", "mitsuba", "-o", self.scene], "folder")
        self.assertTrue(self.scene.read_text().startswith(ROOM))


if __name__ == "__main__":
    unittest.main()
