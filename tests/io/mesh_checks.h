// What the tests of the mesh readers share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "io/mesh/mesh_file.h"
#include "stilb/error.h"
#include "support/source_directory.h"

namespace stilb::io {

using MeshReader = MeshFile (*)(UnreadBytes content, const std::string& name);

/// The message with which `read` refuses `content`; "accepted" where it does not.
inline std::string refusal(MeshReader read, std::string_view content) {
    try {
        read(content, "room");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// m3; that of a closed mesh whose front is outside is positive.
inline double enclosed_volume(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles)
        sum += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    return sum;
}

/// Edges that no neighbour runs along the other way.
inline std::size_t open_edges(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            balance[{low, high}] += low == t[i] ? 1 : -1;
        }
    }
    return static_cast<std::size_t>(
        std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

inline std::filesystem::path shared_mesh(const std::string& name) {
    return source_directory() / "../shared/data/meshes" / name;
}

}  // namespace stilb::io
