"""stilb solve, and render --from its files."""

import re
import unittest

from command_line import CAMERA, ROOM, CommandLineTest, run


class SolveTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("room.toml", ROOM + CAMERA.replace("[640, 480]", "[32, 24]"))
        self.solution = self.folder / "room.solution"

    def solve(self, *arguments):
        return run("solve", self.scene, "-o", self.solution, "--patch", "1", "--paths", "64", *arguments)

    def expect_picture(self, *arguments):
        picture = self.folder / "view.exr"
        result = run("render", *arguments, "-o", picture)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("solution, 16 passes", result.stdout)
        self.assertEqual(picture.read_bytes()[:4], b"\x76\x2f\x31\x01")
        return result.stdout

    def test_pictures_of_a_solution(self):
        result = self.solve()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for part in ("room.solution: ", "light at ", "1 group of lights", "ray-bundle, 64 steps", "all steps done"):
            self.assertIn(part, result.stdout)
        self.assertIn("mean luminance", self.expect_picture("--from", self.solution))

    def test_another_eye_needs_no_other_solution(self):
        self.solve()
        self.scene.write_text(self.scene.read_text() + CAMERA.replace("view", "door").replace("[0.5, 2.5", "[3.5, 0.5"))
        self.expect_wrong_input(["render", "--from", self.solution, "-o", self.folder / "view.exr"], "several cameras", "door")
        self.assertIn("door: ", self.expect_picture("--from", self.solution, "--sensor", "door"))

    def test_lamps_can_be_dimmed(self):
        self.solve()
        name = re.search(r"\[lights\.(\w+)\]", ROOM)[1]
        def mean(*arguments):
            return float(re.search(r"mean luminance ([\d.e+-]+)", self.expect_picture("--from", self.solution, *arguments))[1])
        whole, half = mean(), mean("--set", f"{name}=0.5")
        self.assertAlmostEqual(half, whole / 2, delta=0.01 * whole)
        self.assertEqual(mean("--set", f"{name}=0"), 0)
        self.assertLess(mean("--set", f"{name}=[1, 0.5, 0]"), whole)
        picture = ["-o", self.folder / "view.exr"]
        self.expect_wrong_input(["render", "--from", self.solution, "--set", "sun=2", *picture], "sun", f"Allowed: {name}")
        for value in ("-1", "many", "[1, 2]"):
            self.expect_wrong_input(["render", "--from", self.solution, "--set", f"{name}={value}", *picture],
                                    f"{name}={value}", "a number of 0 or more")

    def test_a_changed_scene_is_refused(self):
        self.solve()
        self.scene.write_text(self.scene.read_text().replace("flux = 1000", "flux = 1001"))
        self.expect_wrong_input(["render", "--from", self.solution, "-o", self.folder / "view.exr"],
                                "room.solution: ", "changed since the scene was solved", "Solve it again")

    def test_a_scene_that_moved_is_named(self):
        self.solve()
        (self.folder / "elsewhere").mkdir()
        self.scene = self.scene.rename(self.folder / "elsewhere/room.toml")
        self.expect_wrong_input(["render", "--from", self.solution, "-o", self.folder / "view.exr"],
                                "was not found", "room.toml", "stilb render SCENE --from FILE")
        self.expect_picture(self.scene, "--from", self.solution)

    def test_both_may_move_together(self):
        self.solve()
        moved = self.folder / "elsewhere"
        moved.mkdir()
        self.scene.rename(moved / "room.toml")
        self.expect_picture("--from", self.solution.rename(moved / "room.solution"))

    def test_flags_that_mean_nothing(self):
        self.solve()
        for flag, value in (("--method", "path"), ("--patch", "1"), ("--paths", "8"), ("--error", "1%"), ("--seed", "2")):
            self.expect_wrong_input(["render", "--from", self.solution, "-o", "view.exr", flag, value], flag, "--from")

    def test_what_cannot_be_solved(self):
        for arguments, parts in ((["--first-shot", "classical"], ["classical", "incoming, none"]),
                                 (["--degree", "13"], ["--degree"]), (["--method", "path"], ["--method"])):
            self.expect_wrong_input(["solve", self.scene, "-o", self.solution, *arguments], *parts)
        self.expect_wrong_input(["solve", self.scene, "-o", self.folder / "none/room.solution"], "there is no folder")

    def test_damaged_solutions(self):
        self.solve()
        content = self.solution.read_bytes()
        for damaged, part in ((content[:-1], "cut off"), (content[:100] + b"x" + content[101:], "damaged"),
                              (content[:8] + b"\x07" + content[9:], "of version 7"), (b"PNG", "not a solution")):
            self.solution.write_bytes(damaged)
            self.expect_wrong_input(["render", "--from", self.solution, "-o", "view.exr"], "room.solution", part)

    def test_seeds_and_threads(self):
        contents = []
        for arguments in (("--threads", "1"), ("--threads", "2"), ("--seed", "2")):
            self.solve(*arguments)
            contents.append(self.solution.read_bytes())
        self.assertEqual(contents[0], contents[1])
        self.assertNotEqual(contents[0], contents[2])


if __name__ == "__main__":
    unittest.main()
