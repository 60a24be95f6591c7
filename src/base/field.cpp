#include "base/field.h"

#include <fmt/format.h>

#include "stilb/error.h"

namespace stilb {

std::string refusal(double value, const Range& range) {
    return fmt::format("{} is not allowed. Allowed: {}.", value, range.allowed);
}

void fail_at(std::string_view path, std::string_view message) {
    throw InputError(fmt::format("{}: {}", path, message));
}

void expect_inside(double value, const Range& range, const std::string& path) {
    if (!range.contains(value)) fail_at(path, refusal(value, range));
}

void expect_inside(const Rgb& value, const Range& range, const std::string& path) {
    const bool is_grey = value == Rgb::grey(value[0]);
    is_grey ? expect_inside(value[0], range, path) : expect_inside(std::span(value.band), range, path);
}

void expect_inside(std::span<const double> values, const Range& range, const std::string& path) {
    for (std::size_t i = 0; i < values.size(); ++i)
        expect_inside(values[i], range, fmt::format("{}[{}]", path, i));
}

}  // namespace stilb
