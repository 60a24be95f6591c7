"""The tasks: scenes, their sensors, and the errors to reach."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


@dataclass(frozen=True)
class Task:
    scene: str
    sensors: tuple[str, ...]  # of the scene file, measured together
    kind: str  # "grid", "picture" or "readings"
    targets: tuple[float, ...]  # rms errors, relative

    @property
    def name(self) -> str:
        return f"{self.scene} {'+'.join(self.sensors)}"

    @property
    def path(self) -> Path:
        folder = ROOT / "scenes/office" if self.scene == "office" else HERE / "scenes"
        return folder / f"{self.scene}.toml"

    @property
    def overrides(self) -> list[str]:
        """Flags of stilb: Mitsuba has no luminaires with an opening, so that all programs take them as points."""
        return ["--set", "defaults.lights.opening=point"] if self.scene in ("office", "hall") else []

    @property
    def sensor(self) -> dict:
        """The table of the first sensor."""
        return tomllib.loads(self.path.read_text())["sensors"][self.sensors[0]]

    @property
    def is_luminance(self) -> bool:
        return self.sensor["type"] == "luminance"

    @property
    def seeds(self) -> int:
        return {"grid": 4, "picture": 3, "readings": 32}[self.kind]


def grid(scene: str, *sensors: str) -> Task:
    return Task(scene, sensors, "grid", (0.01, 0.003))


def picture(scene: str, sensor: str) -> Task:
    return Task(scene, (sensor,), "picture", (0.02,))


def readings(scene: str) -> list[Task]:
    return [Task(scene, (sensor,), "readings", (0.01,)) for sensor in ("one", "four", "sixteen")]


TASKS = [
    grid("room", "grid"),
    picture("room", "view"),
    *readings("room"),
    grid("cube", "grid"),
    grid("office", "desk_a", "desk_b"),
    picture("office", "room"),
    grid("hall", "grid"),
    grid("door", "grid"),
    picture("door", "view"),
    picture("showroom", "view"),
    *readings("showroom"),
]
