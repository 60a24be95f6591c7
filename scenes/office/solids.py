"""Closed solids as lists of triangles, each triangle three points (x, y, z) in metres.

Seen from outside a solid, the points of a triangle run counterclockwise. Solids that share a group in
the OBJ file must not touch: the points of a group are merged by their written coordinates.
"""

from math import cos, pi, sin


def loft(rings):
    """The skin over a sequence of rings, closed at both ends.

    Every ring has the same number of points (counterclockwise seen from the last ring), but the first
    and the last may be a single point. An end ring of several points is closed by a flat, convex polygon.
    """
    return skin(rings) + polygon(rings[0][::-1]) + polygon(rings[-1])


def skin(rings):
    """The same without the ends: an open piece."""
    triangles = []
    for lower, upper in zip(rings, rings[1:]):
        count = max(len(lower), len(upper))
        for k in range(count):
            here, there = k, (k + 1) % count
            if len(lower) > 1:
                triangles.append((lower[here], lower[there], upper[there % len(upper)]))
            if len(upper) > 1:
                triangles.append((lower[here % len(lower)], upper[there], upper[here]))
    return triangles


def polygon(points):
    """A flat convex polygon as a fan: one open piece, for shells that are put together from pieces."""
    return [(points[0], points[k], points[k + 1]) for k in range(1, len(points) - 1)]


def rectangle_ring(low, high, z):
    return [(low[0], low[1], z), (high[0], low[1], z), (high[0], high[1], z), (low[0], high[1], z)]


def box(low, high):
    return loft([rectangle_ring(low, high, low[2]), rectangle_ring(low, high, high[2])])


def tray(low, high, rim, depth):
    """A box with a rectangular recess in its upper face."""
    inner_low = (low[0] + rim, low[1] + rim)
    inner_high = (high[0] - rim, high[1] - rim)
    return loft([
        rectangle_ring(low, high, low[2]),
        rectangle_ring(low, high, high[2]),
        rectangle_ring(inner_low, inner_high, high[2]),
        rectangle_ring(inner_low, inner_high, high[2] - depth),
    ])


def lathe(profile, segments):
    """The profile [(radius, z), ...] turned about the z axis; it begins and ends on the axis."""
    def ring(radius, z):
        if radius == 0:
            return [(0.0, 0.0, z)]
        angles = [2 * pi * k / segments for k in range(segments)]
        return [(radius * cos(angle), radius * sin(angle), z) for angle in angles]

    return loft([ring(radius, z) for radius, z in profile])


def cylinder(radius, bottom, top, segments):
    return lathe([(0, bottom), (radius, bottom), (radius, top), (0, top)], segments)


def rounded_ring(width, depth, corner, steps, z):
    """A rectangle about the z axis with round corners of `steps` edges each."""
    points = []
    for quarter, (sx, sy) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        for k in range(steps + 1):
            angle = (quarter + k / steps) * pi / 2
            points.append((sx * (width / 2 - corner) + corner * cos(angle),
                           sy * (depth / 2 - corner) + corner * sin(angle), z))
    return points


def plate(width, depth, corner, bottom, top, steps=4):
    """A flat plate about the z axis with round corners and sharp edges."""
    return loft([rounded_ring(width, depth, corner, steps, z) for z in (bottom, top)])


def cushion(width, depth, thickness, corner, edge, steps=4, layers=3):
    """An upholstered plate about the origin: round corners, and edges rounded over the length `edge`."""
    rings = [[(0.0, 0.0, -thickness / 2)]]
    for k in range(2 * layers):
        angle = pi * (k + 0.5) / (2 * layers) - pi / 2
        inset = edge * (1 - cos(angle))
        rings.append(rounded_ring(width - 2 * inset, depth - 2 * inset, corner - inset, steps,
                                  thickness / 2 * sin(angle)))
    rings.append([(0.0, 0.0, thickness / 2)])
    return loft(rings)


def changed(solid, change):
    """The solid with `change` (point -> point) done to each of its points."""
    return [tuple(change(point) for point in triangle) for triangle in solid]


def moved(solid, dx, dy, dz=0.0):
    return changed(solid, lambda p: (p[0] + dx, p[1] + dy, p[2] + dz))


def turned(solid, degrees):
    """Turned counterclockwise about the z axis."""
    c, s = cosine_and_sine(degrees)
    return changed(solid, lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]))


def tilted(solid, degrees):
    """Turned counterclockwise about the x axis: by 90 degrees, what was up (+z) points to -y."""
    c, s = cosine_and_sine(degrees)
    return changed(solid, lambda p: (p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]))


def cosine_and_sine(degrees):
    """Exact at quarter turns, so that turned boxes stay parallel to the axes."""
    quarters = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}
    angle = degrees % 360
    return quarters.get(angle) or (cos(angle * pi / 180), sin(angle * pi / 180))
