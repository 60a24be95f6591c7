"""Mitsuba 3 as a process of its own: measures one sensor of an exported scene as often as it is asked.

    mitsuba_worker.py FOLDER SENSOR VARIANT SAMPLER THREADS

SENSOR is names of sensors with "+" between them, after "luminance:" or "picture:" where they are not illuminances.
Reads lines {"samples": n, "seed": s, "file": path} from standard input; writes an array of values to the file and
a line {"seconds": processor time, "compile_s": the same of a first launch, "memory_mb": peak} to standard output.
The first line that it writes is {"load_s": processor time until the scene was loaded}.

Grids and points: launches of measure.illuminance() or luminance(); pictures: mi.render(). A launch has at most
LANE samples at all points together, and all launches of a run are equal, so that one compiled kernel serves all.
"""

import json
import resource
import sys
import time

import numpy as np

import mitsuba as mi

FOLDER, SENSOR, VARIANT, SAMPLER, THREADS = sys.argv[1:]
LANE = 1 << 23
mi.set_variant(VARIANT)
mi.set_log_level(mi.LogLevel.Error)  # standard output is for answers

import drjit as dr  # noqa: E402

dr.set_thread_count(int(THREADS))
sys.path.insert(0, FOLDER)
import measure  # noqa: E402

SCENE = measure.load(FOLDER, SAMPLER)
INTEGRATOR = mi.load_dict(measure.PATH_TRACER)


def sampler_for(samples: int, seed: int, points: int):
    sampler = mi.load_dict({"type": SAMPLER, "sample_count": samples})
    sampler.set_sample_count(samples)
    sampler.set_samples_per_wavefront(sampler.sample_count())
    sampler.seed(seed, sampler.sample_count() * points)
    return sampler


def rounded(samples: int) -> int:
    """As many as the sampler makes instead of these: some need squares or primes."""
    return mi.load_dict({"type": SAMPLER, "sample_count": samples}).sample_count()


class Points:
    """Illuminances or luminances."""

    def __init__(self, name: str):
        self.is_luminance = name.startswith("luminance:")
        parts = [measure.read_points(f"{FOLDER}/{part}.pts") for part in name.split(":")[-1].split("+")]
        self.positions, self.directions = (np.concatenate(vectors) for vectors in zip(*parts))
        self.count = len(self.positions)
        flags = [emitter.flags() for emitter in SCENE.emitters()]
        self.has_points_only = all(mi.has_flag(flag, mi.EmitterFlags.DeltaPosition) for flag in flags)

    def launch(self, samples: int, seed: int) -> np.ndarray:
        sampler = sampler_for(samples, seed, self.count)
        ends = self.positions, self.directions
        if self.is_luminance:
            return measure.luminance(SCENE, INTEGRATOR, *ends, samples, sampler)
        return measure.illuminance(SCENE, INTEGRATOR, *ends, samples, sampler, not self.has_points_only)

    def constant(self) -> np.ndarray | float:
        """Compute the direct light of all point sources, which needs no samples."""
        if self.is_luminance or not self.has_points_only:
            return 0.0
        return measure.direct_illuminance(SCENE, self.positions, self.directions)


class Picture:
    def __init__(self, name: str):
        self.sensor = next(s for s in SCENE.sensors() if s.id() == name)
        self.count = int(np.prod(self.sensor.film().size()))

    def launch(self, samples: int, seed: int) -> np.ndarray:
        image = mi.render(SCENE, sensor=self.sensor, integrator=INTEGRATOR, seed=seed, spp=samples)
        channels = np.array(image, dtype=float)
        return (channels @ measure.WEIGHTS if channels.shape[2] == 3 else channels[:, :, 0]).ravel()

    def constant(self) -> float:
        return 0.0


def run(task, samples: int, seed: int) -> np.ndarray:
    launches = -(-samples * task.count // LANE)
    each = rounded(-(-samples // launches))
    total = sum(task.launch(each, 1000003 * seed + k) for k in range(launches))
    return total / launches + task.constant()


def first_launch(task, samples: int) -> float:
    """The processor time of a launch that may have to compile, beyond that of one that does not."""
    launches = -(-samples * task.count // LANE)
    each = rounded(-(-samples // launches))
    times = []
    for seed in (1, 2):
        start = time.process_time()
        task.launch(each, seed)
        task.constant()
        times.append(time.process_time() - start)
    return max(times[0] - times[1], 0.0)


def main() -> None:
    task = Picture(SENSOR.split(":")[1]) if SENSOR.startswith("picture:") else Points(SENSOR)
    print(json.dumps({"load_s": time.process_time()}), flush=True)
    compiled: dict[int, float] = {}
    for line in sys.stdin:
        order = json.loads(line)
        samples = order["samples"]
        if samples not in compiled:
            compiled[samples] = first_launch(task, samples)
        start = time.process_time()
        values = run(task, samples, order["seed"])
        seconds = time.process_time() - start
        np.save(order["file"], values)
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(json.dumps({"seconds": seconds, "compile_s": max(compiled.values()), "memory_mb": memory}), flush=True)


main()
