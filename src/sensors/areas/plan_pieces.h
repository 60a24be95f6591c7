// Regions on a plan, by Clipper: unions, differences, and regions at a distance from others.
#pragma once

#include <polyclipping/clipper.hpp>
#include <vector>

#include "base/vec.h"

namespace stilb::sensors {

using ClipperLib::Paths, ClipperLib::Path;

/// Clipper computes with whole numbers: of 10 micrometres.
inline constexpr double kUnits_per_m = 1e5;

ClipperLib::IntPoint to_units(const Vec3& p);
Vec3 to_metres(const ClipperLib::IntPoint& p, double z);
std::vector<Vec3> corners_at(const Path& path, double z);

/// Paths that bound a region: its outlines and holes, by their orientation.
Paths combined(const Paths& subject, ClipperLib::ClipType type, const Paths& clip);

/// The region around lines, or beyond the outlines of a region, up to a distance; below 0: within them.
Paths widened(const Paths& paths, ClipperLib::EndType ends, double distance_m);

/// An outline with its holes.
struct Piece {
    Path outline;
    Paths holes;

    Paths paths() const;
};
std::vector<Piece> pieces_of(const Paths& region);
double area_m2(const Piece& piece);
/// Without the edges.
bool contains(const Piece& piece, const ClipperLib::IntPoint& point);
/// The same with the edges.
bool reaches(const Piece& piece, const ClipperLib::IntPoint& point);

/// The outlines of triangles that all turn the same way, without the edges between neighbours: around each
/// point they turn as often as it is covered. Clipper is slow with many small triangles.
Paths outlines_of(const Paths& triangles);

}  // namespace stilb::sensors
