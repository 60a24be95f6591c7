// How a run of readings divides its light: into channels, of which shares and light scenes are made.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "run/options.h"
#include "scene/scene.h"
#include "transport/light_parts.h"

namespace stilb::run {

/// Reflections that "bounce" keeps apart; the last share has all further ones.
inline constexpr std::size_t kBounces = 8;

/// A factor for the light of each channel.
using ChannelWeights = std::span<const Rgb>;

/// Lights that belong together in all that is asked for are one channel, so that there are as few as
/// possible.
class LightDivision {
  public:
    /// Keeps nothing apart.
    LightDivision() = default;
    /// Throws InputError where a light scene names no light.
    LightDivision(const Scene& scene, const RunOptions& options);

    /// Null where nothing is kept apart.
    const transport::Channels* channels() const { return count() > 0 ? &channels_ : nullptr; }
    std::size_t count() const { return has_channels_ ? channels_.count() : 0; }

    /// Whether the weights leave only light that comes straight from lamps.
    bool is_direct(ChannelWeights weights) const;

    /// A sum of channels, by their weights.
    struct Part {
        std::string name;
        std::vector<Rgb> weights;  ///< none where nothing is kept apart: all light
    };
    /// What "by" asks for.
    const std::vector<Part>& shares() const { return shares_; }

    /// A state of the lamps.
    struct State {
        LightScene light_scene;
        std::vector<Rgb> weights;
    };
    const std::vector<State>& states() const { return states_; }
    /// Another state. Throws InputError where it tells lights or bounces apart that this does not.
    State state_of(const LightScene& light_scene, const Scene& scene) const;

  private:
    template <typename WeightOf>
    std::vector<Rgb> weights_by(const WeightOf& weight_of) const;
    void add_shares_by_light(const Scene& scene);
    void add_shares_by_bounce(const RunOptions& options);

    transport::Channels channels_;
    bool has_channels_ = false;
    std::vector<std::size_t> light_of_class_;  ///< one light stands for all of its class
    std::vector<Part> shares_;
    std::vector<State> states_;
};

}  // namespace stilb::run
