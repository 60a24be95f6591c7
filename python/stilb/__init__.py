"""Stilb: illuminance and luminance in rooms, with an error bar on every number.

    import stilb
    scene = stilb.load("office.toml")
    result = scene.measure(error=0.01)
    result["desk"].value, result["desk"].interval()

docs/python.md is the guide; `help(stilb.Scene)` lists what a scene can do.
"""

from . import distributed, exact, statistics
from ._stilb import Cancelled, InputError, Progress
from ._stilb import version as __version__
from .estimates import Estimate, ResultWarning
from .files import Fit, fit, read_points
from .pairs import Pair, PairedReading, paired
from .parts import *
from .parts import __all__ as _parts
from .results import Image, Reading, Result, Run
from .runs import ResumableRun, merge, resume
from .scene import Scene, Section, load
from .shares import Readings
from .solution import Solution, load_solution
from .sweep import sweep

__all__ = ["Cancelled", "Estimate", "Fit", "Image", "InputError", "Pair", "PairedReading", "Progress", "Reading", "Readings",
           "Result", "ResultWarning", "ResumableRun", "Run", "Scene", "Section", "Solution", "__version__", "distributed", "exact",
           "fit", "load", "load_solution", "merge", "paired", "read_points", "resume", "statistics", "sweep", *_parts]
