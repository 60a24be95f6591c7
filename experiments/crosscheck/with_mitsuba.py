"""Illuminances and luminances by Mitsuba 3 (package `mitsuba`).

Mitsuba has no units: whatever goes in as radiance comes out as irradiance. Luminances [cd/m2] in, lux out.
Emitters are given as "rgb" in an RGB variant; a spectral variant would multiply them by the illuminant D65.
"""

import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

import drjit as dr  # noqa: E402

from rays import BATCHES, Rays, until  # noqa: E402
from scene import LUMINANCE_WEIGHTS, Rectangle, Scene, Sphere, Surface  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "src/io/export/mitsuba"))
import stilb_plugins  # noqa: E402, F401: the BRDFs that Mitsuba lacks

RAYS_AT_ONCE = 1 << 18
POLISHED = 0.01  # roughness up to which Mitsuba's own metal and (smooth) plastic will do
PATH_TRACER = {"type": "path", "max_depth": -1, "rr_depth": 8}


def illuminance(scene: Scene, positions: np.ndarray, normals: np.ndarray, error: float):
    """Values and standard errors [lx] at n x 3 points; stops when all relative errors are below `error`."""
    if _is_beyond_mitsuba(scene):
        return None
    world, integrator = _build(scene), mi.load_dict(PATH_TRACER)
    size = max(1, RAYS_AT_ONCE // len(positions))

    def batch(seed: int) -> np.ndarray:
        return _illuminance_batch(world, integrator, positions, normals, size, seed)

    return until(error, _each(batch), np.max)


def luminance(scene: Scene, rays: Rays, error: float):
    """The same for luminances [cd/m2], stopped by the mean relative error."""
    if _is_beyond_mitsuba(scene):
        return None
    world, integrator = _build(scene), mi.load_dict(PATH_TRACER)

    def batch(seed: int) -> np.ndarray:
        origins, directions = rays.draw(seed, max(1, RAYS_AT_ONCE // rays.count))
        size = origins.shape[1]
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, rays.count * size)
        ray = mi.RayDifferential3f(mi.Point3f(_columns(origins)), mi.Vector3f(_columns(directions)))
        radiance = integrator.sample(world, sampler, ray)[0]
        return LUMINANCE_WEIGHTS @ np.array(radiance).reshape(3, rays.count, size).mean(axis=2)

    return until(error, _each(batch))


def _each(batch):
    return lambda first: [batch(seed) for seed in range(first, first + BATCHES)]


def _columns(vectors: np.ndarray) -> np.ndarray:
    return vectors.reshape(-1, 3).T.astype(np.float32)


def _is_beyond_mitsuba(scene: Scene) -> bool:
    """It has no luminaire files, no panes that absorb, and no translucent or frosted sheets."""
    return bool(scene.luminaires) or any(
        s.material.get("internal_transmittance", 1) < 1 or s.material["type"] == "translucent" or s.material.get("thin")
        for s in scene.surfaces
    )


def _illuminance_batch(world, integrator, positions, normals, size: int, seed: int) -> np.ndarray:
    """Mean illuminance of `size` samples a point."""
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, size * len(positions))
    here = dr.zeros(mi.SurfaceInteraction3f, size * len(positions))
    here.p = mi.Point3f(np.repeat(positions, size, axis=0).T)
    here.n = mi.Normal3f(np.repeat(normals, size, axis=0).T)
    frame = mi.Frame3f(here.n)

    # Light that arrives directly, by Mitsuba's sampling of its emitters ...
    towards, weight = world.sample_emitter_direction(here, sampler.next_2d())
    total = weight * dr.maximum(dr.dot(towards.d, here.n), 0)

    # ... and what its path tracer sees over the hemisphere, less the emitters seen directly.
    direction = frame.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
    ray = here.spawn_ray(direction)
    radiance = integrator.sample(world, sampler, mi.RayDifferential3f(ray))[0]
    first = world.ray_intersect(ray)
    emitted = first.emitter(world).eval(first)
    total += dr.pi * (radiance - emitted)

    rgb = np.array(total).reshape(3, len(positions), size).mean(axis=2)
    return LUMINANCE_WEIGHTS @ rgb


def _build(scene: Scene):
    parts = {"type": "scene"}
    for i, surface in enumerate(scene.surfaces):
        parts[f"surface{i}"] = _shape(surface)
    for i, light in enumerate(scene.points):
        intensity = {"type": "rgb", "value": light.intensity.tolist()}
        parts[f"point{i}"] = {"type": "point", "position": light.position.tolist(), "intensity": intensity}
    return mi.load_dict(parts)


def _shape(surface: Surface):
    shape = surface.shape
    extra = {"bsdf": _bsdf(surface.material)}
    if surface.luminance is not None:
        extra["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": surface.luminance.tolist()}}
    if isinstance(shape, Rectangle):
        u, v = shape.edge_u / 2, shape.edge_v / 2
        normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        matrix = np.eye(4)
        matrix[:3] = np.column_stack([u, v, normal, shape.corner + u + v])
        return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix), **extra}
    if isinstance(shape, Sphere):
        return {"type": "sphere", "center": shape.center.tolist(), "radius": shape.radius, **extra}
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(extra["bsdf"])
    mesh = mi.Mesh("triangles", len(shape.vertices), len(shape.faces), props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = shape.vertices.astype(np.float32).ravel()
    parameters["faces"] = shape.faces.astype(np.uint32).ravel()
    parameters.update()
    return mesh


def _bsdf(material: dict) -> dict:
    def rgb(key):
        return {"type": "rgb", "value": material[key].tolist()}

    if material["type"] == "mirror":
        inner = {"type": "conductor", "material": "none", "specular_reflectance": rgb("reflectance")}
    elif material["type"] == "diffuse":
        inner = {"type": "diffuse", "reflectance": rgb("reflectance")}
    elif material["type"] == "phong":
        inner = {"type": "stilb_phong", "diffuse": rgb("diffuse"), "specular": rgb("specular")}
        inner["exponent"] = float(material["exponent"])
    elif material["type"] == "rough" and material["roughness"] <= POLISHED:
        inner = {"type": "roughconductor", "material": "none", "specular_reflectance": rgb("reflectance")}
        inner |= {"distribution": "ggx", "alpha": material["roughness"]}
    elif material["type"] == "plastic" and material["roughness"] <= POLISHED:
        inner = {"type": "plastic", "diffuse_reflectance": rgb("diffuse"), "nonlinear": True}
        inner |= {"int_ior": material["ior"], "ext_ior": 1.0}
    elif material["type"] in ("rough", "plastic"):
        color = rgb("reflectance" if material["type"] == "rough" else "diffuse")
        inner = {"type": "stilb_ggx", "color": color, "roughness": material["roughness"]}
        inner["ior"] = float(material.get("ior", 0))
    elif material["type"] == "frosted":
        kind = {"type": "roughdielectric", "distribution": "ggx", "alpha": material["roughness"]}
        return kind | {"int_ior": material["ior"], "ext_ior": 1.0}
    elif material["type"] in ("glass", "pane"):
        kind = "dielectric" if material["type"] == "glass" else "thindielectric"
        return {"type": kind, "int_ior": material["ior"], "ext_ior": 1.0}
    else:
        inner = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}}
    return {"type": "twosided", "bsdf": inner}
