#include "run/relative_error.h"

#include <charconv>

namespace stilb::run {

std::optional<double> parse_relative_error(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, failure] = std::from_chars(text.data(), end, number);
    const std::string_view unit(stopped, static_cast<std::size_t>(end - stopped));
    if (failure != std::errc() || (!unit.empty() && unit != "%")) return {};
    if (unit == "%") number /= 100;
    if (!(number > 0 && number < 1)) return {};
    return number;
}

}  // namespace stilb::run
