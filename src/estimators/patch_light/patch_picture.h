// Pictures of lit patches.
#pragma once

#include <vector>

#include "estimators/camera_paths.h"
#include "estimators/patch_light/patch_light.h"
#include "estimators/patch_light/patch_location.h"

namespace stilb::estimators {

/// What sides reflect towards the eye. Those that are turned away from it count only where there are mirrors
/// or glass to show them, and then along their normals. Keeps a reference to the transport.
class VisibleSides {
  public:
    VisibleSides(const PatchTransport& transport, const Vec3& eye);

    /// Adds what each side reflects of the light to `sums_cd_m2`, first shot left out.
    void add(const PatchLight& light, std::vector<FloatRgb>& sums_cd_m2) const;
    /// The mean of as many lights as were added, and first shot [cd/m2].
    std::vector<FloatRgb> mean_cd_m2(const std::vector<FloatRgb>& sums_cd_m2, double lights) const;

    std::size_t count() const { return first_.size(); }

    /// Calls `visit(side, out)` for every side that may be seen.
    template <typename Visit>
    void for_each(const Visit& visit) const;

  private:
    const PatchTransport& transport_;
    Vec3 eye_;
    bool are_backs_seen_;
    std::vector<FloatRgb> first_;  ///< [cd/m2] by first shot
};

template <typename Visit>
void VisibleSides::for_each(const Visit& visit) const {
    const patches::Patches& patches = transport_.patches;
    for (std::uint32_t patch = 0; patch < patches.count(); ++patch) {
        const Vec3 normal = patches.normal_of(patch);
        const std::uint32_t back = patches.other_side(patch);
        if (transport_.reflects_alike(patch)) {
            visit(patch, normal);
            visit(back, -normal);
            continue;
        }
        const Vec3 to_eye = normalized(eye_ - patches.middle(patch));
        const bool front_is_seen = dot(to_eye, normal) > 0;
        visit(front_is_seen ? patch : back, to_eye);
        if (are_backs_seen_) visit(front_is_seen ? back : patch, front_is_seen ? -normal : normal);
    }
}

/// A pass over pixels: emission and visibility are those of the true surfaces, what these reflect is
/// interpolated between patches.
class PatchPass final : public PicturePass {
  public:
    /// `sides_cd_m2`: of every side, towards the eye, first shot included. Keeps references to all but that.
    PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
              const std::vector<FloatRgb>& sides_cd_m2);

    std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const override;

  private:
    Rgb reflected(const transport::Path& path, const PatchLocation& seen) const;

    const PictureTracing& tracing_;
    const PatchTransport& transport_;
    Pass pass_;
    std::vector<Rgb> fronts_, backs_;  ///< of the vertices
};

}  // namespace stilb::estimators
