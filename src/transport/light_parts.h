// Light by where it began and how often it was reflected, for what keeps lamps or bounces apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/rays.h"
#include "base/rgb.h"
#include "scene/light_groups.h"

namespace stilb::transport {

/// The light of one lamp after so many reflections, in the unit of the sum that it is a part of.
struct LightPart {
    Rgb value;
    std::uint32_t light = 0;  ///< of Scene::lights
    int reflections = 0;
};

/// The parts of a sum. Null pointers to it mean that nobody asks for them.
using LightParts = std::vector<LightPart>;

/// Whether a set-up keeps the parts of light that needs no samples.
enum class PartsOfLight { none, all };

/// Adds a part to a sum.
inline void add_part(const Rgb& value, std::size_t light, int reflections, Rgb& sum, LightParts* parts) {
    sum += value;
    if (parts) parts->push_back({value, static_cast<std::uint32_t>(light), reflections});
}

/// The channels that the light of a problem is divided into: groups of lights, and numbers of reflections.
struct Channels {
    scene::LightGroups groups;
    /// Of 0, 1, 2 ... reflections; the last one also has all further ones.
    std::size_t orders = 1;

    std::size_t count() const { return groups.count() * orders; }
    std::size_t of(std::uint32_t light, int reflections) const {
        return groups.of_light[light] * orders + std::min(static_cast<std::size_t>(reflections), orders - 1);
    }

    // These add to `sums` (channels x readings) what a reading gets, times a weight and after so many more
    // reflections. Pilots have no such sums, and nothing is added to them.

    void add(std::span<const LightPart> parts, const Rgb& weight, int reflections, std::size_t reading,
             std::span<Rgb> sums) const {
        if (sums.empty()) return;
        const std::size_t readings = sums.size() / count();
        for (const LightPart& part : parts) {
            const std::size_t channel = of(part.light, part.reflections + reflections);
            add(weight * part.value, sums[channel * readings + reading]);
        }
    }
    /// `shares`: by channel.
    void add(std::span<const Rgb> shares, const Rgb& weight, int reflections, std::size_t reading,
             std::span<Rgb> sums) const {
        if (sums.empty()) return;
        const std::size_t readings = sums.size() / count();
        for_all_after(reflections, [&](std::size_t channel, std::size_t after) {
            add(weight * shares[channel], sums[after * readings + reading]);
        });
    }
    /// `visit(channel, after)`: every channel, and where its light is after so many more reflections.
    template <typename Visit>
    STILB_INLINED void for_all_after(int reflections, const Visit& visit) const {
        const std::size_t all = count(), more = static_cast<std::size_t>(reflections);
        for (std::size_t first = 0; first < all; first += orders) {
            for (std::size_t order = 0; order < orders; ++order)
                visit(first + order, first + std::min(order + more, orders - 1));
        }
    }

  private:
    static void add(const Rgb& value, Rgb& sum) {
        if (value.is_finite()) sum += value;
    }
};

/// A sum of light and, where there are channels, the share of each in it.
struct LightSum {
    /// `channels`: null where nobody asks.
    explicit LightSum(const Channels* channels)
        : shares(channels ? channels->count() : 0), channels_(channels) {}

    Rgb whole;
    std::vector<Rgb> shares;  ///< by channel, or empty

    void add(const Rgb& value, std::uint32_t light, int reflections = 0) {
        whole += value;
        if (channels_) shares[channels_->of(light, reflections)] += value;
    }
    void add(const LightSum& other, const Rgb& weight) {
        whole += other.whole * weight;
        for (std::size_t c = 0; c < shares.size(); ++c) shares[c] += other.shares[c] * weight;
    }
    /// Adds the light that `sample(parts)` returns, times a weight.
    template <typename Sample>
    void add_sample(const Rgb& weight, const Sample& sample) {
        LightParts parts;
        whole += sample(channels_ ? &parts : nullptr) * weight;
        for (const LightPart& part : parts)
            shares[channels_->of(part.light, part.reflections)] += part.value * weight;
    }
    LightSum& operator*=(const Rgb& factor) {
        whole *= factor;
        for (Rgb& share : shares) share *= factor;
        return *this;
    }
    /// The shares as parts of the whole, band by band; null where there are no channels.
    std::shared_ptr<const std::vector<Rgb>> relative_shares() const {
        if (!channels_) return nullptr;
        auto relative = std::make_shared<std::vector<Rgb>>(shares);
        for (Rgb& share : *relative) {
            for (std::size_t b = 0; b < kBands; ++b) share[b] = whole[b] != 0 ? share[b] / whole[b] : 0;
        }
        return relative;
    }
    /// The sum after one more reflection, with the same whole.
    void reflect() {
        if (!channels_) return;
        std::vector<Rgb> reflected(shares.size());
        channels_->for_all_after(1, [&](std::size_t c, std::size_t after) { reflected[after] += shares[c]; });
        shares = std::move(reflected);
    }

  private:
    const Channels* channels_;
};

}  // namespace stilb::transport
