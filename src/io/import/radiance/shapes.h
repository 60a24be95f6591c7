// Shapes of Radiance's surfaces. Cylinders, cones and annuli become meshes, because Stilb has no such shapes.
#pragma once

#include <optional>
#include <span>

#include "geometry/shape.h"
#include "io/import/radiance/description.h"
#include "io/mesh/mesh_file.h"

namespace stilb::io::radiance {

/// A sphere or a disk as such; nothing for other kinds: bubbles, whose inside is their front, become meshes.
std::optional<Shape> simple_shape(SurfaceKind kind, std::span<const double> numbers);

/// Adds the triangles of a flat surface: a polygon, or a ring.
void add_flat(SurfaceKind kind, std::span<const double> numbers, MeshBuilder& builder);
/// Adds the triangles of a curved surface or of a compiled mesh, with the normals of the surface itself. The
/// area of cylinders, cones and bubbles is that of the surface itself.
void add_smooth(SurfaceKind kind, std::span<const double> numbers, MeshBuilder& builder);
inline bool is_flat(SurfaceKind kind) { return kind == SurfaceKind::polygon || kind == SurfaceKind::ring; }

/// The parallelogram that a mesh of one face is; nothing where it is none.
std::optional<Rectangle> parallelogram_of(const Mesh& mesh);

}  // namespace stilb::io::radiance
