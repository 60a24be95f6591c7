"""Runs on the workers of a cluster of Dask (docs/runs.md). Needs `pip install "stilb[distributed]"`."""

from __future__ import annotations

import logging
import math
import pickle
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Unpack, cast

from . import _stilb
from ._stilb import InputError
from ._wrong import require_scene, wrong_type
from .options import Limits, options
from .results import Result, warn_of
from .sums import Sums
from .tables import needed

if TYPE_CHECKING:
    import distributed

    from .scene import Scene

__all__ = ["measure"]

LIMITS = ("error", "time", "paths")


def measure(scene: Scene, client: distributed.Client, *, parts: int | None = None, sensors: Iterable[str] | None = None,
            progress: Callable[[Result], Any] | None = None, **limits: Unpack[Limits]) -> Result:
    """Measures on all workers of a cluster, for the numbers of `scene.measure`.

        with distributed.Client("scheduler:8786") as client:
            result = stilb.distributed.measure(scene, client, error=0.001)

    The samples are divided into parts, which the workers make and which are merged here. With `paths`, one round of parts
    makes so many samples: bit by bit the result of `scene.measure(paths=...)`. With `error`, each round of parts doubles the
    samples, until the error of all of them is reached; what has begun of the next round is then cancelled. The parts that a
    lost worker had are made again.

    parts     how many (default: as many as the workers have threads); a run has 32 strands, so that more have nothing to do
              (docs/runs.md)
    progress  a function that gets the `Result` after each round and may return False to end the run with it
    limits    as in other runs; `threads` are those of a part (default: 1, as workers count their own), and `time` does not
              apply
    """
    require_scene(scene)
    module = needed("distributed", 'pip install "stilb[distributed]"')
    if not isinstance(client, module.Client):
        raise wrong_type("client", client, 'a distributed.Client, such as distributed.Client("tcp://scheduler:8786")')
    if not (progress is None or callable(progress)):
        raise wrong_type("progress", progress, "a function that gets a stilb.Result")
    run = _Run(scene, client, scene._names(sensors), limits, parts)
    try:
        result = run.result(progress)
    finally:
        run.cancel()
    warn_of(result, 3)
    return result


# The tasks of the workers: functions of their arguments alone, so that they can be made again.

def _plan(scene: Scene, sensors: list[str], limits: Limits) -> bytes:
    """A state without samples, which has what all parts have in common."""
    state = _stilb.RunState()
    _stilb.plan_parts(scene._scene(), options(scene._scene(), limits), sensors, state)
    return state.bytes()


def _is_unexpected(record: logging.LogRecord) -> bool:
    """Whether a worker's log needs this record. A worker that is closed while it computes a cancelled part logs that, which
    is no fault."""
    message = record.getMessage()
    return not ("<Task cancelled" in message and "execute('_part-" in message)


def _part(scene: Scene, sensors: list[str], limits: Limits, part: int, parts: int, before: bytes) -> bytes:
    """The part with the samples of `limits`; `before`: its state with fewer of them, or that of the plan."""
    logging.getLogger("distributed.worker.state_machine").addFilter(_is_unexpected)
    state = _stilb.RunState.read(before, "part of a run")
    _stilb.measure_part(scene._scene(), options(scene._scene(), limits), sensors, part, parts, state)
    return state.bytes()


class _Run:
    def __init__(self, scene: Scene, client: distributed.Client, sensors: list[str], limits: Limits, parts: int | None) -> None:
        self._client = client
        self._parts = parts if parts is not None else max(1, sum(client.nthreads().values()))
        if self._parts < 1:
            raise InputError(f"parts: {parts} is not allowed. Allowed: 1 or more.")
        pickled = pickle.dumps(scene)
        chosen = options(scene._scene(), limits)
        if chosen.error is None and chosen.paths is None:
            raise InputError("a run on a cluster needs a limit that does not depend on its speed: error or paths.")
        self._error, self._paths = chosen.error, chosen.paths
        own = {key: value for key, value in limits.items() if key not in LIMITS}
        self._limits = {"threads": 1, **own}
        # The scene as workers have it, so that states fit.
        self._sums = Sums(pickle.loads(pickled), sensors, cast(Limits, own | {"paths": 1}))
        self._scene = client.submit(pickle.loads, pickled, pure=False)
        # Enough samples for all that a plan needs: parts of a run by its error have no number of their own yet.
        planning = self._asking(self._paths or 1 << 30)
        self._plan = client.submit(_plan, self._scene, sensors, planning, pure=False)
        self._made: list[distributed.Future] = [self._plan] * self._parts

    def _asking(self, paths: int) -> Limits:
        return cast(Limits, {**self._limits, "paths": paths})

    def _submit(self, paths: int) -> None:
        """Another round: each part goes on from its last state."""
        self._made = [self._client.submit(_part, self._scene, self._sums.sensors, self._asking(paths), part, self._parts,
                                          before, priority=-paths, pure=False)
                      for part, before in enumerate(self._made)]

    def result(self, progress: Callable[[Result], Any] | None) -> Result:
        plan = _stilb.RunState.read(self._plan.result(), "plan of a run")
        paths = self._next(plan, 0)
        self._submit(paths)
        last = math.inf  # the error of one sample, by that of the last round
        while True:
            futures = self._made
            following = self._next(plan, paths)
            is_ahead = following > paths and self._error is not None and last / math.sqrt(paths) > self._error
            if is_ahead:
                self._submit(following)  # while this round ends, idle workers begin the next one
            result = self._merged(plan, futures)
            is_over = following == paths or (self._error is not None and result.error <= self._error)
            if (progress and progress(result) is False) or is_over:
                return result
            if not is_ahead:
                self._submit(following)
            last, paths = result.error * math.sqrt(paths), following

    def _next(self, plan: _stilb.RunState, paths: int) -> int:
        """The samples of the next round: at an error estimate of the run in one process, twice as many."""
        if self._error is None:
            assert self._paths is not None
            return self._paths
        following = plan.samples_at_next_check(max(0, 2 * paths - 1))
        return following if self._paths is None else min(self._paths, following)

    def _merged(self, plan: _stilb.RunState, futures: list[distributed.Future]) -> Result:
        from distributed import as_completed

        state = plan.copy()
        for _, part in as_completed(futures, with_results=True):
            state.merge(_stilb.RunState.read(part, "part of a run"))
        self._sums.state = state
        given = {"error": self._error} if self._error is not None else {"paths": state.samples()}
        self._sums.limits = cast(Limits, {**self._sums.limits, "paths": None, **given})
        return self._sums.result()

    def cancel(self) -> None:
        """What nobody waits for any more. Tasks that others depend on go with the last ones, and must not be cancelled by
        themselves: the scheduler then loses its client."""
        self._client.cancel(list(set(self._made)))
