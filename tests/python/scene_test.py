"""Scenes in Python: read, built, changed, saved, and what is wrong with them."""

import json
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np
import stilb
from room import TOML, built, program
from stilb import _meanings, _stilb
from stilb._names import class_name
from stilb.toml import document_text

PATHS = 2048


class SceneFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "room.toml"
        self.file.write_text(TOML)

    def message(self, text):
        self.file.write_text(text)
        with self.assertRaises(stilb.InputError) as caught:
            stilb.load(self.file)
        return str(caught.exception)

    def test_built_scenes_measure_what_files_do(self):
        read, made = stilb.load(self.file).measure(paths=PATHS), built().measure(paths=PATHS)
        self.assertEqual(list(read), ["desk", "eye"])
        for name in read:
            np.testing.assert_array_equal(read[name].value, made[name].value)
            np.testing.assert_array_equal(read[name].rgb, made[name].rgb)

    def test_messages_are_those_of_the_command_line(self):
        for wrong in [TOML.replace("reflectance", "reflectence"), TOML.replace("800", "-1"), TOML.replace("0.7, 0.5", "7, 0.5"),
                      TOML.replace('type = "grid"', 'type = "gird"'), "[materials", ""]:
            with self.subTest(wrong[:40]):
                message = self.message(wrong)
                printed = program("measure", self.file, "--paths", "1")
                self.assertEqual(printed.returncode, 2)
                self.assertEqual(printed.stderr.strip(), "stilb: " + message)

    def test_messages_of_built_scenes_name_the_part(self):
        scene = built()
        scene.materials["wall"] = stilb.Diffuse(reflectence=0.6)
        with self.assertRaisesRegex(ValueError, '^materials.wall: unknown key "reflectence" for type "diffuse". Did you mean '
                                                '"reflectance"[?] Allowed: type, reflectance, back[.]$'):
            scene.measure()

    def test_parts_of_loaded_scenes_can_be_changed(self):
        scene = stilb.load(self.file)
        scene.run["method"] = "path"

        def desk():
            return scene.measure(paths=32)["desk"].value

        before = desk()
        scene.lights["bulb"].flux = 400
        np.testing.assert_allclose(desk(), before / 2, rtol=1e-12)
        scene.lights["bulb"].flux = 800
        np.testing.assert_array_equal(desk(), before)
        scene.defaults["lights"] = {"maintenance": 0.5}
        np.testing.assert_allclose(desk(), before / 2, rtol=1e-12)
        del scene.sensors["eye"]
        self.assertEqual(list(scene.measure(paths=32)), ["desk"])

    def test_saved_scenes_are_scene_files(self):
        scene = built()
        scene.save(self.folder / "saved.toml")
        saved = stilb.load(self.folder / "saved.toml")
        np.testing.assert_array_equal(saved.measure(paths=PATHS)["desk"].value, built().measure(paths=PATHS)["desk"].value)
        self.assertEqual(saved.run, {"seed": 7})

    def test_saved_scenes_are_compact_and_complete(self):
        scene = built()
        scene.name = 'a "room"\n'
        scene.objects["lamp 2.0"] = stilb.Sphere(center=(3, 2, 2), radius=0.1, material="wall")
        scene.defaults["lights"] = {"maintenance": 0.8}
        scene.lights["bulbs"] = stilb.PointLight(array={"origin": [1, 1, 2], "step_u": [1, 0, 0], "step_v": [0, 1, 0],
                                                        "count": [2, 1]}, flux=np.float64(1e20 / 1e18))
        scene.save(self.folder / "saved.toml")
        text = (self.folder / "saved.toml").read_text()
        self.assertIn("\nmin = [0, 0, 0]\n", text)
        self.assertIn('[objects."lamp 2.0"]', text)
        saved = stilb.load(self.folder / "saved.toml")
        self.assertEqual(saved.name, scene.name)
        self.assertEqual(saved.objects["lamp 2.0"].to_dict(), {"shape": "sphere", "center": [3, 2, 2], "radius": 0.1, "material": "wall"}
                         | {"center": (3, 2, 2)})
        np.testing.assert_array_equal(saved.measure(paths=PATHS)["desk"].value, scene.measure(paths=PATHS)["desk"].value)

    def test_every_sequence_is_saved_as_an_array(self):
        scene = built()
        scene.objects["lamp"] = stilb.Sphere(center=range(1, 4), radius=np.float32(0.5), material="wall")
        scene.objects["ball"] = stilb.Sphere(center=(x / 2 for x in (1, 2, 3)), radius=0.25, material="wall")
        scene.sensors["spots"] = stilb.Illuminance(points=[np.array([1, 1, 1]), (1, 2, 1)], normal=(0, 0, 1))
        scene.light_scenes["late"] = {"bulb": np.array([1, 0.5, 0])}
        scene.measure(paths=64)  # which reads each value, too
        scene.save(self.folder / "saved.toml")
        text = (self.folder / "saved.toml").read_text()
        for line in ("center = [1, 2, 3]", "radius = 0.5", "center = [0.5, 1.0, 1.5]", "radius = 0.25",
                     "points = [[1, 1, 1], [1, 2, 1]]", "bulb = [1.0, 0.5, 0.0]"):
            self.assertIn(f"\n{line}\n", text)
        for value, kind in ((None, "NoneType"), (b"1", "bytes"), (1j, "complex"), ({1}, "set"), ([object()], "object")):
            with self.subTest(kind), self.assertRaisesRegex(stilb.InputError, f"^lights.bulb.flux.*: .* of type {kind}"):
                stilb.load(self.file, set={"lights.bulb.flux": value})

    def test_scenes_with_mistakes_write_over_no_file(self):
        good = self.file.read_text()
        self.file.chmod(0o640)
        for change, message in [(lambda scene: scene.materials.clear(), 'objects.room.material: unknown material "wall"'),
                                (lambda scene: scene.set("lights.bulb.flux", object()), "lights.bulb.flux: .* of type object"),
                                (lambda scene: scene.light_scenes.update(late={"bulp": 1}), "bulp")]:
            scene = stilb.load(self.file)
            change(scene)
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                scene.save(self.file)
        link = self.folder / "link.toml"
        link.symlink_to(self.file)
        with self.assertRaisesRegex(stilb.InputError, "meshes/floor.obj"):
            floor = stilb.load(self.file)
            floor.objects["floor"] = stilb.Mesh(file="meshes/floor.obj", material="wall")
            floor.save(link)
        self.assertEqual(self.file.read_text(), good)
        self.assertEqual({file.name for file in self.folder.iterdir()}, {"room.toml", "link.toml"})
        scene.light_scenes.clear()
        scene.save(link)
        self.assertNotEqual(self.file.read_text(), good)
        self.assertEqual((link.is_symlink(), self.file.stat().st_mode & 0o777), (True, 0o640))
        with self.assertRaisesRegex(stilb.InputError, "this is no file that could be written"):
            scene.save(self.folder)
        with self.assertRaisesRegex(FileNotFoundError, "'.*/none/room.toml'$"):
            scene.save(self.folder / "none/room.toml")

    def test_loaded_scenes_outlive_their_files(self):
        before = stilb.load(self.file).measure(paths=PATHS)["desk"]
        for lose in (self.file.unlink, lambda: self.file.write_text(TOML.replace("800", "8"))):
            self.file.write_text(TOML)
            scene = stilb.load(self.file)
            run = scene.start(paths=PATHS)
            self.assertLess(next(iter(run)).paths, 2 * PATHS)
            lose()
            result = scene.measure(paths=PATHS)
            np.testing.assert_array_equal(result["desk"].value, before.value)
            self.assertIsNone(json.loads(result.to_json())["scene_hash"])  # that of another file would be wrong
            np.testing.assert_array_equal(run.finish()["desk"].value, before.value)
            run.save(self.folder / "kept.run")
            np.testing.assert_array_equal(stilb.resume(self.folder / "kept.run").result["desk"].value, before.value)
            (self.folder / "kept.run").unlink()
            (self.folder / "kept.toml").unlink()
        self.file.write_text(TOML)
        scene = stilb.load(self.file)
        self.file.write_text(TOML)  # the same again
        self.assertIsNotNone(json.loads(scene.measure(paths=64).to_json())["scene_hash"])

    def test_scenes_of_other_formats_say_that_they_need_their_file(self):
        file = self.folder / "floor.rad"
        file.write_text("void plastic grey 0 0 5 0.5 0.5 0.5 0 0\ngrey polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n")
        scene = stilb.load(file)
        scene.lights["bulb"] = stilb.PointLight(position=(0, 0, 3), intensity=100)
        scene.illuminance((0, 0, 1), (0, 0, 1), paths=64)
        kept = pickle.dumps(scene)
        file.write_text(file.read_text().replace("0.5", "0.2"))
        for wrong in (lambda: scene.illuminance((0, 0, 1), (0, 0, 1), paths=64), lambda: pickle.loads(kept)):
            with self.assertRaisesRegex(stilb.InputError, "floor.rad: this file is not there any more, or has changed"):
                wrong()

    def test_scene_files_may_have_a_byte_order_mark(self):
        self.file.write_text("\ufeff" + TOML)
        self.assertEqual(list(stilb.load(self.file).lights), ["bulb"])

    def test_scenes_are_read_from_texts(self):
        scene = stilb.Scene.parse(TOML)
        np.testing.assert_array_equal(scene.measure(paths=PATHS)["desk"].value, built().measure(paths=PATHS)["desk"].value)
        self.assertEqual((scene.name, scene.lights["bulb"].flux), ("room", 800))
        with self.assertRaisesRegex(stilb.InputError, 'materials.wall: unknown key "reflectence"'):
            stilb.Scene.parse(TOML.replace("reflectance", "reflectence"))
        (self.folder / "floor.obj").write_text("v 0 0 0.1\nv 4 0 0.1\nv 4 3 0.1\nf 1 2 3\n")
        text = TOML + '[objects.floor]\nshape = "mesh"\nfile = "floor.obj"\nmaterial = "wall"\n'
        self.assertEqual(len(stilb.Scene.parse(text, self.folder).objects), 3)
        with self.assertRaisesRegex(stilb.InputError, "floor.obj"):
            stilb.Scene.parse(text)

    def test_scenes_are_made_of_dictionaries(self):
        scene = built()
        scene.defaults["lights"] = {"maintenance": 0.8}
        again = stilb.Scene.from_dict(scene.to_dict())
        self.assertEqual((again.name, again.run, again.defaults), (scene.name, scene.run, scene.defaults))
        for section in ("materials", "objects", "lights", "sensors"):
            self.assertEqual(dict(getattr(again, section)), dict(getattr(scene, section)))
        self.assertIsInstance(again.objects["table"], stilb.Mesh)
        again.run["seed"] = 1
        again.defaults["lights"]["maintenance"] = 0.1
        self.assertEqual((scene.run["seed"], scene.defaults["lights"]["maintenance"]), (7, 0.8))
        with self.assertRaisesRegex(stilb.InputError, 'unknown section "light". Did you mean "lights"'):
            stilb.Scene.from_dict({"light": {}})
        for document, message in [({"run": 3}, "run: found a value of type int. Allowed: a dictionary"), ([1], "document: found"),
                                  ({"scene": {"title": "a"}}, 'scene: unknown key "title". Allowed: name')]:
            with self.assertRaisesRegex(stilb.InputError, message):
                stilb.Scene.from_dict(document)

    def test_keys_are_set_by_their_names(self):
        scene = built()
        scene.set("materials.wall.reflectance", 0.2)
        scene.set("lights.bulb", {"type": "point", "position": [2, 1.5, 2.2], "flux": 100})
        scene.set("lights.bulb.flux", 200)
        scene.set("sensors.desk.require.uniformity", 0.3)
        scene.set("sensors.desk.require.mean", 2)
        scene.set("run.seed", 3)
        scene.set("defaults.lights.maintenance", 0.8)
        scene.set("scene.name", "other")
        scene.set('objects."a.b"', stilb.Sphere(center=(1, 1, 1), radius=0.1, material="wall"))
        self.assertEqual((scene.materials["wall"].reflectance, scene.lights["bulb"].flux, scene.run, scene.name),
                         (0.2, 200, {"seed": 3}, "other"))
        self.assertEqual(scene.sensors["desk"].require, {"mean": 2, "uniformity": 0.3})
        self.assertEqual(scene.defaults, {"lights": {"maintenance": 0.8}})
        self.assertEqual(scene.objects["a.b"].radius, 0.1)
        self.assertEqual(scene.measure(paths=PATHS)["desk"].requirements.keys(), {"mean", "uniformity"})
        for key, message in [("light.bulb.flux", 'unknown section "light". Did you mean "lights"'),
                             ("lights.blub.flux", 'lights.blub.flux: there is no "blub" in lights. Did you mean "bulb"[?] Allowed: bulb'),
                             ("lights.bulb.fluxx", 'lights.bulb.fluxx: .*no key "fluxx". Did you mean "flux"'),
                             ("lights.bulb.position.0", "lights.bulb.position has no keys of its own, as its value is .2, 1.5, 2.2.. "
                                                        "Set all of it: lights.bulb.position"),
                             ("sensors.desk.require.mean.least", "sensors.desk.require.mean has no keys of its own"),
                             ("run.seed.first", "run.seed.first: run.seed has no keys of its own, as its value is 3"),
                             ("lights", "lights: there is no such key"), ("a b", "a b: this is no key")]:
            with self.subTest(key), self.assertRaisesRegex(stilb.InputError, message):
                scene.set(key, 1)

    def test_scenes_are_loaded_with_other_values(self):
        values = {"lights.bulb.flux": 400, "materials.wall.reflectance": (0.7, 0.5, 0.2), "scene.name": "dim",
                  "sensors.spot": {"type": "illuminance", "position": np.array([1, 1, 1]), "normal": [0, 0, 1]}}
        scene = stilb.load(self.file, set=values)
        self.assertEqual((scene.lights["bulb"].flux, scene.name, "spot" in scene.sensors), (400, "dim", True))
        desk = scene.measure(paths=PATHS)["desk"].value
        typed = [f"--set={key}={value}" for key, value in
                 [("lights.bulb.flux", 400), ("materials.wall.reflectance", "[0.7, 0.5, 0.2]"),
                  ("sensors.spot", "{type = 'illuminance', position = [1, 1, 1], normal = [0, 0, 1]}")]]
        printed = json.loads(program("measure", self.file, "--json", "--paths", PATHS, *typed).stdout)
        np.testing.assert_array_equal(desk.ravel(), [value["value"] for value in printed["sensors"][0]["values"]])
        scene.lights["bulb"].flux = 800  # a scene that is built anew keeps the other values
        self.assertIn("spot", scene.measure(paths=PATHS))
        for key, message in [("lights.bulb.fluxx", 'unknown key "fluxx" for type "point". Did you mean "flux"'),
                             ("lights.blub.flux", "blub")]:
            with self.subTest(key), self.assertRaisesRegex(stilb.InputError, message):
                stilb.load(self.file, set={key: 1})

    def test_names_of_files_follow_a_saved_scene(self):
        (self.folder / "meshes").mkdir()
        (self.folder / "meshes/floor.obj").write_text("v 0 0 0\nv 4 0 0\nv 4 3 0\nf 1 2 3\n")
        scene = stilb.load(self.file)
        scene.objects["floor"] = stilb.Mesh(file="meshes/floor.obj", material="wall", translate=(0, 0, 0.01))
        (self.folder / "other").mkdir()
        scene.save(self.folder / "other/room.toml")
        self.assertEqual(stilb.load(self.folder / "other/room.toml").objects["floor"].file, "../meshes/floor.obj")

    def test_parts_are_added_to_files_of_other_formats(self):
        file = self.folder / "floor.rad"
        file.write_text("void plastic grey 0 0 5 0.5 0.5 0.5 0 0\n"
                        "grey polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n")
        scene = stilb.load(file)
        scene.lights["bulb"] = stilb.PointLight(position=(0, 0, 3), intensity=100)
        scene.sensors["spot"] = stilb.Illuminance(position=(0, 0, 1), normal=(0, 0, 1))
        scene.sensors["floor"] = stilb.Luminance(position=(0, 0, 1), direction=(0, 0, -1))
        result = scene.measure(paths=PATHS)
        np.testing.assert_allclose(result["spot"].value, 100 / 2**2, rtol=1e-6)  # nothing reflects from above
        np.testing.assert_allclose(result["floor"].value, 100 / 3**2 * 0.5 / np.pi, rtol=1e-6)
        self.assertFalse(any("dark" in warning for warning in result.warnings))
        self.assertEqual(len(result.warning_kinds), len(result.warnings))
        self.assertNotIn("no-light", result.warning_kinds)
        with self.assertRaisesRegex(stilb.InputError, "stilb import"):
            scene.save(self.folder / "floor.toml")

    def test_scenes_of_other_programs_are_read_with_settings(self):
        file = self.folder / "floor.rad"
        file.write_text("void glow lamp 0 0 4 1 1 1 0\nlamp ring light 0 0 8 0 0 1 0 0 -1 0 0.1\n"
                        "void plastic grey 0 0 5 0.5 0.5 0.5 0 0\n"
                        "grey polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n")

        def illuminance(**settings):
            return stilb.load(file, **settings).illuminance([0, 0, 0], [0, 0, 1], paths=PATHS).value

        plain = illuminance()
        np.testing.assert_allclose(illuminance(light_scale=2), 2 * plain, rtol=1e-9)
        np.testing.assert_allclose(illuminance(scale=0.01), plain, rtol=1e-6)  # of solid angles alone
        np.testing.assert_allclose(illuminance(set={"import.light_scale": 2}), 2 * plain, rtol=1e-9)
        with self.assertRaisesRegex(stilb.InputError, "light_scale"):
            illuminance(light_scale=-1)
        with self.assertRaisesRegex(stilb.InputError, "import"):
            stilb.load(self.file, scale=0.01)  # a scene file states its positions in metres
        with self.assertRaisesRegex(TypeError, "unknown argument sacle; allowed: set, progress, scale, up"):
            stilb.load(file, sacle=2)

    def test_reading_reports_its_progress(self):
        corners = np.arange(3_000_000).reshape(-1, 3) % 1009
        file = self.folder / "large.obj"
        vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
        faces = "".join(f"f {i} {i + 1} {i + 2}\n" for i in range(1, 999_990, 3))
        file.write_text(8 * vertices + faces)  # takes longer to read than the time between two reports
        reports = []
        stilb.load(file, scale=1, up="z", progress=reports.append)
        self.assertTrue(any("large.obj" in report.stage for report in reports))
        with self.assertRaises(stilb.Cancelled):
            stilb.load(file, scale=1, up="z", progress=lambda report: False)

    def test_odd_scenes_are_reported(self):
        scene = built()
        self.assertEqual(scene.check(), [])
        scene.lights["bulb"].position = (2, 1.5, 9)
        self.assertIn("contains no light", scene.check()[0])


class Parts(unittest.TestCase):
    def test_every_type_of_the_reader_has_a_class(self):
        for name in ["Diffuse", "Plastic", "Box", "Harmonics", "PointLight", "AreaLight", "PhotometryLight", "EnvironmentLight",
                     "Grid", "Area", "Ugr", "Derived", "Camera"]:
            self.assertTrue(issubclass(getattr(stilb, name), stilb.Part), name)

    def test_docstrings_name_all_keys_with_their_meaning(self):
        self.assertRegex(stilb.PointLight.__doc__, r"^A point that shines(.|\n)*\n    flux +luminous flux of each light \[lm\]\n")
        self.assertIn("projection  \"perspective\", \"fisheye\" or \"panorama\" (default: \"perspective\")", stilb.Camera.__doc__)
        known = {(kind.section, kind.type): {*kind.keys} for kind in _stilb.part_types()}
        known["objects", "mesh"] |= {"vertices", "faces"}
        for (section, kind), keys in known.items():
            doc = getattr(stilb, class_name(section, kind)).__doc__
            for key in keys - {"type", "shape"}:
                self.assertRegex(doc, rf"(?m)^    {key} +[^ ]")
        for place, keys in _meanings.KEYS.items():  # none is of a key that the reader does not know
            section, _, kind = place.partition(".")
            of_section = set().union(*(own for (of, _), own in known.items() if of == section))
            self.assertLessEqual(set(keys), known[section, kind] if kind else of_section, place)

    def test_dictionaries_are_parts(self):
        scene = built()
        scene.lights["bulb"] = {"type": "point", "position": [2, 1.5, 2.3], "flux": 800}
        self.assertEqual(scene.lights["bulb"], stilb.PointLight(position=(2, 1.5, 2.3), flux=800))

    def test_wrong_attributes_are_refused_at_once(self):
        scene = built()
        for part, key, meant in [(scene.lights["bulb"], "fluxx", "flux"), (scene.objects["table"], "vertice", "vertices"),
                                 (scene.sensors["desk"], "requires", "require"), (scene.materials["wall"], "reflectence", "reflectance")]:
            with self.subTest(key), self.assertRaisesRegex(stilb.InputError, f'no key "{key}". Did you mean "{meant}"'):
                setattr(part, key, 3)
            self.assertNotIn(key, part.to_dict())
        with self.assertRaisesRegex(stilb.InputError, 'PointLight has no key "type"'):
            scene.lights["bulb"].type = "sphere"
        scene.lights["bulb"].cct = 3000

    def test_scenes_have_no_other_attributes(self):
        scene = built()
        for holder, name, value, message in [
                (scene, "scenes", {}, 'Scene has no attribute "scenes". Did you mean "light_scenes"[?] Allowed: name, run, '),
                (scene, "sensor", {}, 'Did you mean "sensors"'), (scene, "sensors", {}, r"scene.sensors\[...\] = ..., "),
                (scene, "run", 3, "run: found a value of type int"), (scene, "name", 3, "name: found a value of type int"),
                (scene.lights, "bulb", 3, r'lights have no attribute bulb: .* scene.lights\["bulb"\]')]:
            with self.subTest(name), self.assertRaisesRegex(stilb.InputError, message):
                setattr(holder, name, value)
        scene.run = {"seed": 3}
        scene.name = "other"
        self.assertEqual(scene.measure(paths=64).seed, 3)
        with self.assertRaisesRegex(stilb.InputError, "lights: the name of a part: found a value of type int. Allowed: a text"):
            scene.lights[3] = stilb.PointLight(position=(2, 1.5, 2.3), flux=800)

    def test_wrong_parts_are_refused(self):
        scene = built()
        with self.assertRaisesRegex(stilb.InputError, "lights.bulb: Diffuse belongs to materials, not to lights"):
            scene.lights["bulb"] = stilb.Diffuse(reflectance=0.5)
        with self.assertRaisesRegex(stilb.InputError, "materials.wall: found a value of type float. Allowed: Diffuse, "):
            scene.materials["wall"] = 0.6
        scene.materials["wall"] = {"type": "difuse", "reflectance": 0.6}
        with self.assertRaisesRegex(stilb.InputError, 'materials.wall.type: unknown type "difuse"'):
            scene.measure()

    def test_arrays_and_numbers_of_numpy_are_values(self):
        scene = built()
        scene.lights["bulb"] = stilb.PointLight(position=np.array([2, 1.5, 2.3]), flux=np.float32(800))
        scene.sensors["desk"] = stilb.Illuminance(points=np.full((5, 3), 0.8), normal=np.array([0, 0, 1]))
        self.assertEqual(scene.measure(paths=PATHS)["desk"].value.shape, (5,))
        scene.sensors["desk"].points = object()
        with self.assertRaisesRegex(stilb.InputError, "sensors.desk.points: a value of type object is not allowed"):
            scene.measure()

    def test_the_widest_numbers_of_numpy_are_values(self):
        """Their tolist() are themselves."""
        scene = built()
        before = scene.measure(paths=PATHS)["desk"].value
        scene.lights["bulb"] = stilb.PointLight(position=np.array([2, 1.5, 2.3], np.longdouble), flux=np.longdouble(800))
        np.testing.assert_array_equal(scene.measure(paths=PATHS)["desk"].value, before)
        self.assertIn("flux = 800.0", document_text(scene.to_dict()))

    def test_parts_change_by_their_attributes_only(self):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
        mesh = stilb.Mesh(vertices, [[0, 1, 2]], "wall")
        vertices[0] = 9
        np.testing.assert_array_equal(mesh.vertices[0], [0, 0, 0])
        with self.assertRaises(ValueError):
            mesh.vertices[0] = 9
        with self.assertRaisesRegex(AttributeError, "Mesh has no flux; it has: vertices, faces, material"):
            mesh.flux

    def test_wrong_meshes_are_refused(self):
        square = [[0, 0, 1], [1, 0, 1], [1, 1, 1]]
        with self.assertRaisesRegex(stilb.InputError, "vertices: found an array of shape .3,."):
            stilb.Mesh([0, 0, 1], [[0, 1, 2]], "wall")
        with self.assertRaisesRegex(stilb.InputError, "faces: found an array of float64"):
            stilb.Mesh(square, [[0.0, 1, 2]], "wall")
        with self.assertRaisesRegex(stilb.InputError, "faces: an index is negative"):
            stilb.Mesh(square, [[0, 1, -1]], "wall")
        scene = built()
        scene.objects["mesh"] = stilb.Mesh(square, [[0, 1, 3]], "wall")
        with self.assertRaisesRegex(stilb.InputError, "objects.mesh.faces: a triangle has the vertex 3. Allowed: .* 0 to 2"):
            scene.measure()
        scene.objects["mesh"] = stilb.Mesh([[0, 0, np.nan], [1, 0, 1], [1, 1, 1]], [[0, 1, 2]], "wall")
        with self.assertRaisesRegex(stilb.InputError, "objects.mesh.vertices: vertex 0: "):
            scene.measure()


if __name__ == "__main__":
    unittest.main()
