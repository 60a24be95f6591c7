// shape = "harmonics" of an object
#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/error.h"
#include "geometry/harmonics/surface.h"
#include "io/mesh/harmonics_file.h"
#include "io/scene/sections.h"

namespace stilb::io {
namespace {

constexpr Range kCoefficient{-1e9, 1e9, "a number from -1e9 to 1e9"};
constexpr std::array<std::string_view, 3> kMethods{"cells", "roots", "march"};

int degree_of(const TomlItem& item, std::size_t count) {
    for (int degree = 0; degree <= math::kMostHarmonicDegree; ++degree) {
        if (math::harmonic_count(degree) == count) return degree;
    }
    item.fail(
        fmt::format("found {} coefficients. Allowed: (degree + 1)^2 of them for a degree from 0 to {}: "
                    "1, 4, 9, 16 ...",
                    count, math::kMostHarmonicDegree));
}

HarmonicsFile read_series(const TomlTable& table, const std::filesystem::path& directory, SceneFile& file) {
    const auto [key, item] = table.one_of({"file", "coefficients"});
    if (key == "file") {
        file.sources.push_back(item.existing_file(directory));
        return read_harmonics(file.sources.back());
    }
    HarmonicsFile series;
    for (const TomlItem& element : item.elements())
        series.coefficients.push_back(element.number(kCoefficient));
    degree_of(item, series.coefficients.size());
    return series;
}

void truncate(const TomlTable& table, std::vector<double>& coefficients) {
    const auto item = table.find("degree");
    if (!item) return;
    const auto largest = degree_of(*item, coefficients.size());
    coefficients.resize(math::harmonic_count(static_cast<int>(item->integer(0, largest))));
}

Harmonics harmonics_of(const HarmonicsFile& series, const TomlTable& table) {
    try {
        return Harmonics(geometry::HarmonicSurface(math::HarmonicSeries<double>(series.coefficients)));
    } catch (const InputError& error) {
        table.fail(error.what());
    }
}

}  // namespace

Harmonics read_harmonic_shape(const TomlTable& table, const std::filesystem::path& directory,
                              SceneFile& file) {
    HarmonicsFile series = read_series(table, directory, file);
    truncate(table, series.coefficients);
    Harmonics harmonics = harmonics_of(series, table);
    if (!table.has("center")) harmonics.center = series.center;
    if (const auto method = table.find("intersection"))
        harmonics.method = static_cast<HarmonicMethod>(method->index_in(kMethods, "intersection"));
    if (const auto detail = table.find("lod")) harmonics.has_levels_of_detail = detail->boolean();
    return harmonics;
}

}  // namespace stilb::io
