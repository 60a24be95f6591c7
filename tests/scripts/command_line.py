"""The base of the tests of the command line: runs the program in a folder with a scene.

The program is $STILB, or build/release/stilb. It has $STILB_MOST_SECONDS, or 60, to end.
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STILB", str(ROOT / "build/release/stilb"))

ROOM = """
[scene]
name = "A room"

[materials.wall]
type = "diffuse"
reflectance = [0.7, 0.5, 0.3]

[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"

[objects.cabinet]
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1.5]
material = "wall"

[lights.bulb]
type = "point"
position = [2, 1.5, 2]
flux = 1000

[sensors.desk]
type = "grid"
corner = [1.5, 1, 0.75]
edge_u = [1.5, 0, 0]
edge_v = [0, 1, 0]
count = [3, 2]

[sensors.wall]
type = "illuminance"
position = [4, 1.5, 1.2]
normal = [-1, 0, 0]
"""

CAMERA = """
[sensors.view]
type = "camera"
position = [0.5, 2.5, 1.6]
target = [4, 1, 1]
resolution = [640, 480]
projection = "fisheye"
"""

# An OBJ mesh.
BOX = """
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
v 0 0 1
v 2 0 1
v 2 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""

# For a command that should end by itself: generous, machines may be busy. Sanitizers need more.
MOST_SECONDS = int(os.environ.get("STILB_MOST_SECONDS", 60))


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=MOST_SECONDS, **options)


def wait_for_error(process):
    """Reads the messages of a run with --progress until it has estimated its error: from then on it has a result."""
    for line in process.stderr:
        if " error " in line:
            return
    raise AssertionError("the run ended before its first error estimate")


class CommandLineTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.scene = self.write("room.toml", ROOM)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def expect_wrong_input(self, arguments, *parts):
        """Exit code 2, nothing on stdout, and a message that has all the parts."""
        result = run(*arguments)
        self.assertEqual(result.returncode, 2, result)
        self.assertEqual(result.stdout, "")
        for part in parts:
            self.assertIn(part, result.stderr)

    def measure(self, *arguments, code=0):
        """The JSON document of a measurement."""
        result = run("measure", self.scene, "--json", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        return json.loads(result.stdout, parse_constant=lambda name: self.fail(f"{name} is not JSON"))
