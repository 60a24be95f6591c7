#include "cli/patch_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace stilb::cli {
namespace {

/// Of those that are not replaced, the ones that are named.
constexpr std::size_t kMostNames = 3;

std::string first_shot_text(const estimators::PatchReport& report) {
    if (report.first_shot == estimators::FirstShotVariant::none) return "no first shot";
    const auto replaced = std::ranges::count_if(report.lights, &estimators::FirstShotLight::is_replaced);
    const std::string resolution =
        report.resolution ? fmt::format(", resolution {}", *report.resolution) : "";
    return fmt::format("first shot ({}{}) for {} of {} lights, {:.2g} s, {:.0f} bytes per patch",
                       name_of(report.first_shot), resolution, replaced, report.lights.size(),
                       report.set_up_s, report.bytes_per_patch);
}

std::string left_lights(const estimators::PatchReport& report) {
    if (report.first_shot == estimators::FirstShotVariant::none) return "";
    std::string text;
    std::size_t left = 0;
    for (const estimators::FirstShotLight& light : report.lights) {
        if (light.is_replaced || ++left > kMostNames) continue;
        text += fmt::format("{}{} ({})", left > 1 ? ", " : "lights that stay: ", light.name, light.why);
    }
    if (left > kMostNames) text += fmt::format(" and {} more", left - kMostNames);
    return text.empty() ? text : text + '\n';
}

}  // namespace

std::string patch_text(const estimators::PatchReport& report) {
    return fmt::format("{} patches of {:.2g} m; {}\n", report.count, report.size_m, first_shot_text(report)) +
           left_lights(report);
}

}  // namespace stilb::cli
