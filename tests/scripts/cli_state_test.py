#!/usr/bin/env python3
"""State files of the command line: runs that are interrupted, killed, continued, made in parts and merged."""

import json
import os
import random
import resource
import signal
import subprocess
import time
import unittest

from command_line import CAMERA, PROGRAM, ROOM, CommandLineTest, run

SMALL_CAMERA = CAMERA.replace("[640, 480]", "[64, 48]")
MOMENTS = random.Random(20)


def numbers(text):
    """The lines of a JSON document that do not depend on time."""
    return [line for line in text.splitlines() if '"elapsed_s"' not in line]


class StateTest(CommandLineTest):
    def run_program(self, *arguments, code=0):
        result = run(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stderr)
        return result


class Interrupted(StateTest):
    """A run that ends and goes on at random moments has the bits of a run in one go."""

    def interrupted(self, arguments, state, signals):
        """Begins a run again and again, and ends it by these signals; then lets it finish."""
        command = [PROGRAM, *arguments, "--state", state, "--state-every", "0.1"]
        ended = 0
        for number in signals:
            with subprocess.Popen(list(map(str, command)), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
                time.sleep(MOMENTS.uniform(0.05, 0.6))
                if process.poll() is None:
                    process.send_signal(number)
                    ended += 1
            if (self.folder / state).exists():
                command = [PROGRAM, "resume", state]
        self.assertGreater(ended, len(signals) // 2, "the run is too short to be interrupted")
        result = subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)

    SIGNALS = [signal.SIGINT, signal.SIGKILL, signal.SIGTERM, signal.SIGKILL, signal.SIGHUP]

    def test_readings(self):
        scene = self.write("room.toml", ROOM)
        for method, paths in [("light-paths", "1e6"), ("path", "2e5"), ("guided", "2e4")]:
            with self.subTest(method=method):
                common = ["measure", scene, "--method", method, "--paths", paths]
                self.run_program(*common, "-o", "whole.json", "--replicates")
                self.interrupted([*common, "-o", f"{method}.json", "--replicates"], f"{method}.run", self.SIGNALS)
                whole, parts = ((self.folder / name).read_text() for name in ("whole.json", f"{method}.json"))
                self.assertEqual(numbers(whole), numbers(parts))

    def test_readings_that_stop_by_their_error(self):
        scene = self.write("room.toml", ROOM)
        common = ["measure", scene, "--method", "path", "--error", "0.08%", "--time", "1000"]
        self.run_program(*common, "-o", "whole.json")
        self.interrupted([*common, "-o", "parts.json"], "readings.run", self.SIGNALS)
        whole, parts = ((self.folder / name).read_text() for name in ("whole.json", "parts.json"))
        self.assertEqual(numbers(whole), numbers(parts))

    def test_pictures(self):
        scene = self.write("room.toml", ROOM + SMALL_CAMERA)
        common = ["render", scene, "--paths", "256"]
        self.run_program(*common, "-o", "whole.hdr")
        self.interrupted([*common, "-o", "parts.hdr"], "picture.run", self.SIGNALS)
        pixels = [(self.folder / name).read_bytes().split(b"\n\n", 1)[1] for name in ("whole.hdr", "parts.hdr")]
        self.assertEqual(*pixels)

    def test_solutions(self):
        scene = self.write("room.toml", ROOM)
        common = ["solve", scene, "--paths", "1024"]
        self.run_program(*common, "-o", "whole.solution")
        self.interrupted([*common, "-o", "parts.solution"], "solution.run", self.SIGNALS)
        self.assertEqual((self.folder / "whole.solution").read_bytes(), (self.folder / "parts.solution").read_bytes())

    def test_the_file_is_the_old_or_the_new_one(self):
        """Kills while the state is written all the time."""
        scene = self.write("room.toml", ROOM)
        command = [PROGRAM, "measure", scene, "--method", "path", "--paths", "1e9", "--state", "many.run", "--state-every", "0.1"]
        paths = 0
        for _ in range(int(os.environ.get("STILB_KILLS", "12"))):
            with subprocess.Popen(list(map(str, command)), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
                while not (self.folder / "many.run").exists() and process.poll() is None:
                    time.sleep(0.05)
                time.sleep(MOMENTS.uniform(0.15, 0.5))
                process.kill()
            shown = json.loads(self.run_program("measure", "--from", "many.run", "--json", code=3).stdout)
            self.assertGreaterEqual(shown["paths"], paths)
            paths = shown["paths"]
        self.assertGreater(paths, 0)


class Merged(StateTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("room.toml", ROOM)

    def part(self, number, of, *more):
        self.run_program("measure", self.scene, "--paths", "65536", "--part", f"{number}/{of}", "--state", f"{number}.run", *more)
        return f"{number}.run"

    def test_parts_are_the_bits_of_the_whole(self):
        for name, sensor in (("small", ""), ("grid", "count = [3, 2]")):
            with self.subTest(name):
                text = ROOM.replace(sensor, "count = [16, 12]") if sensor else ROOM
                self.scene = self.write("room.toml", text)
                sensors = ["--sensor", "desk"] if sensor else []
                parts = [self.part(number, 16, *sensors) for number in range(1, 17)]
                self.run_program("measure", self.scene, "--paths", "65536", "-o", "whole.json", "--replicates", *sensors)
                self.run_program("merge", *parts, "-o", "merged.json", "--replicates", "--state", "all.run")
                whole, merged = ((self.folder / file).read_text() for file in ("whole.json", "merged.json"))
                self.assertEqual(numbers(whole), numbers(merged))
                # What is merged goes on as the whole run does.
                self.run_program("measure", self.scene, "--paths", "131072", "-o", "longer.json", *sensors)
                self.run_program("resume", "all.run", "--paths", "131072", "-o", "resumed.json")
                longer, resumed = ((self.folder / file).read_text() for file in ("longer.json", "resumed.json"))
                self.assertEqual(numbers(longer), numbers(resumed))
                (self.folder / "all.run").unlink()
                for part in parts:
                    (self.folder / part).unlink()

    def test_seeds_have_the_mean_by_samples(self):
        means = []
        for seed, paths in ((1, 65536), (2, 131072)):
            result = self.run_program("measure", self.scene, "--method", "light-paths", "--paths", str(paths), "--seed", str(seed),
                                      "--state", f"seed{seed}.run", "--json")
            means.append((json.loads(result.stdout)["sensors"][1]["values"][0]["value"], paths))
        merged = json.loads(self.run_program("merge", "seed1.run", "seed2.run", "--json").stdout)
        expected = sum(mean * paths for mean, paths in means) / sum(paths for _, paths in means)
        self.assertAlmostEqual(merged["sensors"][1]["values"][0]["value"], expected, delta=1e-3 * expected)
        self.assertEqual(merged["paths"], 3 * 65536)
        self.assertEqual((merged["seed"], merged["seeds"]), (1, [1, 2]))

    def test_parts_of_several_seeds_in_any_order_and_any_folder(self):
        (self.folder / "runs").mkdir()
        files = []
        for number, seed in ((1, 7), (1, 8), (2, 7), (2, 8)):
            files.append(f"runs/{seed}_{number}.run")
            self.run_program("measure", self.scene.name, "--paths", "65536", "--seed", seed, "--part", f"{number}/2", "--state", files[-1])
        both = json.loads(self.run_program("merge", *files, "--state", "both.run", "--json").stdout)
        again = json.loads(self.run_program("merge", *reversed(files), "--json").stdout)
        self.assertEqual((both["paths"], again["paths"]), (2 * 65536, 2 * 65536))
        self.assertEqual([s["values"] for s in both["sensors"]], [s["values"] for s in again["sensors"]])
        self.assertIn("seeds 7, 8", self.run_program("info", "both.run").stdout)
        shown = json.loads(self.run_program("measure", "--from", "both.run", "--json").stdout)
        self.assertEqual([s["values"] for s in both["sensors"]], [s["values"] for s in shown["sensors"]])
        # The sums lie in another folder than those that were merged: their scene is found all the same.
        (self.folder / "sums").mkdir()
        self.run_program("merge", files[0], files[2], "--state", "sums/one.run")
        self.run_program("resume", "sums/one.run", "--paths", "131072")

    def test_refuses_what_does_not_belong_together(self):
        one = self.part(1, 2)
        self.assertIn("both have made the same samples", self.run_program("merge", one, one, code=2).stderr)
        self.run_program("measure", self.scene, "--method", "path", "--paths", "4096", "--state", "path.run")
        self.assertIn("path.run: this is the state of another run: its method is", self.run_program("merge", one, "path.run", code=2).stderr)
        other = self.write("other.toml", ROOM.replace("flux = 1000", "flux = 900"))
        self.run_program("measure", other, "--paths", "65536", "--part", "2/2", "--state", "other.run")
        self.assertIn("other.run: this is the state of another run: materials", self.run_program("merge", one, "other.run", code=2).stderr)
        fewer = ["measure", self.scene, "--sensor", "desk", "--paths", "65536", "--part", "2/2", "--state", "fewer.run"]
        self.run_program(*fewer)
        self.assertIn("its sensors are others", self.run_program("merge", one, "fewer.run", code=2).stderr)

    def test_says_what_a_part_needs(self):
        self.assertIn("--part needs --state", self.run_program("measure", self.scene, "--part", "1/2", code=2).stderr)
        wrong = ["measure", self.scene, "--paths", "4096", "--state", "x.run", "--part"]
        for part in ("3/2", "0/2", "x", "1/", "/2"):
            self.assertIn("expected K/N", self.run_program(*wrong, part, code=2).stderr)
        self.assertIn("needs a number of paths", self.run_program("measure", self.scene, "--part", "1/2", "--state", "y.run", code=2).stderr)


class MergedPictures(StateTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("room.toml", ROOM + SMALL_CAMERA)
        self.common = ["render", self.scene, "--paths", "24"]

    def pixels(self, name):
        return (self.folder / name).read_bytes().split(b"\n\n", 1)[1]

    def parts(self, count, *more):
        names = [f"part{number}.run" for number in range(1, count + 1)]
        for number, name in enumerate(names, 1):
            self.run_program(*self.common, "--part", f"{number}/{count}", "--state", name, *more)
        return names

    def test_parts_are_the_bits_of_the_whole(self):
        parts = self.parts(4)
        self.assertIn("part 3/4 of the passes, 6 in", self.run_program(*self.common, "--part", "3/4", "--state", "again.run").stdout)
        self.assertIn("1 of 4 strands", self.run_program("info", "part2.run").stdout)
        self.run_program(*self.common, "-o", "whole.hdr")
        self.run_program("merge", *parts, "-o", "merged.hdr", "--state", "all.run")
        self.assertEqual(self.pixels("whole.hdr"), self.pixels("merged.hdr"))
        self.run_program("render", "--from", "all.run", "-o", "shown.hdr")
        self.assertEqual(self.pixels("whole.hdr"), self.pixels("shown.hdr"))
        self.run_program("render", self.scene, "--paths", "40", "-o", "longer.hdr")
        self.run_program("resume", "all.run", "--paths", "40", "-o", "resumed.hdr")
        self.assertEqual(self.pixels("longer.hdr"), self.pixels("resumed.hdr"))

    def test_layers_of_parts(self):
        parts = self.parts(2, "--by", "bounce")
        self.run_program("merge", *parts, "-o", "merged.exr")
        self.assertIn(b"Combined_", (self.folder / "merged.exr").read_bytes())

    def test_seeds(self):
        for seed in (1, 2):
            self.run_program(*self.common, "--seed", seed, "-o", f"{seed}.exr", "--state", f"{seed}.run")
        self.assertIn("render --from both.run", self.run_program("merge", "1.run", "2.run", "--state", "both.run").stdout)
        shown = self.run_program("render", "--from", "both.run", "-o", "both.exr")
        self.assertIn("48 passes", shown.stdout)
        self.assertIn("seeds 1, 2", self.run_program("info", "both.run").stdout)
        self.assertIn("cannot go on", self.run_program(*self.common, "-o", "x.exr", "--state", "both.run", code=2).stderr)

    def test_refuses_what_does_not_belong_together(self):
        one, _ = self.parts(2)
        for arguments, words in (
            (["merge", one, one, "-o", "x.hdr"], "both have made the same passes"),
            (["merge", one, one], "-o is missing"),
            (["merge", one, one, "--csv", "x", "-o", "x.hdr"], "--csv"),
            (["merge", one, "-o", "x.hdr"], "only 2 of the 4 replicates"),
            ([*self.common, "--part", "5/5", "--state", "five.run"], "has 4 replicates"),
            ([*self.common, "--part", "1/2", "-o", "x.hdr", "--state", "y.run"], "--part makes no picture"),
            (["render", "--from", one, "-o", "x.hdr"], "merge all of its parts"),
            (["render", "--from", one, "-o", "x.hdr", "--seed", "3"], "--from shows the picture"),
            (["measure", "--from", one], "not of `stilb measure`"),
        ):
            with self.subTest(words):
                self.assertIn(words, self.run_program(*arguments, code=2).stderr)


class Refused(StateTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("room.toml", ROOM)
        self.command = ["measure", self.scene, "--paths", "65536", "--state", "room.run"]

    def test_a_finished_run_is_a_sentence(self):
        self.run_program(*self.command)
        before = (self.folder / "room.run").read_bytes()
        self.assertIn("the run has ended: paths done", self.run_program("resume", "room.run").stdout)
        self.assertEqual(before, (self.folder / "room.run").read_bytes())
        self.assertIn("No samples were added", self.run_program(*self.command).stderr)

    def test_another_run(self):
        self.run_program(*self.command)
        before = (self.folder / "room.run").read_bytes()
        for more, message in (
            (["--seed", "2"], "its seed is 1, here it is 2"),
            (["--bounces", "3"], "its bounces is not given, here it is 3"),
            (["--method", "path"], "its method is auto, here it is path"),
            (["--set", "lights.bulb.flux=900"], "have changed since"),
            (["--sensor", "wall"], "its sensors are others"),
        ):
            self.assertIn(message, self.run_program(*self.command, *more, code=2).stderr)
        self.assertEqual(before, (self.folder / "room.run").read_bytes())
        self.assertIn("this is the state of `stilb measure`", self.run_program(
            "solve", self.scene, "-o", "x.solution", "--state", "room.run", code=2).stderr)

    def test_damaged_files(self):
        self.run_program(*self.command)
        whole = (self.folder / "room.run").read_bytes()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 4
        for content, message in (
            (whole[: len(whole) // 2], "was cut off"),
            (bytes(flipped), "do not match their hash"),
            (whole + b"more", "surplus bytes"),
            (b"[scene]\n", "is a file of another kind"),
            (whole[:8] + b"\x63\0\0\0" + whole[12:], "is of version 99"),
            (whole[:12] + (65536).to_bytes(4, "little") + whole[16:], "the file ends before the size of a chunk"),
            (whole[:12] + (65537).to_bytes(4, "little") + whole[16:], "65537 chunks"),
        ):
            (self.folder / "room.run").write_bytes(content)
            result = self.run_program(*self.command, code=2)
            self.assertIn(message, result.stderr)
            self.assertIn("room.run", result.stderr)
            self.assertEqual((self.folder / "room.run").read_bytes(), content)

    def test_a_full_disk_and_a_closed_folder(self):
        # The limit on the size of a file stands for a disk without space.
        command = [PROGRAM, *self.command[:-1], "full.run", "-o", "full.json"]
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000))
        result = subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, check=False, preexec_fn=limit)
        self.assertEqual(result.returncode, 1)
        self.assertIn("cannot write 'full.run'", result.stderr)
        self.assertTrue((self.folder / "full.json").exists(), "the readings are not lost")
        self.assertEqual(list(self.folder.glob("full.run*")), [])
        result = self.run_program("measure", self.scene, "--paths", "4096", "--state", "missing/room.run", code=2)
        self.assertIn("there is no folder 'missing'", result.stderr)

    def test_of_another_folder(self):
        (self.folder / "elsewhere").mkdir()
        self.run_program("measure", self.scene, "--paths", "65536", "--state", "elsewhere/room.run")
        self.run_program("resume", "elsewhere/room.run", "--paths", "131072", "-o", "here.json")
        self.assertTrue((self.folder / "here.json").exists())
        shown = self.run_program("measure", "--from", "elsewhere/room.run").stdout
        self.assertIn("131072 paths", shown)

    def test_from_takes_no_other_readings(self):
        self.run_program(*self.command)
        for more in (["--sensor", "wall"], ["--grid", "z=0.8"], ["--vary", "run.bounces=1,2"], ["--error", "1%"], [self.scene]):
            message = self.run_program("measure", "--from", "room.run", *more, code=2).stderr
            self.assertIn("--from", message)

    def test_info(self):
        self.run_program(*self.command)
        shown = self.run_program("info", "room.run").stdout
        for words in ("state of a run of stilb measure", "readings: path", "65536 samples", "seed 1", "paths done"):
            self.assertIn(words, shown)


if __name__ == "__main__":
    unittest.main()
