// scale, rotate, translate or transform of an object
#include "io/scene/sections.h"

namespace stilb::io {
namespace {

constexpr Range kScale{1e-9, 1e9, "a factor above 0 (from 1e-9 to 1e9)"};
/// A sine between axes below this leaves too few digits to tell the front from the back.
constexpr double kLeastRegularity = 1e-6;

geometry::Transform read_matrix(const TomlItem& item) {
    const std::vector<double> m = item.numbers(16, kCoordinate);
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        item.fail(
            "the last row is not [0, 0, 0, 1]. Allowed: 16 numbers row by row; the translation is the "
            "fourth of each of the first three rows.");
    }
    const geometry::Transform transform{
        {m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
    if (transform.regularity() < kLeastRegularity) {
        item.fail("the matrix is singular: it squashes the object flat. Allowed: any invertible one.");
    }
    return transform;
}

geometry::Transform read_rotation(const TomlItem& item) {
    const std::vector<double> parts = item.numbers(4, kCoordinate);
    return geometry::Transform::rotation(item.made_unit({parts[0], parts[1], parts[2]}), parts[3]);
}

}  // namespace

geometry::Transform read_transform(const TomlTable& object) {
    for (const std::string_view key : {"scale", "rotate", "translate"})
        object.expect_not_both(key, "transform");
    if (const auto matrix = object.find("transform")) return read_matrix(*matrix);
    geometry::Transform transform;
    if (const auto scale = object.find("scale"))
        transform = geometry::Transform::scaling(scale->number(kScale));
    if (const auto rotation = object.find("rotate")) transform = compose(read_rotation(*rotation), transform);
    if (const auto translation = object.find("translate")) transform.translation = translation->vector();
    return transform;
}

}  // namespace stilb::io
