#include "io/results/packed_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace stilb::io {
namespace {

constexpr std::size_t kBytes = sizeof(std::uint32_t);
/// Whole numbers have fewer bits than this.
constexpr int kMostBits = 30;
/// The exponents of the smallest and of a too large number in half precision.
constexpr int kLeastExponent = -24, kMostExponent = 16;

/// Green, and how red and blue differ from it.
std::array<double, kBands> differences_of(const HalfRgb& rgb) {
    const double green = to_float(rgb[1]);
    return {green, to_float(rgb[0]) - green, to_float(rgb[2]) - green};
}

/// The exponent of the largest power of two that divides a number; not 0.
int exponent_of(double number) {
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(number), &exponent);
    constexpr int digits = std::numeric_limits<double>::digits;
    return exponent - digits + std::countr_zero(static_cast<std::uint64_t>(std::ldexp(mantissa, digits)));
}

std::int16_t exponent_of_term(const LightOfGroups& light, std::size_t term) {
    int least = std::numeric_limits<int>::max(), largest = std::numeric_limits<int>::min();
    for (const auto& group : light) {
        for (const double number : differences_of(group[term])) {
            if (number == 0) continue;
            least = std::min(least, exponent_of(number));
            largest = std::max(largest, std::ilogb(number));
        }
    }
    const bool is_dark = least > largest;
    return static_cast<std::int16_t>(is_dark ? 0 : std::max(least, largest - kMostBits + 2));
}

std::uint32_t unsigned_of(double steps) {
    const auto whole = static_cast<std::int64_t>(std::nearbyint(steps));
    return static_cast<std::uint32_t>(whole < 0 ? -2 * whole - 1 : 2 * whole);
}

double steps_of(std::uint32_t number) {
    const std::uint32_t half = number / 2;
    return number % 2 == 0 ? half : -static_cast<double>(half) - 1;
}

}  // namespace

PackedLight pack(const LightOfGroups& light) {
    PackedLight packed;
    const std::size_t terms = light.empty() ? 0 : light.front().size(), numbers = light.size() * terms;
    for (std::size_t t = 0; t < terms; ++t) packed.exponents.push_back(exponent_of_term(light, t));
    packed.bytes.resize(kBands * kBytes * numbers);
    for (std::size_t g = 0; g < light.size(); ++g) {
        for (std::size_t t = 0; t < terms; ++t) {
            const auto differences = differences_of(light[g][t]);
            for (std::size_t d = 0; d < kBands; ++d) {
                const std::uint32_t number = unsigned_of(std::ldexp(differences[d], -packed.exponents[t]));
                for (std::size_t b = 0; b < kBytes; ++b)
                    packed.bytes[(d * kBytes + b) * numbers + g * terms + t] =
                        static_cast<char>(number >> (8 * b) & 255);
            }
        }
    }
    return packed;
}

std::optional<LightOfGroups> unpack(const PackedLight& packed, std::size_t groups) {
    const std::size_t terms = packed.exponents.size(), numbers = groups * terms;
    if (packed.bytes.size() != kBands * kBytes * numbers) return std::nullopt;
    const auto is_possible = [](int e) { return kLeastExponent <= e && e <= kMostExponent; };
    if (!std::ranges::all_of(packed.exponents, is_possible)) return std::nullopt;
    LightOfGroups light(groups, std::vector<HalfRgb>(terms));
    for (std::size_t g = 0; g < groups; ++g) {
        for (std::size_t t = 0; t < terms; ++t) {
            std::array<double, kBands> differences{};
            for (std::size_t d = 0; d < kBands; ++d) {
                std::uint32_t number = 0;
                for (std::size_t b = 0; b < kBytes; ++b) {
                    const char byte = packed.bytes[(d * kBytes + b) * numbers + g * terms + t];
                    number |= std::uint32_t{static_cast<unsigned char>(byte)} << (8 * b);
                }
                differences[d] = std::ldexp(steps_of(number), packed.exponents[t]);
            }
            const auto& [green, red, blue] = differences;
            light[g][t] = to_half_rgb({{green + red, green, green + blue}});
        }
    }
    return light;
}

}  // namespace stilb::io
