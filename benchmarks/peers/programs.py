"""Stilb and Mitsuba behind one interface.

A session measures one task. run(size, seed) gives values, and the processor time of the program and its threads
without what it does once; set_up_s() is the latter.
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import mitsuba as mi
import numpy as np

from tasks import HERE, ROOT, Task

mi.set_variant("scalar_rgb")  # to read pictures

STILB = Path(os.environ.get("STILB", ROOT / "build/release/stilb"))
EXPORTS = ROOT / "build/peers/exports"
SHORT_S, SHORT_RUNS = 0.5, 25
LONGEST_S = 150  # of one run, on the clock
LLVM = "/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1"


class TakesTooLong(Exception):
    """A run took longer than LONGEST_S."""


@dataclass
class Run:
    values: np.ndarray
    seconds: float


class PeakOfMemory:
    """Asks a process for its peak until it ends: what wait4() says includes this process before it became that one."""

    def __init__(self, process_id: int):
        self.status = Path(f"/proc/{process_id}/status")
        self.kilobytes = 0
        self.thread = threading.Thread(target=self._watch)
        self.thread.start()

    def _watch(self) -> None:
        while "VmHWM" in (text := self._read()):
            self.kilobytes = int(text.split("VmHWM:")[1].split()[0])
            time.sleep(0.02)

    def _read(self) -> str:
        try:
            return self.status.read_text()
        except OSError:
            return ""

    def megabytes(self) -> float:
        self.thread.join()
        return self.kilobytes / 1024


def finished(command: list, **options) -> tuple[subprocess.CompletedProcess, float, float]:
    """The processor time of the process and all that it started [s], and its peak of memory [MB].

    Raises TakesTooLong, after it has ended the process and what that started.
    """
    words = [str(word) for word in command]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, start_new_session=True, **options)
    end = threading.Timer(LONGEST_S, lambda: os.killpg(process.pid, signal.SIGKILL))
    end.start()
    peak = PeakOfMemory(process.pid)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    end.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode == -signal.SIGKILL:
        raise TakesTooLong
    if process.returncode not in (0, 3):
        raise RuntimeError(f"{command[0]} ended with exit code {process.returncode}")
    done = subprocess.CompletedProcess(command, process.returncode, output)
    return done, usage.ru_utime + usage.ru_stime, peak.megabytes()


def exported(task: Task, program: str) -> Path:
    folder = EXPORTS / f"{task.scene}-{program}"
    finished([STILB, "export", task.path, *task.overrides, "--format", program, "-o", folder, "--quiet"])
    return folder


def read_luminance(path: Path) -> np.ndarray:
    bitmap = mi.Bitmap(str(path))
    names = [field.name for field in bitmap.struct_()]
    return np.array(bitmap)[:, :, names.index("Y")].astype(float).ravel()


class StilbSession:
    first_size = 1
    is_biased = False

    def __init__(self, task: Task, method: str, threads: int):
        self.task, self.method, self.threads = task, method, threads
        self.memory_mb = 0.0
        self.smallest = self._smallest()
        self.per_sample_s = self._time_of_sample() if self.smallest[1] < SHORT_S else 0.0

    def _smallest(self) -> tuple[np.ndarray, float, int]:
        """The smallest run; where it is short, the median of several, the first of which only fills caches."""
        first = self._measured(1, 1)
        if first[1] > SHORT_S:
            return first
        return sorted((self._measured(1, 1) for _ in range(SHORT_RUNS)), key=lambda run: run[1])[SHORT_RUNS // 2]

    def _time_of_sample(self) -> float:
        """By a run that takes much longer than the smallest one: shorter ones differ from that mostly by chance."""
        _, least_s, done = self.smallest
        seconds = least_s
        while seconds < 8 * least_s:
            _, seconds, done = self._measured(2 * done, 1)
        return self._slope(seconds, done)

    def _slope(self, seconds: float, done: int) -> float:
        _, least_s, least = self.smallest
        return max((seconds - least_s) / (done - least), 0)

    def _command(self, size: int, seed: int) -> list:
        command = ["--method", self.method, "--paths", size, "--seed", seed, "--threads", self.threads, "--quiet"]
        sensors = [word for name in self.task.sensors for word in ("--sensor", name)]
        return [self.task.path, *self.task.overrides, *sensors, *command]

    def _measured(self, size: int, seed: int) -> tuple[np.ndarray, float, int]:
        """Values, processor time of the whole process, and the size that was done."""
        if self.task.kind == "picture":
            with tempfile.TemporaryDirectory() as folder:
                picture = Path(folder) / "picture.exr"
                done = finished([STILB, "render", "-o", picture, *self._command(size, seed)])
                self.memory_mb = max(self.memory_mb, done[2])
                return read_luminance(picture), done[1], max(size, 2)
        done = finished([STILB, "measure", "--json", "-", *self._command(size, seed)])
        self.memory_mb = max(self.memory_mb, done[2])
        document = json.loads(done[0].stdout)
        values = [reading["value"] for sensor in document["sensors"] for reading in sensor["values"]]
        return np.array(values), done[1], document["paths"]

    def run(self, size: int, seed: int) -> Run:
        values, seconds, done = self._measured(size, seed)
        _, least_s, least = self.smallest
        is_short = least_s < SHORT_S
        if is_short and seconds < 2 * least_s:
            return Run(values, done * self.per_sample_s)
        if not is_short and done > least:
            self.per_sample_s = self._slope(seconds, done)
        return Run(values, max(seconds - self.set_up_s(), 1e-3))

    def set_up_s(self) -> float:
        """The time of the smallest run without its samples."""
        _, least_s, least = self.smallest
        return max(least_s - least * self.per_sample_s, 0)

    def close(self) -> None:
        pass


class MitsubaSession:
    first_size = 16
    is_biased = False

    def __init__(self, task: Task, sampler: str, variant: str, threads: int):
        self.folder = tempfile.TemporaryDirectory()
        kind = "picture:" if task.kind == "picture" else "luminance:" if task.is_luminance else ""
        sensor = kind + "+".join(task.sensors)
        command = [sys.executable, HERE / "mitsuba_worker.py", exported(task, "mitsuba"), sensor, variant, sampler]
        environment = dict(os.environ, HOME=self.folder.name)  # no kernels of earlier runs
        environment.setdefault("DRJIT_LIBLLVM_PATH", LLVM)
        self.process = subprocess.Popen([str(word) for word in [*command, threads]], text=True, env=environment,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.load_s = self._answer()["load_s"]
        self.compile_s = self.memory_mb = 0.0

    def _answer(self) -> dict:
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("Mitsuba ended: its message is above")
        return json.loads(line)

    def run(self, size: int, seed: int) -> Run:
        file = Path(self.folder.name) / "values.npy"
        print(json.dumps({"samples": size, "seed": seed, "file": str(file)}), file=self.process.stdin, flush=True)
        answer = self._answer()
        self.compile_s, self.memory_mb = answer["compile_s"], answer["memory_mb"]
        return Run(np.load(file), answer["seconds"])

    def set_up_s(self) -> float:
        return self.load_s + self.compile_s

    def close(self) -> None:
        self.process.stdin.close()
        self.process.wait()
        self.folder.cleanup()
