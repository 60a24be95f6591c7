"""Runs that are followed, saved, continued and merged (docs/runs.md)."""

from __future__ import annotations

import copy
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Unpack, cast

from . import _stilb
from ._stilb import Cancelled, InputError
from ._wrong import wrong_type
from .options import Limits, options
from .progress import Progress, Sink, called
from .results import Result, warn_of

if TYPE_CHECKING:
    from .sums import Sums

__all__ = ["ResumableRun", "merge", "resume"]

LIMITS = ("error", "time", "paths")
DEFAULT_TIME_S = 60.0  # of runs without any limit


class ResumableRun:
    """A run of `scene.measure` that can be followed, saved and continued: `help(stilb.Scene.start)`.

    Its numbers are those of a run in one go, bit by bit, however often it is left and continued. It can be copied and
    pickled. The scene is that of the moment when the run began.
    """

    def __init__(self, sums: Sums, progress: Progress = None) -> None:
        self._sums = sums
        self._progress = progress
        self._result: Result | None = None
        self._is_ended = False  # by the function of progress

    @property
    def samples(self) -> int:
        """The number of samples so far, as `paths` of results."""
        return self._sums.state.samples()

    @property
    def seeds(self) -> list[int]:
        """The seeds whose samples are among them: several after `stilb.merge`."""
        return list(self._sums.seeds())

    @property
    def result(self) -> Result | None:
        """The result so far; None before there are samples."""
        if self._result is None and self.samples:
            self._result = self._sums.result()
        return self._result

    def __iter__(self) -> Iterator[Result]:
        """The result after each error estimate, until the limits are met. Leaving the loop keeps what there is."""
        chosen = self._sums.options()
        limit, before = chosen.time, self._sums.state.elapsed_s()
        if chosen.error is None and chosen.paths is None and limit is None:
            limit = DEFAULT_TIME_S  # each step has it, too
        while True:
            try:
                result = self._measured(chosen, True, self._progress)
            except Cancelled:
                if self.result is None:
                    raise
                return  # the time was over before more samples
            yield result
            spent = self._sums.state.elapsed_s() - before
            if result.stopped != "interrupted" or self._is_ended or (limit is not None and spent >= limit):
                warn_of(result, 3)
                return
            if chosen.time is not None and limit is not None:
                chosen.time = max(0.001, limit - spent)

    def finish(self, *, progress: Progress = None, **limits: Unpack[Limits]) -> Result:
        """Goes on to the end, and returns the result. `error`, `time` and `paths`: other limits, in place of those that the
        run had. They count all samples; a time limit that of this call."""
        if any(limits.get(key) is not None for key in LIMITS):
            kept = {key: value for key, value in self._sums.limits.items() if key not in LIMITS}
            self._sums.limits = cast(Limits, kept)
        given = cast(Limits, {**self._sums.limits, **limits})
        options(self._sums.built(), given)  # for its messages
        self._sums.limits = given
        result = self._run_on(progress or self._progress)
        warn_of(result, 3)
        return result

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the state of the run in one step: `stilb.resume(path)` goes on from it, and so do the commands `stilb
        resume`, `stilb merge` and `stilb info` (docs/runs.md).

        The file names that of the scene. A scene that was built in code, or changed, is written beside it: hall.toml beside
        hall.run.
        """
        from . import state_files

        state_files.write(self._sums, path)

    def __repr__(self) -> str:
        return f"<stilb.ResumableRun of {self._sums.scene.name!r}: {self.samples} samples of seed " \
               f"{', '.join(map(str, self.seeds))}>"

    def __copy__(self) -> ResumableRun:
        return copy.deepcopy(self)

    def __getstate__(self) -> dict[str, object]:
        progress = self._progress if isinstance(self._progress, bool) else None
        return {**self.__dict__, "_result": None, "_progress": progress}

    def _run_on(self, progress: Progress) -> Result:
        return self._measured(self._sums.options(), False, progress)

    def _measured(self, chosen: _stilb.Options, to_next_check: bool, progress: Progress) -> Result:
        own = self._sums
        if len(self.seeds) > 1:
            raise InputError("this run is merged from runs of several seeds, and cannot go on. Make a run with another seed, and "
                             "merge it.")
        self._result = None  # also where an exception ends this, but keeps samples
        self._is_ended = False

        def watched(sink: Sink | None) -> Sink | None:
            return sink and (lambda report: self._noted(sink(report)))

        self._result = called(
            progress, lambda sink: _stilb.measure_state(own.built(), chosen, own.sensors, own.state, to_next_check,
                                                        watched(sink)), own.wrapped)
        return self._result

    def _noted(self, answer: object) -> object:
        """Of the function of progress: `False` ends the run, and not only its step."""
        self._is_ended = self._is_ended or answer is False
        return answer


def resume(path: str | os.PathLike[str]) -> ResumableRun:
    """The run of a state file, which `ResumableRun.save` or `stilb measure --state` wrote: it knows its scene and options.

        result = stilb.resume("hall.run").finish(error=0.0005)
    """
    from . import state_files

    return ResumableRun(state_files.read(path))


def merge(runs: Iterable[ResumableRun | Result | str | os.PathLike[str]]) -> ResumableRun:
    """The parts of a run, or runs of several seeds, together: runs, names of state files, and results that have kept their
    sums (those that can be dimmed).

        result = stilb.merge(["part1.run", "part2.run"]).result

    Scene, sensors, options and technique must be the same. The same part or seed twice is refused.
    """
    if isinstance(runs, str | os.PathLike | Mapping | ResumableRun) or not isinstance(runs, Iterable):
        raise wrong_type("runs", runs, 'a list of runs and names of state files, such as stilb.merge([run, "b.run"])')
    named = [_sums_of(run, number) for number, run in enumerate(runs, 1)]
    if not named:
        raise InputError("there is nothing to merge: the list is empty.")
    # The parts of each seed first: the sums of several seeds take no further part of one of them.
    by_seed: dict[tuple[int, ...], tuple[str, Sums]] = {}
    for name, sums in named:
        seeds = tuple(sums.state.seeds())
        if seeds in by_seed:
            _together(by_seed[seeds], (name, sums))
        else:
            by_seed[seeds] = (name, sums.copy())
    (first_name, merged), *others = by_seed.values()
    for other in others:
        _together((first_name, merged), other)
    if not merged.state.samples():
        raise InputError("there is nothing to merge: the runs have no samples.")
    return ResumableRun(merged)


def _together(merged: tuple[str, Sums], other: tuple[str, Sums]) -> None:
    """Adds the other sums to the first ones. Both have their names, for messages."""
    (merged_name, into), (name, sums) = merged, other
    try:
        into.state.merge(_in_form_of(into, sums).state)
    except InputError as error:
        text = str(error).removeprefix("state of a run: ")
        raise InputError(f"{name} cannot be merged with {merged_name}: {text}") from None


def _sums_of(run: ResumableRun | Result | str | os.PathLike[str], number: int) -> tuple[str, Sums]:
    """With its name, for messages."""
    if isinstance(run, Result):
        return f"result {number}", _kept_sums(run, number)
    if isinstance(run, str | os.PathLike):
        return str(run), resume(run)._sums
    if not isinstance(run, ResumableRun):
        raise wrong_type(f"run {number}", run, "runs, names of state files, and results that can be dimmed")
    if not run._sums.state.has_begun():
        raise InputError(f"run {number} has not begun, and has nothing to merge. Make its samples first: run.finish().")
    return f"run {number}", run._sums


def _kept_sums(result: Result, number: int) -> Sums:
    if result._is_dimmed:
        raise InputError(f"result {number} is a dimmed one. Merge the results that were dimmed, and dim what is merged.")
    if result._sums is None:
        raise InputError(f"result {number} has not kept its sums, which merging takes. Keep the run: run = scene.start(...), "
                         "run.finish(), and merge the runs.")
    return result._sums


def _in_form_of(first: Sums, other: Sums) -> Sums:
    """The same run, also where only one of the two scenes is that of a file, as after pickling."""
    from .state_files import text_of

    is_file = [bool(sums.built().path().name) for sums in (first, other)]
    if is_file[0] == is_file[1] or text_of(first.scene) != text_of(other.scene):
        return other
    return other.adopted_by(first.scene)
