#!/usr/bin/env python3
"""What passes a pane of ior 1.52 without absorption, by Mitsuba: as a polarised solid, and as `thindielectric`.

    venv/bin/python experiments/crosscheck/polarised_pane.py
"""

import mitsuba as mi
import numpy as np

IOR = {"int_ior": 1.52, "ext_ior": 1.0}
SAMPLES = 1 << 22


def transmittance(pane: dict, angle: float) -> tuple[float, float]:
    """Mean and standard error of the luminance of a lamp of 1 behind the pane."""
    lamp = {"type": "rectangle", "to_world": mi.ScalarTransform4f().translate([0, 0, -0.1]).scale(100.0)}
    lamp["emitter"] = {"type": "area", "radiance": 1.0}
    lamp["bsdf"] = {"type": "diffuse", "reflectance": 0.0}
    scene = mi.load_dict({"type": "scene", "pane": pane, "lamp": lamp})
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(1, SAMPLES)
    towards_pane = mi.Vector3f(float(np.sin(angle)), 0, float(-np.cos(angle)))
    ray = mi.RayDifferential3f(-towards_pane, towards_pane)
    luminance = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 100}).sample(scene, sampler, ray)[0]
    values = np.array(luminance).reshape(-1, SAMPLES)[0]  # of a Stokes vector: its first component
    return float(values.mean()), float(values.std() / np.sqrt(SAMPLES))


def main() -> None:
    print("| angle | polarised solid | thindielectric |\n|---|---|---|")
    for degrees in (0, 45, 60, 75, 85):
        cells = []
        for variant, kind in (("llvm_ad_mono_polarized", "dielectric"), ("llvm_ad_mono", "thindielectric")):
            mi.set_variant(variant)
            shape = "cube" if kind == "dielectric" else "rectangle"
            size = mi.ScalarTransform4f().scale([50, 50, 1e-3])
            pane = {"type": shape, "to_world": size, "bsdf": {"type": kind, **IOR}}
            cells.append("{:.4f} ± {:.4f}".format(*transmittance(pane, np.radians(degrees))))
        print(f"| {degrees}° | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
