// What a mesh reader must keep for any input.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/mesh/mesh_file.h"
#include "stilb/error.h"

namespace stilb {

inline void require(bool is_kept) {
    if (!is_kept) std::abort();
}

inline void check_mesh_reader(io::MeshFile (*read)(io::UnreadBytes, const std::string&),
                              const std::uint8_t* data, std::size_t size) {
    try {
        const io::MeshFile file = read(std::string_view(reinterpret_cast<const char*>(data), size), "fuzzed");
        const std::size_t triangles = file.mesh.triangles.size();
        require(triangles > 0);
        require(file.material_of_triangle.size() == triangles && file.group_of_triangle.size() == triangles);
        for (const Vec3& vertex : file.mesh.vertices) require(is_finite(vertex));
        for (std::size_t i = 0; i < triangles; ++i) {
            for (const std::uint32_t corner : file.mesh.triangles[i])
                require(corner < file.mesh.vertices.size());
            require(file.material_of_triangle[i] < file.material_names.size());
            require(file.group_of_triangle[i] < file.group_names.size());
        }
        require(area_m2(Shape(file.mesh)) > 0);
    } catch (const InputError& error) {
        require(std::string_view(error.what()).starts_with("fuzzed:"));
    }
}

}  // namespace stilb
