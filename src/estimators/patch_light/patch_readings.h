// Readings of lit patches.
//
// Luminance: at the sub-points of lines of sight, interpolated between the patches around. Illuminance:
// direct light as everywhere (direct_light.h), and along a few rays from the point for each sample what the
// patches that they meet reflect.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/patch_light/patch_light.h"
#include "estimators/patch_light/patch_location.h"
#include "transport/receiver.h"

namespace stilb::estimators {

/// Keeps a reference to the transport. Immutable.
class PatchReadings {
  public:
    PatchReadings(const PatchTransport& transport, std::span<const Measurand> measurands);

    /// Emission and stored first shot along lines of sight, direct light of point-like sources at points.
    std::span<const Rgb> known_part() const { return known_part_; }
    /// As Estimator.
    std::span<const std::optional<Vec3>> sight_ends() const { return sight_ends_; }

    /// Adds sample number `sample` of every reading, beside the known part.
    void add(const PatchLight& light, math::RandomKey key, std::uint64_t sample, ReadingSums& sums) const;

  private:
    /// A sub-point as patches show it.
    struct View {
        std::uint32_t reading = 0;
        Rgb transmission;
        PatchLocation seen;
        Vec3 position, outgoing;
        std::vector<patches::VertexInterpolation::Share> shares{};  ///< of the patches around
    };

    void add_reading(std::uint32_t reading, const Measurand& measurand);
    void add_shares();
    Rgb first_reflected(const View& view) const;
    void add_luminance(const PatchLight& light, const View& view, math::RandomKey key,
                       ReadingSums& sums) const;
    /// Calls `visit(side, weight)` for the sides that a view is interpolated between.
    template <typename Visit>
    void for_each_share(const View& view, const Visit& visit) const;
    void add_illuminances(const PatchLight& light, std::span<const transport::Receiver> points,
                          math::SampleStream stream, ReadingSums& sums) const;

    const PatchTransport& transport_;
    std::vector<Rgb> known_part_;
    std::vector<std::optional<Vec3>> sight_ends_;
    std::vector<transport::Receiver> points_;
    std::vector<View> views_;
};

}  // namespace stilb::estimators
