#include "sensors/areas/plan_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace stilb::sensors {
namespace {

double area_m2(const Path& path) { return std::abs(ClipperLib::Area(path)) / (kUnits_per_m * kUnits_per_m); }

}  // namespace

ClipperLib::IntPoint to_units(const Vec3& p) {
    return {std::llround(p.x * kUnits_per_m), std::llround(p.y * kUnits_per_m)};
}
Vec3 to_metres(const ClipperLib::IntPoint& p, double z) {
    return {static_cast<double>(p.X) / kUnits_per_m, static_cast<double>(p.Y) / kUnits_per_m, z};
}

Paths combined(const Paths& subject, ClipperLib::ClipType type, const Paths& clip) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(subject, ClipperLib::ptSubject, true);
    clipper.AddPaths(clip, ClipperLib::ptClip, true);
    Paths result;
    clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return result;
}

Paths widened(const Paths& paths, ClipperLib::EndType ends, double distance_m) {
    ClipperLib::ClipperOffset offset;
    offset.AddPaths(paths, ends == ClipperLib::etClosedPolygon ? ClipperLib::jtMiter : ClipperLib::jtSquare,
                    ends);
    Paths result;
    offset.Execute(result, distance_m * kUnits_per_m);
    return result;
}

std::vector<Piece> pieces_of(const Paths& region) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(region, ClipperLib::ptSubject, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    std::vector<Piece> pieces;
    for (const ClipperLib::PolyNode* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
        if (node->IsHole()) continue;
        Piece& piece = pieces.emplace_back(Piece{node->Contour, {}});
        for (const ClipperLib::PolyNode* hole : node->Childs) piece.holes.push_back(hole->Contour);
    }
    return pieces;
}

double area_m2(const Piece& piece) {
    double sum = area_m2(piece.outline);
    for (const Path& hole : piece.holes) sum -= area_m2(hole);
    return sum;
}

bool contains(const Piece& piece, const ClipperLib::IntPoint& point) {
    return ClipperLib::PointInPolygon(point, piece.outline) == 1 &&
           std::ranges::none_of(
               piece.holes, [&](const Path& hole) { return ClipperLib::PointInPolygon(point, hole) != 0; });
}

Paths outlines_of(const Paths& triangles) {
    using PlanEdge = std::pair<ClipperLib::IntPoint, ClipperLib::IntPoint>;
    const auto order = [](const PlanEdge& a, const PlanEdge& b) {
        return std::tie(a.first.X, a.first.Y, a.second.X, a.second.Y) <
               std::tie(b.first.X, b.first.Y, b.second.X, b.second.Y);
    };
    std::multiset<PlanEdge, decltype(order)> edges(order);
    for (const Path& path : triangles) {
        for (std::size_t i = 0; i < path.size(); ++i) {
            const ClipperLib::IntPoint &from = path[i], &to = path[(i + 1) % path.size()];
            if (const auto opposite = edges.find({to, from}); opposite != edges.end()) {
                edges.erase(opposite);
            } else {
                edges.insert({from, to});
            }
        }
    }
    Paths outlines;
    constexpr auto kFirst = std::numeric_limits<ClipperLib::cInt>::min();
    while (!edges.empty()) {
        Path& outline = outlines.emplace_back();
        // As many edges end in a point as begin there.
        for (auto edge = edges.begin();
             edge != edges.end() && (outline.empty() || edge->first == outline.back());) {
            const ClipperLib::IntPoint to = edge->second;
            if (outline.empty()) outline.push_back(edge->first);
            edges.erase(edge);
            if (to == outline.front()) break;
            outline.push_back(to);
            edge = edges.lower_bound({to, {kFirst, kFirst}});
        }
    }
    return outlines;
}

bool reaches(const Piece& piece, const ClipperLib::IntPoint& point) {
    return ClipperLib::PointInPolygon(point, piece.outline) != 0 &&
           std::ranges::none_of(
               piece.holes, [&](const Path& hole) { return ClipperLib::PointInPolygon(point, hole) == 1; });
}

std::vector<Vec3> corners_at(const Path& path, double z) {
    std::vector<Vec3> corners;
    for (const ClipperLib::IntPoint& point : path) corners.push_back(to_metres(point, z));
    return corners;
}

Paths Piece::paths() const {
    Paths all = holes;
    all.push_back(outline);
    return all;
}

}  // namespace stilb::sensors
