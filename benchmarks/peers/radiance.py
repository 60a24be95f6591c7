"""Radiance's rtrace as a session, by the programs of the package pyradiance.

"exact" samples every interreflection anew (-aa 0) with Russian roulette and without an end, and its lamps at random
points (-dj 1): without bias. Its size is the number of repetitions at a point, or of rays through a pixel. "cached"
interpolates between stored interreflections and sees lamps as fixed points, as its users do: with bias. Its size is
-ad, the number of rays over the hemisphere, for points, and that of rays through a pixel for pictures.
"""

import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import pyradiance

from programs import Run, exported, finished
from tasks import Task

EFFICACY = 179.0
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
BIN, LIBRARY = (Path(pyradiance.__file__).parent / name for name in ("bin", "lib"))
COMMON = "-h -fff -u+ -ds 0.05 -dt 0 -dc 1 -dr 1 -dp 4096".split()
EXACT = "-dj 1 -ab 200 -aa 0 -as 0 -av 0 0 0 -aw 0 -lr 0 -lw 1e-3".split()
CACHED = "-dj 0 -ab 8 -aa 0.1 -ar 256 -av 0 0 0 -aw 0 -lr 12 -lw 1e-5".split()
CACHED_PICTURE = ["-ad", 1024, "-as", 256]
EXACT_RAYS = {"grid": 64, "readings": 64, "picture": 1}  # -ad
MOST_RAYS = 1 << 23  # at once


def lacks(task: Task) -> str:
    """Why the task cannot be compared; empty where it can."""
    return "no Phong and no GGX" if task.scene in ("office", "showroom") else ""


class RadianceSession:
    def __init__(self, task: Task, settings: str, threads: int):
        self.task, self.threads = task, threads
        self.is_biased = settings == "cached"
        self.first_size = 64 if self.is_biased and task.kind != "picture" else 1
        self.memory_mb = 0.0
        self.folder = tempfile.TemporaryDirectory()
        self.environment = {"RAYPATH": f".:{LIBRARY}", "PATH": str(BIN)}
        self.scene = exported(task, "radiance")
        octree, self.load_s = self._run(["oconv", "scene.rad"])
        self.octree = Path(self.folder.name) / "scene.oct"
        self.octree.write_bytes(octree)
        self.count = len(self._rays(1))

    def _run(self, command: list, data: bytes = b"") -> tuple[bytes, float]:
        words = [BIN / command[0], *command[1:]]
        with tempfile.TemporaryFile() as source:
            source.write(data)
            source.seek(0)
            done, seconds, memory_mb = finished(words, env=self.environment, cwd=self.scene, stdin=source)
        self.memory_mb = max(self.memory_mb, memory_mb)
        return done.stdout, seconds

    def _settings(self, size: int, store: Path) -> list:
        command = ["rtrace", *COMMON, "-n", self.threads]
        if not self.is_biased:
            return [*command, *EXACT, "-ad", EXACT_RAYS[self.task.kind]]
        rays = CACHED_PICTURE if self.task.kind == "picture" else ["-ad", size, "-as", size // 4]
        return [*command, *CACHED, *rays, "-af", store]

    def _rays(self, repeats: int) -> np.ndarray:
        """`repeats` rays for each value, one after the other."""
        if self.task.kind != "picture":
            points = np.concatenate([np.loadtxt(self.scene / f"{name}.pts", ndmin=2) for name in self.task.sensors])
            return np.repeat(points.astype(np.float32), repeats, axis=0)
        width, height = self.task.sensor["resolution"]
        view = ["vwrays", "-ff", "-vf", f"{self.task.sensors[0]}.vf", "-x", width, "-y", height, "-pj", 1]
        words = [str(word) for word in [BIN / view[0], *view[1:], "-c", repeats]]
        done = subprocess.run(words, env=self.environment, cwd=self.scene, capture_output=True, check=True)
        return np.frombuffer(done.stdout, np.float32).reshape(-1, 6)

    def run(self, size: int, seed: int) -> Run:
        repeats = 1 if self.is_biased and self.task.kind != "picture" else size
        at_once = min(repeats, max(MOST_RAYS // self.count, 1))
        store = Path(self.folder.name) / "ambient"
        store.unlink(missing_ok=True)
        flags = [] if self.task.kind == "picture" or self.task.is_luminance else ["-I"]
        total, seconds, done = 0.0, 0.0, 0
        while done < repeats:
            time.sleep(1)  # rtrace takes its seed from the clock, in seconds
            rays = self._rays(at_once)
            output, spent = self._run([*self._settings(size, store), *flags, self.octree], data=rays.tobytes())
            rgb = np.frombuffer(output, np.float32).reshape(len(rays) // at_once, at_once, 3)
            total, seconds, done = total + rgb.sum(axis=1, dtype=float), seconds + spent, done + at_once
        return Run(EFFICACY * total / done @ WEIGHTS, seconds)

    def set_up_s(self) -> float:
        return self.load_s

    def close(self) -> None:
        self.folder.cleanup()
