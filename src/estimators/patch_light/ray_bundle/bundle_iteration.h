// Stochastic iteration with bundles of parallel rays (theory 8, [FirstShot 3]).
//
// Every step draws a global direction or a frame of three, lets every side of every patch radiate along it
// the light that it reflects of the step before, and transfers that along bundles of parallel rays: side j
// receives
//
//   J_j = sum over the rays that come to it of L dA / A_j = mean over the patch of L(w) cos(theta),
//
// so that a weight of 4 pi (one direction), 2 pi (one axis, both ways) or 2 pi / 3 for each of three axes
// makes the reflected luminance c sum f_j(w_a, w) J_{j,a} whose mean is the integral over the hemisphere
// (T.7). Steps start from darkness: the first ones are left out. Infinite variance with single directions
// above a reflectance of 0.61, with single axes above 0.87; frames nearly contract.
//
// The rays bring light from outside of the scene to the first surface that they meet, in every step.
//
// Biased by the patches: everything is a mean over a patch, reflected as from its middle. Mirrors and glass
// transmit and reflect nothing: light by them is missing except on the lines of sight of sensors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "estimators/patch_light/patch_readings.h"
#include "math/random.h"
#include "scene/light_groups.h"

namespace stilb::estimators {

/// The light of a group of lights that a walk carries apart from others.
struct BundleSource {
    std::span<const FloatRgb> first_reflection;  ///< as PatchTransport has it, of the group's lights
    std::span<const FloatRgb> emission;          ///< likewise
    const FirstShot* first_shot = nullptr;
    bool has_outside = false;  ///< light from outside of the scene is of this group
};

/// One walk of the iteration. Keeps references to the arguments except the key. One thread at a time.
class BundleIteration final : public PatchLight {
  public:
    /// Parts of its key.
    enum class Stream : std::uint64_t { points, order };

    /// Starts from darkness. The steps depend on the key alone. All light together:
    BundleIteration(const PatchTransport& transport, math::KeyOf<Stream> key);
    /// Each source apart, along the same rays. More than one needs light that is stored (or no first shot).
    BundleIteration(const PatchTransport& transport, std::vector<BundleSource> sources,
                    math::KeyOf<Stream> key);

    void step();

    std::size_t groups() const { return sources_.size(); }
    /// The luminance by the illuminance received in the last step, of all groups.
    Rgb reflected(std::uint32_t side, const Vec3& out) const override;

    /// Calls `visit(in, illuminances_lx)` for the light that a side received in the last step from the
    /// unit world direction `in`, of each group. Of sides with constant reflection only the sum is known:
    /// once, with their normal.
    template <typename Visit>
    void for_each_arrival(std::uint32_t side, const Visit& visit) const;

    std::uint64_t rays() const { return rays_; }

    /// The walk between two steps, as bytes. Reading throws InputError where they are not those of such a
    /// walk.
    void write(ByteWriter& bytes) const;
    void read(ByteReader& bytes);

  private:
    void radiate_constant();
    void radiate_glossy(const Vec3& axis);
    void transfer(std::size_t axis, const patches::Bundle& bundle);
    /// The luminance that a side sends along a line at the line's crossing number i, of one group.
    FloatRgb sent(std::size_t group, std::uint32_t side, const patches::CrossedLine& line, std::size_t i,
                  const Vec3& out, const Vec3& along) const;
    void receive(std::size_t group, std::uint32_t side, std::size_t axis, const FloatRgb& luminance,
                 double ray_area_m2);
    /// The luminance that a glossy side sends towards `out`, by the light received in the last step.
    Rgb reflected_of(std::size_t group, std::uint32_t side, std::uint32_t glossy, const Vec3& out) const;
    static const Vec3& axis_of(const Frame& frame, std::size_t axis) {
        return axis == 0 ? frame.w : axis == 1 ? frame.u : frame.v;
    }
    std::size_t index(std::uint32_t side, std::size_t group) const { return side * sources_.size() + group; }
    /// The index of the first group's value.
    std::size_t glossy_index(std::uint32_t number, std::size_t axis) const;

    const PatchTransport& transport_;
    std::vector<BundleSource> sources_;
    math::KeyOf<Stream> key_;
    std::size_t axes_;
    double weight_;  ///< of each axis
    std::uint64_t steps_ = 0;
    std::uint64_t rays_ = 0;
    Frame received_along_;  ///< the axes that `received_` came along
    // Side by side, of each group:
    std::vector<FloatRgb> radiance_;   ///< along the present axis; see FirstShot::needs_position()
    std::vector<FloatRgb> received_;   ///< sum over the axes of J, of sides with constant reflection
    std::vector<FloatRgb> receiving_;  ///< the same of the unfinished step
    /// J of the other sides, for each axis separately.
    std::vector<FloatRgb> glossy_received_, glossy_receiving_;
};

template <typename Visit>
void BundleIteration::for_each_arrival(std::uint32_t side, const Visit& visit) const {
    const std::uint32_t glossy = transport_.glossy_number[side];
    const Vec3 normal = transport_.patches.normal_of(side);
    std::array<Rgb, scene::kMostLightGroups> illuminances_lx;
    const std::span<const Rgb> of_groups(illuminances_lx.data(), groups());
    const auto read = [&](const FloatRgb* received) {
        bool is_lit = false;
        for (std::size_t g = 0; g < groups(); ++g) {
            illuminances_lx[g] = to_rgb(received[g]) * weight_;
            is_lit |= illuminances_lx[g].max() > 0;
        }
        return is_lit;
    };
    if (glossy == PatchTransport::kConstant) {
        read(received_.data() + index(side, 0));
        return visit(normal, of_groups);
    }
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        if (!read(glossy_received_.data() + glossy_index(glossy, axis))) continue;
        const Vec3& along = axis_of(received_along_, axis);
        visit(dot(along, normal) < 0 ? -along : along, of_groups);
    }
}

/// Steps to leave out of a walk's mean: the light that they lack is less than 1e-3 in a mean over
/// as many more. Throws InputError where reflectances are so close to 1 that there would be more than 8192.
std::uint64_t first_steps(const PatchTransport& transport);

}  // namespace stilb::estimators
