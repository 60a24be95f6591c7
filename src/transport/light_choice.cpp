#include "transport/light_choice.h"

#include <algorithm>
#include <utility>

#include "transport/light_sampler.h"

namespace stilb::transport {

LightChoice::LightChoice(std::vector<LightTree::Light> lights, std::optional<std::uint32_t> outside)
    : outside_(outside) {
    if (lights.size() + (outside ? 1 : 0) > kFew) {
        tree_ = LightTree(std::move(lights));
        return;
    }
    for (const LightTree::Light& light : lights) few_.push_back(light.number);
    if (outside) few_.push_back(*outside);
    std::ranges::sort(few_);
}

double LightChoice::At::View::estimate_lx(const LightTree::Node& node) const {
    return node.is_point ? lights.rough_illuminance_lx(node.first, at) : LightTree::box_lx(node, at);
}

double LightChoice::At::rough_lx(std::uint32_t light) const {
    return lights_.rough_illuminance_lx(light, at_);
}

LightChoice::At::At(const LightChoice& choice, const LightSampler& lights, const SurfacePoint& at)
    : choice_(choice), lights_(lights), at_(at) {
    for (std::size_t i = 0; i < choice.few_.size(); ++i) sums_lx_[i] = all_lx_ += rough_lx(choice.few_[i]);
    if (!choice.few_.empty()) return;
    cut_ = choice.tree_.cut(View{lights, at});
    if (choice.outside_) outside_lx_ = rough_lx(*choice.outside_);
    all_lx_ = outside_lx_ + cut_.total_lx();
}

math::DiscreteChoice LightChoice::At::choose(double u) const {
    if (!choice_.few_.empty()) {
        math::DiscreteChoice choice = math::choose_by_sums({sums_lx_.data(), choice_.few_.size()}, u);
        choice.index = choice_.few_[choice.index];
        return choice;
    }
    const double outside = outside_lx_ / all_lx_;
    if (u < outside) return {*choice_.outside_, outside, u / outside};
    const double rest = std::min((u - outside) / (1 - outside), math::kBelowOne);
    math::DiscreteChoice choice = choice_.tree_.choose(cut_, View{lights_, at_}, rest);
    choice.probability *= 1 - outside;
    return choice;
}

double LightChoice::At::times_probability(double pdf_per_sr, std::uint32_t light) const {
    if (is_empty()) return 0;
    if (!choice_.few_.empty()) return pdf_per_sr * rough_lx(light) / all_lx_;
    if (light == choice_.outside_) return pdf_per_sr * (outside_lx_ / all_lx_);
    if (!(cut_.total_lx() > 0)) return 0;
    return pdf_per_sr *
           (cut_.total_lx() / all_lx_ * choice_.tree_.probability(cut_, light, View{lights_, at_}));
}

}  // namespace stilb::transport
