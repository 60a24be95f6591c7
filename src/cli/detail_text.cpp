#include "cli/detail_text.h"

#include <fmt/format.h>

namespace stilb::cli {

std::string detail_text(std::span<const run::LevelOfDetail> levels) {
    std::string text;
    for (const run::LevelOfDetail& level : levels) {
        if (level.degree == level.full_degree) {
            text += fmt::format("{}: all {} degrees; fewer would show by more than {:.2g} mm\n", level.object,
                                level.full_degree, 1e3 * level.allowed_m);
        } else {
            text += fmt::format(
                "{}: degree {} of {}, within {:.2g} mm of the full series ({:.2g} mm allowed)\n",
                level.object, level.degree, level.full_degree, 1e3 * level.error_m, 1e3 * level.allowed_m);
        }
    }
    return text;
}

}  // namespace stilb::cli
