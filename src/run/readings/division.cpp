#include "run/readings/division.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "stilb/error.h"

namespace stilb::run {
namespace {

/// What tells lights apart: their groups, where these are asked for, and their factors in all light scenes.
using Traits = std::vector<double>;

std::vector<Traits> traits_of_lights(std::size_t lights, const std::vector<std::vector<Rgb>>& factors,
                                     const LightGroups* groups) {
    std::vector<Traits> all(lights);
    for (std::size_t i = 0; i < lights; ++i) {
        if (groups) all[i].push_back(static_cast<double>(groups->of_light[i]));
        for (const std::vector<Rgb>& of_scene : factors)
            for (std::size_t b = 0; b < kBands; ++b) all[i].push_back(of_scene[i][b]);
    }
    return all;
}

/// Numbers the different traits in the order of their first lights.
LightGroups classes_of(const std::vector<Traits>& traits) {
    LightGroups classes;
    std::map<Traits, std::uint32_t> known;
    for (const Traits& own : traits) {
        const auto [entry, is_new] = known.try_emplace(own, static_cast<std::uint32_t>(known.size()));
        if (is_new) classes.names.push_back(fmt::format("{}", classes.count()));
        classes.of_light.push_back(entry->second);
    }
    return classes;
}

std::size_t orders_of(const RunOptions& options) {
    std::size_t orders = options.by == "bounce" ? kBounces : 1;
    for (const LightScene& state : options.light_scenes) {
        if (state.bounces) orders = std::max(orders, static_cast<std::size_t>(*state.bounces) + 2);
    }
    if (options.bounces) orders = std::min(orders, static_cast<std::size_t>(*options.bounces) + 1);
    return orders;
}

}  // namespace

LightDivision::LightDivision(const Scene& scene, const RunOptions& options) {
    std::vector<std::vector<Rgb>> factors;
    for (const LightScene& state : options.light_scenes)
        factors.push_back(scene::factors_of_lights(state, scene));
    const LightGroups groups = scene::light_groups(scene);
    const bool by_light = options.by == "light";
    channels_ = {classes_of(traits_of_lights(scene.lights.size(), factors, by_light ? &groups : nullptr)),
                 orders_of(options)};
    has_channels_ = channels_.count() > 1 || !factors.empty();
    light_of_class_.resize(channels_.groups.count());
    for (std::size_t i = scene.lights.size(); i-- > 0;) light_of_class_[channels_.groups.of_light[i]] = i;
    if (by_light) add_shares_by_light(scene);
    if (options.by == "bounce") add_shares_by_bounce(options);
    for (const LightScene& state : options.light_scenes) states_.push_back(state_of(state, scene));
}

/// `weight_of`: a light, and a number of reflections.
template <typename WeightOf>
std::vector<Rgb> LightDivision::weights_by(const WeightOf& weight_of) const {
    std::vector<Rgb> weights;
    for (std::size_t c = 0; c < count(); ++c)
        weights.push_back(weight_of(light_of_class_[c / channels_.orders], c % channels_.orders));
    return weights;
}

bool LightDivision::is_direct(ChannelWeights weights) const {
    for (std::size_t c = 0; c < weights.size(); ++c) {
        if (c % channels_.orders > 0 && weights[c].max() > 0) return false;
    }
    return channels_.orders > 1;
}

void LightDivision::add_shares_by_light(const Scene& scene) {
    const LightGroups groups = scene::light_groups(scene);
    for (std::size_t g = 0; g < groups.count(); ++g) {
        shares_.push_back({groups.names[g], weights_by([&](std::size_t light, std::size_t) {
                               return Rgb::grey(groups.of_light[light] == g ? 1 : 0);
                           })});
    }
}

void LightDivision::add_shares_by_bounce(const RunOptions& options) {
    const std::size_t shares = std::min(kBounces, channels_.orders);
    for (std::size_t k = 0; k < shares; ++k) {
        const bool is_last = k + 1 == shares;
        const bool has_more = is_last && (!options.bounces || static_cast<std::size_t>(*options.bounces) > k);
        shares_.push_back(
            {fmt::format("{}{}", k, has_more ? "+" : ""), weights_by([&](std::size_t, std::size_t order) {
                 return Rgb::grey(order == k || (is_last && order > k) ? 1 : 0);
             })});
    }
}

auto LightDivision::state_of(const LightScene& light_scene, const Scene& scene) const -> State {
    const std::vector<Rgb> factors = scene::factors_of_lights(light_scene, scene);
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const std::size_t other = count() > 0 ? light_of_class_[channels_.groups.of_light[i]] : 0;
        if (factors[i] == factors[other]) continue;
        throw InputError(
            fmt::format("the run has not kept the light of \"{}\" apart from that of \"{}\": run it with "
                        "--by light, which "
                        "keeps groups of lights apart, and lights without a group.",
                        scene.lights[i].name, scene.lights[other].name));
    }
    const std::size_t most = count() > 0 ? channels_.orders : 1;
    const auto bounces = static_cast<std::size_t>(light_scene.bounces.value_or(0));
    if (light_scene.bounces && bounces + 1 >= most)
        throw InputError("the run has not kept so many reflections apart: run it with --by bounce.");
    return {light_scene, weights_by([&](std::size_t light, std::size_t order) {
                return light_scene.bounces && order > bounces ? Rgb() : factors[light];
            })};
}

}  // namespace stilb::run
