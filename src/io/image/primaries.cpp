#include "io/image/primaries.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace stilb::io {
namespace {

Vec3 xyz_of(const std::array<double, 2>& xy) { return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]}; }

/// Components of `v` along three vectors, by Cramer's rule.
Vec3 components(const std::array<Vec3, 3>& basis, const Vec3& v) {
    const double volume = dot(basis[0], cross(basis[1], basis[2]));
    return Vec3{dot(v, cross(basis[1], basis[2])), dot(basis[0], cross(v, basis[2])),
                dot(basis[0], cross(basis[1], v))} /
           volume;
}

/// XYZ of one unit of each primary, where one unit of all is white with luminance 1.
std::array<Vec3, 3> basis_of(const Primaries& primaries) {
    std::array<Vec3, 3> basis{xyz_of(primaries[0]), xyz_of(primaries[1]), xyz_of(primaries[2])};
    const Vec3 shares = components(basis, xyz_of(primaries[3]));
    for (std::size_t i = 0; i < 3; ++i) basis[i] = shares[i] * basis[i];
    return basis;
}

}  // namespace

bool are_usable(const Primaries& primaries) {
    for (const auto& [x, y] : primaries) {
        if (!(std::abs(x) <= 10 && y >= 1e-3 && y <= 10)) return false;
    }
    const std::array<Vec3, 3> basis{xyz_of(primaries[0]), xyz_of(primaries[1]), xyz_of(primaries[2])};
    if (!(std::abs(dot(basis[0], cross(basis[1], basis[2]))) > 1e-6)) return false;
    const Vec3 shares = components(basis, xyz_of(primaries[3]));
    return std::min({shares.x, shares.y, shares.z}) > 1e-6;
}

PrimariesConversion::PrimariesConversion(const Primaries& from, const Primaries& to) {
    const Vec3 old_white = xyz_of(from[3]);
    const Vec3 new_white = xyz_of(to[3]);
    const std::array<Vec3, 3> new_basis = basis_of(to);
    const std::array<Vec3, 3> old_basis = basis_of(from);
    for (std::size_t column = 0; column < 3; ++column) {
        const Vec3& xyz = old_basis[column];
        const Vec3 adapted{xyz.x * new_white.x / old_white.x, xyz.y, xyz.z * new_white.z / old_white.z};
        const Vec3 rgb = components(new_basis, adapted);
        for (std::size_t row = 0; row < 3; ++row) rows_[row][column] = rgb[row];
    }
}

Triple PrimariesConversion::operator()(const Triple& rgb) const {
    Triple result{};
    for (std::size_t row = 0; row < 3; ++row) {
        result[row] = rows_[row][0] * rgb[0] + rows_[row][1] * rgb[1] + rows_[row][2] * rgb[2];
    }
    return result;
}

}  // namespace stilb::io
