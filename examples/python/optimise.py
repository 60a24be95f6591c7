"""Where do four ceiling panels light a room most uniformly? A search that accepts a step only where it is certain.

    python optimise.py --paths 1024 --least-step 0.02

The panels stand symmetrically about the middle of the room. The search tries a step in each direction and takes the best
one whose gain is more than its error; where there is none, it halves the step. All layouts have the same random numbers,
and the gain is the difference of two runs, replicate by replicate, which is known better than either uniformity. At the end,
another seed checks the best layout, since the best of many noisy values is too good.
"""

import argparse

import stilb

MIDDLE = (3.0, 2.0)
PANEL = 0.6  # its edge [m]
CORNERS = [(1, 1), (-1, 1), (1, -1), (-1, -1)]


def office() -> stilb.Scene:
    scene = stilb.Scene("office with four panels")
    scene.materials["wall"] = stilb.Diffuse(reflectance=0.6)
    scene.materials["black"] = stilb.Black()
    scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(6, 4, 2.8), material="wall")
    for number in range(len(CORNERS)):
        scene.objects[f"panel {number}"] = stilb.Rectangle(corner=(0, 0, 2.79), edge_u=(0, PANEL, 0), edge_v=(PANEL, 0, 0),
                                                           material="black")
        scene.lights[f"panel {number}"] = stilb.AreaLight(object=f"panel {number}", flux=3000)
    scene.sensors["task"] = stilb.Grid(corner=(0.5, 0.5, 0.75), edge_u=(5, 0, 0), edge_v=(0, 3, 0), count=(10, 6))
    return scene


def measured(scene: stilb.Scene, layout: tuple[float, float], paths: float, seed: int = 1) -> stilb.Result:
    """With the middles of the panels at these distances [m] from the middle of the room."""
    for number, (side_x, side_y) in enumerate(CORNERS):
        scene.objects[f"panel {number}"].corner = (MIDDLE[0] + side_x * layout[0] - PANEL / 2,
                                                   MIDDLE[1] + side_y * layout[1] - PANEL / 2, 2.79)
    return scene.measure(paths=paths, method="path", seed=seed)


def gain(after: stilb.Result, before: stilb.Result) -> stilb.Estimate:
    return stilb.paired(after, before)["task"].uniformity


def described(layout: tuple[float, float]) -> str:
    return f"panels {layout[0]:.2f} m and {layout[1]:.2f} m from the middle"


def is_inside(layout: tuple[float, float]) -> bool:
    return all(PANEL / 2 <= distance <= middle - PANEL / 2 for distance, middle in zip(layout, MIDDLE))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--paths", type=float, default=256, help="of each reading in each run (256)")
    parser.add_argument("--step", type=float, default=0.4, help="the first one [m] (0.4)")
    parser.add_argument("--least-step", type=float, default=0.1, help="the last one [m] (0.1)")
    arguments = parser.parse_args()

    scene, start, step = office(), (1.0, 0.7), arguments.step
    layout, best = start, measured(scene, start, arguments.paths)
    print(f"start        {described(layout)}: uniformity {best['task'].uniformity}")
    while step > arguments.least_step * 0.999:
        x, y = layout
        around = [(x + step, y), (x - step, y), (x, y + step), (x, y - step)]
        trials = {trial: measured(scene, trial, arguments.paths) for trial in around if is_inside(trial)}
        gains = {trial: gain(result, best) for trial, result in trials.items()}
        better = [trial for trial in gains if gains[trial].interval[0] > 0]
        if better:
            layout = max(better, key=lambda trial: gains[trial].value)
            best = trials[layout]
            print(f"step {step:.2f} m  {described(layout)}: {gains[layout]} more uniform")
        else:
            print(f"step {step:.2f} m  none is better for certain")
            step /= 2

    checked, was = (measured(scene, place, 4 * arguments.paths, seed=2) for place in (layout, start))
    print(f"Found: {described(layout)}, uniformity {best['task'].uniformity}")
    print(f"With another seed: {checked['task'].uniformity}, {gain(checked, was)} more than at the start")


if __name__ == "__main__":
    main()
