// Shapes and backends of item buffers: names for options, without the machinery.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace stilb::patches {

enum class BufferShape {
    cube,               ///< six faces: the whole sphere
    hemicube,           ///< the half of a cube in front of the plane across w: a face and four halves
    cubic_tetrahedron,  ///< the same half space by three faces, w through the corner of a cube [Beran-Koehn,
                        ///< Pavicic 1991]
};
inline constexpr std::array<std::string_view, 3> kBufferShapeNames{"cube", "hemicube", "cubic-tetrahedron"};
constexpr std::string_view name_of(BufferShape shape) {
    return kBufferShapeNames[static_cast<std::size_t>(shape)];
}

/// Visibility by rays on the processor, or by OpenGL.
enum class BufferBackend { rays, opengl };
inline constexpr std::array<std::string_view, 2> kBufferBackendNames{"rays", "opengl"};
constexpr std::string_view name_of(BufferBackend backend) {
    return kBufferBackendNames[static_cast<std::size_t>(backend)];
}

}  // namespace stilb::patches
