"""stilb report: the page is well-formed, and shows what `measure` finds."""

import html
import math
import re
import unittest
import xml.etree.ElementTree
from html.parser import HTMLParser
from pathlib import Path

from command_line import CAMERA, ROOM, ROOT, CommandLineTest, run

RATINGS = """
[sensors.task]
type = "area"
corners = [[0.6, 0.6], [3.4, 0.6], [3.4, 2.2], [0.6, 2.2]]
height = 0.75
spacing = 0.4
surround = 0.4

[sensors.face]
type = "cylindrical"
positions = [[2, 1, 1.2], [3, 1, 1.2]]

[sensors.sight]
type = "luminance"
position = [2, 1.5, 1.2]
direction = [1, 0, 0]

[sensors.ratio]
type = "derived"
value = "desk.mean / wall"
"""

# One lamp of 1000 cd in all directions, 2 m above a black floor.
DARK_ROOM = """
[materials.black]
type = "black"

[objects.floor]
shape = "rectangle"
corner = [0, 0, 0]
edge_u = [6, 0, 0]
edge_v = [0, 4, 0]
material = "black"

[lights.lamp]
type = "point"
position = [2.5, 1.5, 2]
intensity = 1000

[sensors.floor]
type = "grid"
corner = [0, 0, 0]
edge_u = [0, 4, 0]
edge_v = [6, 0, 0]
normal = [0, 0, 1]
count = [80, 120]
"""

VOID = {"meta", "img", "wbr"}


class Page(HTMLParser):
    """Checks that elements are closed in order; collects texts of cells and headings."""

    def __init__(self, markup):
        super().__init__(convert_charrefs=True)
        self.open, self.faults, self.texts, self.rows, self.images = [], [], [], [], []
        self.feed(markup)
        self.close()
        self.faults += [f"<{tag}> is not closed" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag == "img":
            self.images.append(dict(attributes)["src"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes nothing")

    def handle_data(self, data):
        self.texts.append(data)
        if self.rows and {"td", "th"} & set(self.open):
            self.rows[-1][-1] += data

    @property
    def text(self):
        return " ".join(self.texts)


def shown_as(number, text):
    """Whether the text is the number, rounded to the digits that it has."""
    decimals = len(text.partition(".")[2])
    return abs(float(text) - number) <= 0.5000001 * 10.0 ** -decimals


def without_times(page):
    return re.sub(r"<time>.*?</time>", "", page)


class ReportTest(CommandLineTest):
    def report(self, *arguments, scene=None, code=0):
        output = self.folder / "report.html"
        result = run("report", scene or self.scene, "-o", output, *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        markup = output.read_text(encoding="utf-8")
        page = Page(markup)
        self.assertEqual(page.faults, [])
        for drawing in re.findall(r"<svg.*?</svg>", markup, re.DOTALL):
            xml.etree.ElementTree.fromstring(drawing)
        self.assertNotRegex(without_times(markup), r"(?:src|href)=\"(?!data:)")
        return markup, page

    def test_every_reading_is_in_a_table(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        document = self.measure("--paths", "4096")
        _, page = self.report("--paths", "4096")
        self.assertNotIn("All readings", page.text)
        _, page = self.report("--paths", "4096", "--readings")
        self.assertIn("All readings", page.text)
        tables = iter(page.rows)
        for sensor in document["sensors"]:
            if sensor["type"] == "derived":
                (value,) = sensor["values"]
                (row,) = [r for r in page.rows if r[:1] == [sensor["name"]]]
                self.assertTrue(shown_as(value["value"], row[2].split(" ")[0]))
                continue
            # The tables of all readings come last, in the order of the sensors.
            for number, value in enumerate(sensor["values"], start=1):
                row = next(r for r in tables if r[0] == str(number) and " to " in r[-1])
                shown, half = row[-3].split(" ± ")
                low, high = row[-1].split(" to ")
                with self.subTest(sensor=sensor["name"], number=number):
                    self.assertTrue(shown_as(value["value"], shown), row)
                    self.assertTrue(shown_as(value["interval"][0], low), row)
                    self.assertTrue(shown_as(value["interval"][1], high), row)
                    self.assertTrue(shown_as((value["interval"][1] - value["interval"][0]) / 2, half), row)
                    self.assertTrue(shown_as(value["standard_error"], row[-2]), row)
                    self.assertLess(math.dist(map(float, row[1:4]), value["position"]), 1e-3)

    def test_statistics_are_in_the_table(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        document = self.measure("--paths", "4096")
        _, page = self.report("--paths", "4096")
        for sensor in document["sensors"]:
            if len(sensor["values"]) < 2:
                continue
            (row,) = [r for r in page.rows if len(r) == 8 and r[:2] == [sensor["name"], f"{len(sensor['values'])} points"]]
            keys = ["mean", "minimum", "maximum", "uniformity", "diversity"]
            for key, cell in zip(keys, row[3:]):
                with self.subTest(sensor=sensor["name"], key=key):
                    shown, half = cell.split(" ± ")
                    low, high = sensor["summary"][key + "_interval"]
                    self.assertTrue(shown_as(sensor["summary"][key], shown))
                    self.assertTrue(shown_as((high - low) / 2, half))

    def test_requirements_and_exit_codes(self):
        for limit, code, verdict in (("1", 0, "pass"), ("1e5", 1, "fail")):
            scene = self.write("required.toml", ROOM.replace("count = [3, 2]", f"count = [3, 2]\nrequire = {{ mean = {limit} }}"))
            _, page = self.report("--check", scene=scene, code=code)
            (row,) = [r for r in page.rows if r[:1] == ["desk"] and len(r) == 4 and "at least" in r[1]]
            self.assertEqual(row[1], f"mean at least {float(limit):g} lx")
            self.assertEqual(row[3], verdict)
            self.assertIn(f"Requirements: 1 {verdict}.", page.text)
        self.expect_wrong_input(["report", self.scene, "-o", self.folder / "r.html", "--check"],
                                "no measured sensor has a key \"require\"")

    def test_the_end_before_the_error_is_told(self):
        _, page = self.report("--error", "0.0001%", "--time", "2", code=3)
        self.assertIn("ended: time limit reached, before the requested error was reached.", page.text)
        self.assertRegex(page.text, r"\d+ of 7 readings reach it")

    def test_names_are_escaped(self):
        name = "<b>A & B</b> \"quoted\""
        scene = self.write("names.toml", ROOM.replace("A room", name.replace('"', '\\"'))
                           .replace("sensors.desk", 'sensors."a < b & c"').replace("lights.bulb", "lights.\"<script>\""))
        markup, page = self.report("--paths", "2048", scene=scene)
        self.assertNotIn("<b>A", markup)
        self.assertNotIn("<script", markup)
        for text in (name, "a < b & c", "<script>"):
            self.assertIn(text, page.text)
            self.assertIn(html.escape(text), markup)

    def test_the_same_seed_gives_the_same_page(self):
        self.scene = self.write("view.toml", ROOM + CAMERA.replace("640, 480", "40, 30"))
        arguments = ("--paths", "2048", "--view-passes", "2")
        first, second = (self.report(*arguments, "--threads", threads)[0] for threads in ("1", "2"))
        self.assertEqual(without_times(first).replace("--threads 1", "--threads 2"), without_times(second))
        self.assertNotEqual(without_times(self.report(*arguments, "--seed", "2")[0]), without_times(first))

    def test_a_camera_is_a_picture(self):
        self.scene = self.write("view.toml", ROOM + CAMERA.replace("640, 480", "40, 30"))
        _, page = self.report("--paths", "2048", "--view-passes", "4")
        (image,) = page.images
        self.assertTrue(image.startswith("data:image/png;base64,iVBORw0KGgo"))
        self.assertRegex(page.text, r"40 × 30 pixels, 4 passes; mean luminance [\d.]+ cd/m².*Exposure [\d.]+ per cd/m², white 65\d\d K")
        _, page = self.report("--paths", "2048", "--sensor", "desk")
        self.assertEqual(page.images, [])
        _, page = self.report("--sensor", "view", "--view-passes", "2")
        self.assertEqual(len(page.images), 1)
        self.assertNotIn("Measured values", page.text)

    def test_scenes_without_lights_or_grids(self):
        dark = re.sub(r"\[lights.*?\n\n", "", ROOM, flags=re.DOTALL)
        _, page = self.report("--paths", "2048", scene=self.write("dark.toml", dark))
        self.assertIn("no light: the scene is dark", page.text)
        self.assertNotIn("Luminaires Names", page.text)
        single = re.sub(r"\[sensors.desk.*?\n\n", "", ROOM, flags=re.DOTALL)
        _, page = self.report("--paths", "2048", scene=self.write("single.toml", single))
        self.assertNotIn("Illuminance of areas", page.text)
        nothing = ROOM[:ROOM.index("[sensors")]
        self.expect_wrong_input(["report", self.write("nothing.toml", nothing), "-o", self.folder / "r.html"],
                                "there is nothing to report: the scene needs a sensor")

    def test_isolux_lines_lie_where_the_light_is_so_strong(self):
        markup, page = self.report("--paths", "2048", scene=self.write("dark.toml", DARK_ROOM))
        plan = re.search(r'<figure class="plan">.*?</figure>', markup, re.DOTALL)[0]
        root = xml.etree.ElementTree.fromstring(re.search(r"<svg.*?</svg>", plan, re.DOTALL)[0])
        place = {"x": [], "y": []}  # pairs of pixels and metres, from the labels of the axes
        for label in root.iter("{http://www.w3.org/2000/svg}text"):
            if label.get("class") == "axis":
                x, y = map(float, re.findall(r"-?[\d.]+", label.get("transform"))[:2])
                is_x = label.get("text-anchor") == "middle"
                place["x" if is_x else "y"].append((x if is_x else y, float(label.text.removesuffix(" m"))))
        scale = {axis: (pairs[-1][1] - pairs[0][1]) / (pairs[-1][0] - pairs[0][0]) for axis, pairs in place.items()}
        # The labels of the y axis stand a little below their values.
        frame = next(p.get("d") for p in root.iter("{http://www.w3.org/2000/svg}path") if p.get("class") == "frame")
        ticks = [p.get("d") for p in root.iter("{http://www.w3.org/2000/svg}path") if p.get("class") == "tick"]
        self.assertTrue(frame)
        y_ticks = [float(d.split()[1].split("L")[0]) for d in ticks if d.split()[1].split("L")[0] == d.split()[-1]]
        metres = {"x": lambda p: place["x"][0][1] + scale["x"] * (p - place["x"][0][0]),
                  "y": lambda p: place["y"][0][1] + scale["y"] * (p - y_ticks[0])}
        labels = {float(t.text) for t in root.iter("{http://www.w3.org/2000/svg}text") if t.get("class") == "isoline-label"}
        radii = {}
        for path in root.iter("{http://www.w3.org/2000/svg}path"):
            if path.get("class") != "isoline":
                continue
            points = [tuple(map(float, p.split())) for p in re.split("[ML]", path.get("d")) if p]
            distances = [math.hypot(metres["x"](x) - 2.5, metres["y"](y) - 1.5) for x, y in points]
            self.assertLess(max(distances) - min(distances), 0.02)
            level = 2000 / math.hypot(2, sum(distances) / len(distances)) ** 3
            radii[level] = distances[0]
        self.assertGreater(len(radii), 3)
        self.assertLessEqual(len(labels), len(radii))
        for label in labels:
            nearest = min(radii, key=lambda level: abs(level - label))
            self.assertAlmostEqual(nearest / label, 1, delta=0.01)
        lamp = next(c for c in root.iter("{http://www.w3.org/2000/svg}circle") if c.get("class") == "luminaire")
        self.assertAlmostEqual(metres["x"](float(lamp.get("cx"))), 2.5, delta=0.005)
        self.assertAlmostEqual(metres["y"](float(lamp.get("cy"))), 1.5, delta=0.005)

    def test_bands_lie_around_their_area(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        markup, _ = self.report("--paths", "2048")
        (width,) = re.findall(r'<path class="band" stroke-width="([\d.]+)"', markup)
        (ratio,) = re.findall(r"<figcaption>Scale 1 : (\d+) in print", markup)
        self.assertAlmostEqual(float(width) + 1, 2 * 0.4 * 96 / 0.0254 / int(ratio), delta=0.01)
        outlines = re.findall(r'<path class="(band|band-edge|paper)"[^>]* d="([^"]+)"', markup)
        self.assertEqual([name for name, _ in outlines], ["band-edge", "band", "paper"])
        self.assertEqual(len({d for _, d in outlines}), 1)

    def test_rooms_have_plans_of_their_own_to_which_bands_keep(self):
        """Two rooms of 4 m x 5 m in a house of 20 m; the desk is 0.3 m from the wall between them."""
        boxes = {"floor": ((-0.1, -0.1, -0.1), (20, 5.1, 0)), "ceiling": ((-0.1, -0.1, 2.8), (20, 5.1, 2.9)),
                 "west": ((-0.1, 0, 0), (0, 5, 2.8)), "between": ((4, 0, 0), (4.1, 5, 2.8)),
                 "east": ((8.1, 0, 0), (20, 5, 2.8)), "south": ((-0.1, -0.1, 0), (20, 0, 2.8)),
                 "north": ((-0.1, 5, 0), (20, 5.1, 2.8))}
        scene = "[materials.w]\ntype = \"diffuse\"\nreflectance = 0.6\n" + "".join(
            f"[objects.{name}]\nshape = \"box\"\nmin = {list(low)}\nmax = {list(high)}\nmaterial = \"w\"\n"
            for name, (low, high) in boxes.items()) + """
[lights.lamp_with_a_long_name]
type = "sphere"
center = [2, 2.5, 2.4]
radius = 0.1
flux = 9000
power = 60
[sensors.desk]
type = "area"
corner = [2.1, 2, 0.75]
edge_u = [1.6, 0, 0]
edge_v = [0, 0.8, 0]
surround = { width = 0.5, require = { mean = 100, uniformity = 0.4 } }
"""
        self.scene = self.write("house.toml", scene)
        document = self.measure("--paths", "4096")
        desk, surround = document["sensors"]
        self.assertEqual(surround["requirements"][1]["verdict"], "pass")
        self.assertTrue(all(0 < v["position"][0] < 4 for v in surround["values"]))
        (room,) = document["power"]["rooms"]
        self.assertAlmostEqual(room["floor_m2"], 20, 2)
        self.assertAlmostEqual(room["w_m2"], 3, 3)
        self.assertIn("\nInstalled power: 60 W; 3 W/m² of the room's floor (20 m²); 46.9 W/m² of the task area",
                      run("measure", self.scene, "--paths", "4096").stdout)
        markup, page = self.report("--paths", "4096")
        whole, of_room = re.findall(r'<figure class="plan">(.*?)</figure>', markup, re.DOTALL)
        ratios = [int(re.search(r"Scale 1 : (\d+) in print", plan)[1]) for plan in (whole, of_room)]
        self.assertGreater(ratios[0], 1.9 * ratios[1])
        self.assertIn("Room of 20 m², floor at z = 0 m.", of_room)
        for plan, ratio in zip((whole, of_room), ratios):
            region = re.search(r'<clipPath id="plan-\d-band-1"><path d="([^"]+)"', plan)[1]
            corners = [tuple(map(float, p.rstrip("Z").split())) for p in re.split("[ML]", region) if p]
            metre = 96 / 0.0254 / ratio
            extents = [max(c[i] for c in corners) - min(c[i] for c in corners) for i in (0, 1)]
            self.assertAlmostEqual(extents[0] / metre, 4, 2)
            self.assertAlmostEqual(extents[1] / metre, 5, 2)
        self.assertIn(">lamp_with_a_long_name</text>", of_room)
        self.assertRegex(page.text, r"Installed power\s+60 W; 3 W/m² of the room's floor")
        self.assertIn("lamp_<wbr>with_<wbr>a_<wbr>long_<wbr>name", markup)

    def test_wrong_names_of_pages(self):
        self.expect_wrong_input(["report", self.scene], "--output FILE is missing. It gives the page to write")
        self.expect_wrong_input(["report", self.scene, "-o", "r.pdf"], "-o r.pdf", "End the name in .html")
        self.expect_wrong_input(["report", self.scene, "-o", self.folder / "no/r.html"], "no")
        page = self.write("page.html", "<html><body>mine</body></html>")
        self.expect_wrong_input(["report", self.scene, "-o", page], "the result is a report")
        self.report("--paths", "2048")
        self.report("--paths", "2048")  # over itself
        self.expect_wrong_input(["measure", self.folder / "report.html"], "not a scene but a report")

    def test_the_classroom_has_its_glare_and_luminaires(self):
        _, page = self.report("--paths", "2048", "--sensor", "teacher", "--sensor", "task",
                              scene=ROOT / "scenes/classroom/classroom.toml")
        self.assertRegex(page.text, r"teacher: UGR 1\d\.\d")
        sources = [r for r in page.rows if len(r) == 5 and r[0].startswith("panel_") and r[4].endswith(" %")
                   and "not counted" not in r[0]]
        self.assertGreater(len(sources), 3)
        self.assertAlmostEqual(sum(float(r[4].removesuffix(" %")) for r in sources), 100, delta=3)
        # The formula of CIE 117 with the numbers of the table, which are rounded.
        glare = sum(float(r[1]) ** 2 * float(r[2]) / float(r[3]) ** 2 for r in sources)
        background = float(re.search(r"background luminance ([\d.]+) cd/m²", page.text)[1])
        rating = float(re.search(r"teacher: UGR ([\d.]+)", page.text)[1])
        self.assertAlmostEqual(8 * math.log10(0.25 / background * glare), rating, delta=0.2)
        self.assertIn("Stilb example panel 600", page.text)
        self.assertRegex(page.text, r"Count\s+9\s")
        self.assertRegex(page.text, r"Maintenance factor\s+0\.8 ")


if __name__ == "__main__":
    unittest.main()
