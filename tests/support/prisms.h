// Upright prisms over plane figures, with fronts outside: some star-shaped, some not.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/shape.h"

namespace stilb {

/// From z = 0 to z = 1; `figure` counterclockwise in x and y, `triangles` of it likewise.
inline Mesh prism(const std::vector<std::pair<double, double>>& figure,
                  const std::vector<Triangle>& triangles) {
    const auto count = static_cast<std::uint32_t>(figure.size());
    Mesh mesh;
    for (const auto& [x, y] : figure) mesh.vertices.push_back({x, y, 0});
    for (const auto& [x, y] : figure) mesh.vertices.push_back({x, y, 1});
    for (const auto& [a, b, c] : triangles) {
        mesh.triangles.push_back({c, b, a});
        mesh.triangles.push_back({a + count, b + count, c + count});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count;
        mesh.triangles.push_back({i, j, j + count});
        mesh.triangles.push_back({i, j + count, i + count});
    }
    return mesh;
}

/// Star-shaped about the points of the unit cube; the middle of its volume is (1.1, 1.1, 0.5).
inline Mesh l_prism() {
    return prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
                 {{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}});
}

/// Two arms, x from 0 to 1 and from 2 to 3, on a base up to y = 1: of no point star-shaped.
inline Mesh u_prism() {
    return prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
                 {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}});
}

}  // namespace stilb
