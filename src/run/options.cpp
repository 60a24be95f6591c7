#include "run/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <utility>
#include <vector>

#include "estimators/estimator_list.h"
#include "stilb/error.h"

namespace stilb::api {

std::span<const std::string_view> first_shot_names() {
    static constexpr auto names = [] {
        std::array<std::string_view, estimators::kFirstShotNames.size() + 1> all{"auto"};
        std::ranges::copy(estimators::kFirstShotNames, all.begin() + 1);
        return all;
    }();
    return names;
}
std::span<const std::string_view> window_names() {
    static constexpr std::array<std::string_view, 3> names{"cube", "hemicube", "tetrahedron"};
    return names;
}
std::span<const std::string_view> visibility_names() { return patches::kBufferBackendNames; }
std::span<const std::string_view> directions_names() { return estimators::kBundleDirectionsNames; }

}  // namespace stilb::api

namespace stilb::run {

namespace {

void expect_allowed(double value, const Range& limits, const std::string& key) {
    expect_inside(value, limits, key);
}
void expect_allowed(double value, const api::Share& limits, const std::string& key) {
    expect_inside(value, limits.range, key);
}
template <std::integral Value>
void expect_allowed(Value value, const api::WholeRange& limits, const std::string& key) {
    if (std::cmp_less(value, limits.min) || std::cmp_greater(value, limits.max))
        fail_at(key, fmt::format("{} is not allowed. Allowed: a whole number from {} to {}.", value,
                                 limits.min, limits.max));
}
void expect_allowed(const std::string& value, const api::Names& limits, const std::string& key) {
    const std::span<const std::string_view> all = limits.all();
    if (std::ranges::find(all, value) == all.end())
        fail_at(key, fmt::format("\"{}\" is not allowed.{} Allowed: {}.", value, did_you_mean(value, all),
                                 fmt::join(all, ", ")));
}

/// The enumerator with the index of its name among the names; `otherwise` where there is no name.
template <typename Enum>
Enum named(const std::optional<std::string>& name, std::span<const std::string_view> names, Enum otherwise) {
    if (!name) return otherwise;
    return static_cast<Enum>(std::ranges::find(names, *name) - names.begin());
}

}  // namespace

estimators::PatchMethodOptions patch_options(const api::Options& options) {
    estimators::PatchMethodOptions patches;
    if (options.first_shot == "auto") {
        patches.first_shot.variant = estimators::kUsualFirstShot;
    } else if (options.first_shot) {
        patches.first_shot.variant =
            named(options.first_shot, estimators::kFirstShotNames, estimators::kUsualFirstShot);
    }
    estimators::ShootingOptions& shooting = patches.first_shot.shooting;
    shooting.window = named(options.window, api::window_names(), shooting.window);
    shooting.backend = named(options.visibility, api::visibility_names(), shooting.backend);
    patches.directions = named(options.directions, api::directions_names(), patches.directions);
    patches.resolution = options.resolution;
    if (options.resolution) patches.shot_resolution = *options.resolution;
    return patches;
}

std::optional<std::string> lack_of_effect(const api::Options& options, std::string_view flag,
                                          std::string_view first_shot) {
    const auto goes_by = [&](const estimators::EstimatorEntry& entry) {
        return std::ranges::find(entry.patch_options, flag) != entry.patch_options.end();
    };
    std::vector<std::string_view> methods;
    for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
        if (goes_by(entry)) methods.push_back(entry.name);
    }
    if (methods.empty()) return std::nullopt;
    const estimators::EstimatorEntry& method = estimators::find_estimator(options.method);
    if (!goes_by(method))
        return fmt::format("has no effect with method {}. It belongs to: {}.", method.name,
                           fmt::join(methods, ", "));
    if (!method.lights_patches && !options.first_shot)
        return fmt::format("has no effect with method {} unless {} is given.", method.name, first_shot);
    return std::nullopt;
}

std::string flag_of(std::string_view key) {
    std::string flag(key);
    std::ranges::replace(flag, '_', '-');
    return flag;
}

void require_valid(const RunOptions& options) {
    for_each_value(options, [](const auto& option, const auto& value) {
        expect_allowed(value, option.limits, std::string(option.key));
    });
    if (options.replicates && *options.replicates < 2) throw InputError("replicates: expected 2 or more");
}

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
