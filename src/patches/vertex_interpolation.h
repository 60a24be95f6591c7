// Interpolation of patch values to a value that varies continuously over smooth surfaces.
//
// A vertex gets a mean of the patches around it, and a point the barycentric mean of its patch's vertices.
// Vertices are divided at creases, so nothing leaks across edges, between materials or
// between objects. The weights are those of the plane fitted to the values by least squares in the tangent
// plane: values that are linear over a plane are reproduced. Where the fit would extrapolate, with negative
// weights, mostly at the rims of surfaces, all weights are equal. So no value ever lies outside of the range
// of the patches around, and the error is of second order in the patch size, of first order along rims.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geometry/shape.h"
#include "patches/patches.h"

namespace stilb::patches {

/// Keeps the weights, 12 bytes for each patch, and a reference to the patches.
class VertexInterpolation {
  public:
    explicit VertexInterpolation(const Patches& patches);

    /// Values of the vertices from those of one side of the patches (fronts or backs, one for each patch).
    /// `Value` is any type that can be added and multiplied by a float, and is zero when constructed: float,
    /// Vec3, Rgb.
    template <typename Value>
    std::vector<Value> at_vertices(std::span<const Value> of_patches) const {
        std::vector<Value> values(patches_.vertices.size());
        for (std::size_t p = 0; p < patches_.count(); ++p) {
            for (std::size_t i = 0; i < 3; ++i)
                values[patches_.corners[p][i]] += weights_[p][i] * of_patches[p];
        }
        return values;
    }

    /// The value at a point of a patch, from the result of at_vertices().
    template <typename Value>
    Value at(std::span<const Value> of_vertices, std::uint32_t patch,
             const math::Barycentric& barycentric) const {
        const auto& [a, b, c] = patches_.corners[patch];
        Value value = static_cast<float>(barycentric.b0) * of_vertices[a];
        value += static_cast<float>(barycentric.b1) * of_vertices[b];
        value += static_cast<float>(barycentric.b2) * of_vertices[c];
        return value;
    }

    /// A point of a patch, and the shares of the patches around it in its value: the weights of at().
    struct PatchPoint {
        std::uint32_t patch = 0;
        math::Barycentric barycentric;
    };
    struct Share {
        std::uint32_t patch = 0;
        double weight = 0;
    };
    /// For few points, whose values are needed without those of all vertices.
    std::vector<std::vector<Share>> shares_of(std::span<const PatchPoint> points) const;

  private:
    const Patches& patches_;
    std::vector<std::array<float, 3>> weights_;  ///< per patch and corner: the patch's share of that vertex
};

// Vertices for smoothly varying values: one for each smooth part of surface around a point.

/// The largest angle between normals across a smooth edge; a larger one is a crease of the object, not an
/// approximation of a curve: a cylinder of ten sides is round, one of eight has edges.
inline constexpr double kCreaseAngle_deg = 40;

struct SmoothVertices {
    std::vector<Triangle> triangles;      ///< of the smooth vertices
    std::vector<std::uint32_t> original;  ///< per smooth vertex, the original one
};

/// Divides the vertices of a mesh so that triangles share one where a path around it leads from one to the
/// other over smooth edges alone: edges of two triangles of the same material, whose fronts lie on the same
/// side and whose normals differ by kCreaseAngle_deg at most. `normals` and `materials` are those of the
/// triangles.
SmoothVertices divide_at_creases(std::span<const Triangle> triangles, std::span<const Vec3> normals,
                                 std::span<const MaterialId> materials);

}  // namespace stilb::patches
