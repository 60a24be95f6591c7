#include "io/image/texture_file.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr int kMostTexelsOnASide = 16384;

std::array<double, 256> srgb_table() {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double value = static_cast<double>(i) / 255;
        table[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    }
    return table;
}

std::size_t texel_index(double position, int count) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(position * count), 0, count - 1));
}

}  // namespace

const std::array<std::uint8_t, 4>& Texture::at(double u, double v) const {
    return texels[texel_index(v, height) * static_cast<std::size_t>(width) + texel_index(u, width)];
}

Texture read_texture(std::string_view content, const std::string& name) {
    const auto* const bytes = reinterpret_cast<const stbi_uc*>(content.data());
    const bool is_short = content.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
    const int size = is_short ? static_cast<int>(content.size()) : 0;
    Texture texture;
    int channels = 0;
    if (!is_short || !stbi_info_from_memory(bytes, size, &texture.width, &texture.height, &channels))
        throw InputError("no picture that can be read. Allowed: JPEG, PNG, TGA, BMP and GIF.", {name});
    if (std::max(texture.width, texture.height) > kMostTexelsOnASide || texture.width < 1 ||
        texture.height < 1) {
        throw InputError(fmt::format("the picture has {} x {} pixels. Allowed: up to {} on each side.",
                                     texture.width, texture.height, kMostTexelsOnASide),
                         {name});
    }
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> data(
        stbi_load_from_memory(bytes, size, &texture.width, &texture.height, &channels, 4), &stbi_image_free);
    if (!data) throw InputError(fmt::format("the picture is damaged: {}.", stbi_failure_reason()), {name});
    texture.texels.resize(static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
    for (std::size_t i = 0; i < texture.texels.size(); ++i)
        std::copy_n(data.get() + 4 * i, 4, texture.texels[i].begin());
    return texture;
}

bool has_holes(const Texture& texture) {
    constexpr std::uint8_t clear = 25, opaque = 230;
    constexpr double most_between = 0.1, least_clear = 0.001;
    const auto share = [&](const auto& is_one) {
        const auto count = std::ranges::count_if(texture.texels, [&](const auto& t) { return is_one(t[3]); });
        return static_cast<double>(count) / static_cast<double>(texture.texels.size());
    };
    return share([](std::uint8_t a) { return a > clear && a < opaque; }) <= most_between &&
           share([](std::uint8_t a) { return a <= clear; }) >= least_clear;
}

double linear_of_srgb(std::uint8_t value) {
    static const std::array<double, 256> table = srgb_table();
    return table[value];
}

}  // namespace stilb::io
