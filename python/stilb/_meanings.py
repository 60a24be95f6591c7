"""The meaning, unit and default of each key of parts, for the docstrings of their classes. docs/scene-format.md says more.

python/make_stubs.py uses it, too, without the package. A test compares the keys with those of the scene reader.
"""

KINDS = {
    "materials": {
        "diffuse": "A surface that reflects equally in all directions.",
        "phong": "A diffuse surface with a lobe about the mirror direction.",
        "rough": "A rough metal: GGX with multiple reflection.",
        "ward": "A diffuse surface with Ward's anisotropic gloss.",
        "plastic": "A clear coat over a diffuse base.",
        "mirror": "A perfect mirror.",
        "glass": "The surface of a solid of clear glass.",
        "pane": "A thin sheet of clear glass.",
        "glazing": "A pane, or several, by the shares of a data sheet.",
        "translucent": "A thin sheet that scatters the light that it lets through.",
        "fabric": "A woven shade, by its product sheet.",
        "frosted": "Glass with rough faces: the surface of a solid, or a thin sheet.",
        "black": "A surface that reflects nothing.",
    },
    "objects": {
        "mesh": "Triangles of a file, or of arrays.",
        "rectangle": "A parallelogram; its front is edge_u x edge_v.",
        "box": "A box parallel to the axes; its front is outside.",
        "sphere": "A sphere; its front is outside.",
        "disk": "A disk; its front is where the normal points.",
        "polygons": "Plane polygons, each with a front from which its corners run counterclockwise.",
        "harmonics": "A star-shaped body by a series of spherical harmonics.",
    },
    "lights": {
        "point": "A point that shines equally in all directions.",
        "area": "The front of an object, or of some of its faces, as a diffuse emitter.",
        "sphere": "A luminous sphere.",
        "photometry": "A luminaire of an IES or EULUMDAT file.",
        "environment": "Light from infinity around the scene.",
    },
    "sensors": {
        "illuminance": "Illuminance at points [lx].",
        "grid": "Illuminance at the centres of the cells of a parallelogram [lx].",
        "area": "Illuminance on the raster of EN 12464-1 over an area [lx].",
        "cylindrical": "Mean illuminance of the sides of small upright cylinders [lx].",
        "semicylindrical": "Mean illuminance of the curved sides of small semicylinders [lx].",
        "hemispherical": "Mean illuminance of small hemispheres [lx].",
        "spherical": "Mean illuminance of small spheres [lx].",
        "luminance": "Luminance along lines of sight [cd/m2].",
        "goniometer": "Luminance of a point of a surface in many directions [cd/m2].",
        "ugr": "The Unified Glare Rating at an eye.",
        "dgp": "The Daylight Glare Probability at an eye.",
        "derived": "A formula of other sensors.",
        "camera": "A camera, for pictures.",
        "plane": "A working plane over the floor of each room, at once [lx].",
    },
}

# By section, or by section and type where a key means something else there.
KEYS = {
    "materials": {
        "reflectance": "share of the light that is reflected, 0 to 1, or (r, g, b)",
        "diffuse": "share that is reflected diffusely, 0 to 1, or (r, g, b)",
        "specular": "share in the lobe at normal incidence, 0 to 1, or (r, g, b)",
        "exponent": "of the lobe, 0 to 1e6: the higher, the narrower",
        "roughness": "alpha of GGX, about the slope of the facets, 0.001 to 1",
        "ior": "refractive index, 1 to 4",
        "back": "the material of the back, a dict: with a type, or the same with other values (default: no other)",
    },
    "materials.ward": {
        "roughness": "slopes (u, v) of the surface along its two axes, 0.001 to 1",
        "rotation": "of the axes [degrees], counterclockwise from where light arrives (default: 0)",
    },
    "materials.plastic": {"diffuse": "reflectance of the base without its coat, 0 to 1, or (r, g, b)"},
    "materials.pane": {
        "internal_transmittance": "share of the light that one passage along the normal leaves, without the faces, 0 to 1",
    },
    "materials.glazing": {
        "visible_transmittance": "share along the normal of one uncoated pane, 0 to 0.918, in place of the others",
        "transmittance": "share along the normal, 0 to 1, (r, g, b), or rows (degrees, share)",
        "reflectance": "of the front: share along the normal, 0 to 1, (r, g, b), or rows (degrees, share)",
        "back_reflectance": "of the back, likewise (default: as the front)",
    },
    "materials.translucent": {
        "transmittance": "share that is transmitted diffusely, 0 to 1, or (r, g, b)",
        "specular_transmittance": "share that passes straight, 0 to 1, or (r, g, b) (default: 0)",
    },
    "materials.fabric": {
        "openness": "share of the area that is holes, 0 to 1",
        "transmittance": "share along the normal that is transmitted, straight or scattered, 0 to 1, or (r, g, b)",
    },
    "materials.frosted": {
        "roughness": "alpha of GGX, of its faces, 0.001 to 1",
        "thin": "True of a sheet (default: False, the surface of a solid)",
    },
    "objects": {
        "material": "name of the material",
        "scale": "factor (default: 1)",
        "rotate": "(x, y, z, degrees): about this axis through the origin (default: none)",
        "translate": "(x, y, z) [m] (default: none)",
        "transform": "instead of these three: 16 numbers, row by row",
        "corner": "a corner (x, y, z) [m]",
        "edge_u": "edge from the corner (x, y, z) [m]",
        "edge_v": "other edge from the corner (x, y, z) [m]",
        "min": "the corner of the least coordinates (x, y, z) [m]",
        "max": "the corner of the largest coordinates (x, y, z) [m]",
        "center": "the middle (x, y, z) [m]",
        "radius": "[m]",
        "normal": "direction of the front, of any length",
        "vertices": "positions (n, 3) [m]",
        "faces": "indices of the vertices of each face, from 0",
    },
    "objects.mesh": {
        "file": "OBJ, PLY or glTF",
        "materials": "names of materials for parts of the file: {\"floor\": \"carpet\"}",
        "vertices": "instead of the file: positions (n, 3) [m]",
        "faces": "with vertices: (m, 3) indices of the vertices of each triangle, from 0",
    },
    "objects.harmonics": {
        "file": "a series that `stilb fit` computed, or",
        "coefficients": "(L + 1)^2 numbers [m], that of Y_lm at number l^2 + l + m",
        "center": "the centre (x, y, z) [m] (default: the file's, or the origin)",
        "degree": "last degree that is used (default: all)",
        "intersection": '"cells", "roots" or "march" (default: "cells")',
        "lod": "True: as many degrees as the sensors can resolve (default: False)",
    },
    "lights": {
        "position": "(x, y, z) [m]",
        "positions": "instead of one position: (n, 3) [m], as many lights",
        "array": "instead: {\"origin\", \"step_u\", \"step_v\", \"count\": (nu, nv)}, positions in rows [m]",
        "flux": "luminous flux of each light [lm]",
        "intensity": "instead of the flux: luminous intensity [cd]",
        "luminance": "instead of the flux: luminance [cd/m2]",
        "cct": "correlated colour temperature, 1000 to 25000 [K] (default: white)",
        "color": "instead of that: chromaticity (r, g, b)",
        "group": "lights of one group are dimmed together in solutions (default: the light's name)",
        "on": "False: no light, but the surfaces stay (default: True)",
        "maintenance": "maintenance factor, 0.001 to 1 (default: that of the section run, or 1)",
        "power": "electric power [W] (default: the luminaire file's, or unknown)",
        "dimming": "factor on the light (default: 1)",
    },
    "lights.area": {
        "object": "name of the object",
        "material": "only faces of this material (default: all faces)",
        "mesh_group": "only faces of this group of the mesh file (default: all faces)",
    },
    "lights.sphere": {"center": "the middle (x, y, z) [m]", "radius": "[m]"},
    "lights.photometry": {
        "file": "IES LM-63 or EULUMDAT",
        "opening": '(length, width[, height]) or diameter of the luminous opening [m], or "point" (default: the file\'s)',
        "geometry": "mesh file of the luminaire's body, or a dictionary of the keys of such an object (default: none)",
        "aim": "direction of the file's nadir (default: (0, 0, -1))",
        "spin": "turn about it [degrees] (default: 0)",
        "flux": "replaces the flux of the file [lm] (default: the file's)",
    },
    "lights.environment": {
        "luminance": "the same all around [cd/m2], or",
        "file": "a panorama, .hdr or .exr [cd/m2]",
        "up": "direction of its top edge (default: (0, 0, 1))",
        "rotation": "about up [degrees] (default: 0)",
    },
    "sensors": {
        "position": "(x, y, z) [m]",
        "points": "instead of one position: (n, 3) [m]",
        "positions": "the same as points",
        "array": "instead: {\"origin\", \"step_u\", \"step_v\", \"count\": (nu, nv)}, positions in rows [m]",
        "normal": "the side that receives light, a direction of any length",
        "direction": "viewing direction of any length, or",
        "target": "a point that is looked at (x, y, z) [m], or",
        "directions": "(m, 3): several directions from each position, or",
        "targets": "(m, 3) [m]: several targets",
        "require": "limits: {\"mean\": 500, \"uniformity\": 0.6} (default: none)",
        "corner": "a corner (x, y, z) [m]",
        "edge_u": "edge from the corner (x, y, z) [m]",
        "edge_v": "other edge from the corner (x, y, z) [m]",
    },
    "sensors.grid": {
        "positions": "instead of one corner: (n, 3) [m], as many grids",
        "count": "(nu, nv), cells along edge_u and edge_v",
        "normal": "the side that receives light (default: edge_u x edge_v)",
    },
    "sensors.area": {
        "corners": "(n, 3) [m] in one plane, or (n, 2) with height; or corner and edges, an object or a room",
        "height": "z of all corners [m]",
        "holes": "lists of corners inside of the outline (default: none)",
        "object": "instead of corners: name of the object whose faces are measured, or a list of names",
        "room": "instead: a point (x, y, z) [m] in the room that is meant",
        "part": 'of object or room: "walls", "ceiling", "floor" or "all" (default: "all")',
        "normal": "the side that receives light (default: upwards, or from where the corners run counterclockwise)",
        "spacing": "of the points [m] (default: that of EN 12464-1)",
        "surround": "width of a band around the area [m] (default: none)",
        "background": "width of a band around that [m] (default: none)",
    },
    "sensors.plane": {
        "object": "name of the object whose floors are meant, or a list of names (default: all rooms)",
        "polygon": "instead: corners (n, 3) [m] of a level floor without walls",
        "height": "above the floor [m] (default: 0.75)",
        "margin": "distance from the walls [m] (default: 0.5)",
        "spacing": 'of the points [m] (default: "auto", that of EN 12464-1)',
    },
    "sensors.semicylindrical": {"direction": "horizontal direction of the curved side"},
    "sensors.hemispherical": {"normal": "direction of the curved side"},
    "sensors.goniometer": {
        "point": "of a surface (x, y, z) [m]",
        "normal": "away from the surface",
        "plane": "azimuth of one plane [degrees] (default: the whole hemisphere)",
        "step": "between directions, 0.001 to 90 [degrees]",
    },
    "sensors.dgp": {"threshold": "luminance of a source of glare [cd/m2] (default: five times the mean of the view)"},
    "sensors.derived": {"value": 'formula of other sensors: "desk.mean / wall.mean"'},
    "sensors.camera": {
        "target": "point in the middle of the picture (x, y, z) [m]",
        "up": "upwards in the picture (default: (0, 0, 1))",
        "fov": "from the left edge to the right one [degrees] (default: 60; fisheye 180; panorama 360)",
        "resolution": "(width, height) [pixels]",
        "projection": '"perspective", "fisheye" or "panorama" (default: "perspective")',
        "filter": '"box" or "gaussian" over a pixel (default: "box")',
    },
}


def meaning(section: str, kind: str, key: str) -> str:
    """The meaning of a key, with its unit and default; empty where it is not known."""
    own = KEYS.get(f"{section}.{kind}", {})
    return own.get(key) or KEYS[section].get(key, "")


def docstring(section: str, kind: str, keys: list[str], indent: str = "    ") -> str:
    """The docstring of a class: what it is, and its keys."""
    width = max(map(len, keys), default=0)
    lines = [f"{indent}{key:{width}}  {meaning(section, kind, key)}" for key in keys]
    return "\n".join([KINDS[section].get(kind, ""), *([""] if lines else []), *lines])
