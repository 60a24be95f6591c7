// Readings of the light of patches.
//
// Luminance: at the sub-points of lines of sight, interpolated between the patches around. Illuminance:
// direct light by shadow rays (direct_light.h), and along a few rays from the point for each sample the
// light that the patches reflect where the rays end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "estimators/camera_paths.h"
#include "estimators/estimator.h"
#include "estimators/patch_light/patch_transport.h"
#include "transport/receiver.h"

namespace stilb::estimators {

// The light that patches reflect, independent of the method.

class PatchLight {
  public:
    virtual ~PatchLight() = default;

    /// The luminance [cd/m2] that a side reflects towards the unit `out`, in front of it, as a mean over the
    /// patch; without emission and without first shot.
    virtual Rgb reflected(std::uint32_t side, const Vec3& out) const = 0;
};

/// Sides with the same luminance in all directions: the result of methods for diffuse scenes.
class ReflectedSides final : public PatchLight {
  public:
    /// `cd_m2`: of every side.
    explicit ReflectedSides(std::vector<FloatRgb> cd_m2) : cd_m2_(std::move(cd_m2)) {}

    Rgb reflected(std::uint32_t side, const Vec3&) const override { return to_rgb(cd_m2_[side]); }
    const std::vector<FloatRgb>& cd_m2() const { return cd_m2_; }

  private:
    std::vector<FloatRgb> cd_m2_;
};

/// Keeps references to the transport and the monitor. Immutable.
class PatchReadings {
  public:
    /// Parts of a key of samples.
    enum class Stream : std::uint64_t { views, points, faint, comparisons };

    /// `rays_per_sample`: the approximate cost of the light that one sample is taken of.
    PatchReadings(const PatchTransport& transport, std::span<const Measurand> measurands,
                  double rays_per_sample, const Monitor& monitor);

    /// Emission and stored first shot along lines of sight, direct light of point-like sources at points.
    std::span<const Rgb> known_part() const { return known_part_; }
    /// As Estimator.
    std::span<const std::optional<Vec3>> sight_ends() const { return sight_ends_; }

    /// Adds sample number `sample` of every reading, beside the known part. Some samples are compared with
    /// path tracing, which has no patches. Throws Cancelled, with unfinished sums, where the monitor ends the
    /// run.
    void add(const PatchLight& light, math::KeyOf<Stream> key, std::uint64_t sample, Tally& sums) const;

  private:
    /// A sub-point on the patches.
    struct View {
        std::uint32_t reading = 0;
        Rgb transmission;
        PatchLocation seen;
        rays::Hit hit;  ///< of the true surface
        Vec3 outgoing;
        std::vector<patches::VertexInterpolation::Share> shares{};  ///< of the patches around
        Rgb known{};  ///< the luminance by first shot, as far as it is the same in all samples
    };

    /// A branch of a line of sight with so little light that path tracing suffices for it.
    struct FaintView {
        std::uint32_t reading = 0;
        transport::FaintRay branch;
    };

    void add_reading(std::uint32_t reading, const Measurand& measurand);
    void add_shares();
    Rgb first_reflected(const View& view) const;
    /// The part of a view's luminance that is not known.
    Rgb sampled_luminance(const PatchLight& light, const View& view, math::RandomKey key) const;
    /// Calls `visit(side, weight)` for the sides that a view is interpolated between.
    template <typename Visit>
    void for_each_share(const View& view, const Visit& visit) const;
    /// A ray from a point, and the light that the patches send along it.
    struct GatheredRay {
        Vec3 direction;
        Rgb weight;
        Rgb luminance_cd_m2;
    };
    /// Nothing where the point is blind to its direction.
    using GatheredRays = std::array<std::optional<GatheredRay>, kPacketWidth>;
    /// A ray from every point, with the direction that the two random numbers give.
    GatheredRays gather(const PatchLight& light, std::span<const transport::Receiver> points, double u1,
                        double u2) const;
    void add_illuminances(const PatchLight& light, std::span<const transport::Receiver> points,
                          math::SampleStream stream, Tally& sums) const;
    /// Calls `visit(first, points)` for all points, some together.
    template <typename Visit>
    void for_each_packet(const Visit& visit) const;
    /// Compares every reading with path tracing once.
    void compare(const PatchLight& light, math::KeyOf<Stream> key, std::uint64_t number, Tally& sums) const;

    const PatchTransport& transport_;
    const Monitor& monitor_;
    transport::PathTracer tracer_;  ///< without patches
    std::vector<Rgb> known_part_;
    std::vector<std::optional<Vec3>> sight_ends_;
    std::vector<transport::Receiver> points_;
    std::vector<View> views_;
    std::vector<FaintView> faint_;
    std::uint64_t comparisons_ = 1;             ///< of a sample that is compared
    std::uint64_t samples_per_comparison_ = 1;  ///< one in so many is compared
};

// Pictures of lit patches.

/// The light that sides reflect towards the camera. Sides facing away from it count only where there are
/// mirrors or glass to show them, and then along their normals. Keeps a reference to the transport.
class VisibleSides {
  public:
    VisibleSides(const PatchTransport& transport, const Vec3& camera);

    /// Adds each side's reflected light to `sums_cd_m2`, without first shot.
    void add(const PatchLight& light, std::vector<FloatRgb>& sums_cd_m2) const;
    /// The mean of all lights added, and first shot [cd/m2].
    std::vector<FloatRgb> mean_cd_m2(const std::vector<FloatRgb>& sums_cd_m2, double lights) const;

    std::size_t count() const { return first_.size(); }

    /// Calls `visit(side, out)` for every side that may be seen.
    template <typename Visit>
    void for_each(const Visit& visit) const;

  private:
    const PatchTransport& transport_;
    Vec3 camera_;
    bool are_backs_seen_;
    std::vector<FloatRgb> first_;  ///< [cd/m2] by first shot
};

template <typename Visit>
void VisibleSides::for_each(const Visit& visit) const {
    const patches::Patches& patches = transport_.patches;
    for (std::uint32_t patch = 0; patch < patches.count(); ++patch) {
        const Vec3 normal = patches.normal_of(patch);
        const Vec3 to_camera = normalized(camera_ - patches.middle(patch));
        const bool front_is_seen = dot(to_camera, normal) > 0;
        for (const std::uint32_t side : {patch, patches.other_side(patch)}) {
            const bool is_seen = front_is_seen == (side == patch);
            if (is_seen && !transport_.reflects_alike(side)) {
                visit(side, to_camera);
            } else if (are_backs_seen_ || transport_.reflects_alike(side)) {
                visit(side, side == patch ? normal : -normal);
            }
        }
    }
}

/// A pass over pixels: emission and visibility are those of the true surfaces, reflected light is
/// interpolated between patches.
class PatchPass final : public PicturePass {
  public:
    /// `sides_cd_m2`: of every side, towards the camera, first shot included. Keeps references to the other
    /// arguments.
    PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
              const std::vector<FloatRgb>& sides_cd_m2);

    void sample(const PixelBlock& block, Tally& sums) const override;

  private:
    Rgb reflected(const transport::Path& path, const PatchLocation& seen) const;

    const PictureTracing& tracing_;
    const PatchTransport& transport_;
    Pass pass_;
    std::vector<Rgb> fronts_, backs_;  ///< of the vertices
};

}  // namespace stilb::estimators
