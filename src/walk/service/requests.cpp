#include "walk/service/requests.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "stilb/error.h"

namespace stilb::walk {
namespace {

constexpr double kMostCoordinate_m = 1e9, kMostFactor = 1e6, kShortest = 1e-9;

const nlohmann::json& member_of(const nlohmann::json& object, std::string_view name) {
    const auto found = object.find(name);
    if (found == object.end()) throw InputError(fmt::format("\"{}\" is missing in the request.", name));
    return *found;
}

/// Three numbers from `least` to `most`.
std::array<double, 3> three_numbers(const nlohmann::json& value, std::string_view name, double least,
                                    double most) {
    std::array<double, 3> numbers{};
    bool is_valid = value.is_array() && value.size() == numbers.size();
    for (std::size_t i = 0; is_valid && i < numbers.size(); ++i) {
        is_valid = value[i].is_number();
        if (is_valid) numbers[i] = value[i].get<double>();
        is_valid = is_valid && numbers[i] >= least && numbers[i] <= most;
    }
    if (is_valid) return numbers;
    throw InputError(fmt::format("\"{}\" must be three numbers from {:g} to {:g}.", name, least, most));
}

Vec3 vector_of(const nlohmann::json& object, std::string_view name) {
    const auto [x, y, z] =
        three_numbers(member_of(object, name), name, -kMostCoordinate_m, kMostCoordinate_m);
    return {x, y, z};
}

}  // namespace

nlohmann::json parse_request(std::string_view text) {
    // Numbers beyond the range of doubles make the parser fail, too.
    nlohmann::json request = nlohmann::json::parse(text, nullptr, false);
    if (request.is_discarded()) throw InputError("The request is not valid JSON.");
    if (!request.is_object()) throw InputError("The request must be a JSON object.");
    return request;
}

void require_members(const nlohmann::json& object, std::span<const std::string_view> allowed,
                     std::string_view of) {
    if (!object.is_object()) throw InputError(fmt::format("{} must be a JSON object.", of));
    for (const auto& [name, value] : object.items()) {
        if (std::ranges::find(allowed, name) != allowed.end()) continue;
        throw InputError(fmt::format("{} has an unknown member \"{}\". Allowed: {}.", of, name.substr(0, 40),
                                     fmt::join(allowed, ", ")));
    }
}

std::string_view text_of(const nlohmann::json& object, std::string_view name) {
    const nlohmann::json& value = member_of(object, name);
    if (!value.is_string()) throw InputError(fmt::format("\"{}\" must be a text.", name));
    return value.get_ref<const std::string&>();
}

Vec3 position_of(const nlohmann::json& object, std::string_view name) { return vector_of(object, name); }

Vec3 direction_of(const nlohmann::json& object, std::string_view name) {
    const Vec3 vector = vector_of(object, name);
    if (length(vector) < kShortest)
        throw InputError(fmt::format("\"{}\" is (nearly) zero, so it has no direction.", name));
    return normalized(vector);
}

Rgb factor_of(const nlohmann::json& value, std::string_view name) {
    if (value.is_array()) return {three_numbers(value, name, 0, kMostFactor)};
    if (value.is_number()) {
        const double factor = value.get<double>();
        if (factor >= 0 && factor <= kMostFactor) return Rgb::grey(factor);
    }
    throw InputError(fmt::format("The factor of \"{}\" must be a number from 0 to {:g}, or three.",
                                 name.substr(0, 40), kMostFactor));
}

}  // namespace stilb::walk
