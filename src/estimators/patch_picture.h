// Pictures of lit patches.
#pragma once

#include <vector>

#include "estimators/patch_light.h"
#include "estimators/patch_transport.h"
#include "estimators/picture_tracing.h"

namespace stilb {

/// Towards the eye, of every side; sides that are turned away from it, which mirrors may show, along their
/// normals. The mean of as many lights as are added.
class SeenSides {
  public:
    SeenSides(const PatchTransport& transport, const Vec3& eye);

    void add(const PatchLight& light);
    void add(const SeenSides& others);
    std::vector<Rgb> mean_cd_m2() const;

  private:
    const PatchTransport& transport_;
    Vec3 eye_;
    double lights_ = 0;
    std::vector<Rgb> sums_;
};

/// A pass over pixels: emission and visibility are those of the true surfaces, what these reflect is
/// interpolated between patches.
class PatchPass final : public PicturePass {
  public:
    /// `sides_cd_m2`: of every side, towards the eye. Keeps references to all but that.
    PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
              const std::vector<Rgb>& sides_cd_m2);

    std::uint64_t sample(const PixelBlock& block, std::span<Spectrum> pixels) const override;

  private:
    Spectrum reflected(const Path& path) const;

    const PictureTracing& tracing_;
    const PatchTransport& transport_;
    Pass pass_;
    std::vector<Spectrum> fronts_, backs_;  ///< of the vertices
};

}  // namespace stilb
