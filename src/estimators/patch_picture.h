// Pictures of lit patches.
#pragma once

#include <vector>

#include "estimators/patch_light.h"
#include "estimators/patch_place.h"
#include "estimators/patch_transport.h"
#include "estimators/picture_tracing.h"

namespace stilb {

/// What sides reflect towards the eye. Those that are turned away from it count only where there are mirrors
/// or glass to show them, and then along their normals. Keeps a reference to the transport.
class SeenSides {
  public:
    SeenSides(const PatchTransport& transport, const Vec3& eye);

    /// Adds what each side reflects of the light to `sums_cd_m2`, first shot left out.
    void add(const PatchLight& light, std::vector<Rgb>& sums_cd_m2) const;
    /// The mean of as many lights as were added, and first shot [cd/m2].
    std::vector<Rgb> mean_cd_m2(const std::vector<Rgb>& sums_cd_m2, double lights) const;

    std::size_t count() const { return first_.size(); }

  private:
    /// Calls `visit(side, out)` for every side that may be seen.
    template <typename Visit>
    void for_each(const Visit& visit) const;

    const PatchTransport& transport_;
    Vec3 eye_;
    bool are_backs_seen_;
    std::vector<Rgb> first_;  ///< [cd/m2] by first shot
};

/// A pass over pixels: emission and visibility are those of the true surfaces, what these reflect is
/// interpolated between patches.
class PatchPass final : public PicturePass {
  public:
    /// `sides_cd_m2`: of every side, towards the eye, first shot included. Keeps references to all but that.
    PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
              const std::vector<Rgb>& sides_cd_m2);

    std::uint64_t sample(const PixelBlock& block, std::span<Spectrum> pixels) const override;

  private:
    Spectrum reflected(const Path& path, const PatchPlace& seen) const;

    const PictureTracing& tracing_;
    const PatchTransport& transport_;
    Pass pass_;
    std::vector<Spectrum> fronts_, backs_;  ///< of the vertices
};

}  // namespace stilb
