// The variants of first shot that store the light arriving at patches, or the light that they reflect.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "estimators/patch_light/first_shot/factors.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "materials/material.h"
#include "math/random.h"
#include "patches/patches.h"
#include "scene/scene.h"

namespace stilb::estimators {

// Incoming first shot [FirstShot 3, 4]: arriving light is stored, and reflected when needed.
//
//     L*_j(w) = sum over samples i of e_ij f_j(w_i, w)
//
// w_i is the direction from the patch's middle to the sample: the BRDF is taken to be the same over a patch.

/// Keeps references to scene and patches.
class IncomingFirstShot {
  public:
    IncomingFirstShot(const Scene& scene, const patches::Patches& patches, const FirstShotLights& lights,
                      FirstShotFactors factors);

    const FirstShotFactors& factors() const { return factors_; }
    Rgb illuminance_lx(std::uint32_t side) const;

    /// As FirstShot; the position does not matter.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const;
    std::size_t bytes() const { return factors_.bytes(); }

  private:
    struct Source {
        Vec3 position;
        Rgb colour;
    };

    const Scene& scene_;
    const patches::Patches& patches_;
    std::vector<Source> sources_;  ///< per light sample
    FirstShotFactors factors_;
};

// Classical first shot: the reflected radiance is stored for each side, in bins of outgoing directions with
// a constant value each; in one bin where the material reflects equally in all directions.

/// The hemisphere in bins of equal projected solid angle, so that all weigh the same in flux: rings of equal
/// steps in sin^2(theta), each in four times as many sectors as there are rings, from the frame's u on.
class HemisphereBins {
  public:
    /// Throws InputError where there is no ring, or more than 256.
    explicit HemisphereBins(int rings);

    std::uint32_t count() const { return rings_ * sectors_; }
    /// The bin of a unit direction above the horizon.
    std::uint32_t bin_of(const Vec3& local) const;
    /// Uniform in projected solid angle over the bin for u1, u2 in [0, 1).
    Vec3 direction(std::uint32_t bin, double u1, double u2) const;

  private:
    std::uint32_t rings_, sectors_;
};

/// Keeps a reference to the patches.
class ClassicalFirstShot {
  public:
    ClassicalFirstShot(const Scene& scene, const patches::Patches& patches, const IncomingFirstShot& incoming,
                       const HemisphereBins& bins);

    /// As FirstShot; the position does not matter.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const { return bins_of(side) <= 1; }
    std::size_t bytes() const {
        return first_.size() * sizeof first_[0] + radiance_cd_m2_.size() * sizeof radiance_cd_m2_[0];
    }

  private:
    /// Empty where a side gets no light or reflects none.
    std::size_t bins_of(std::uint32_t side) const { return first_[side + 1] - first_[side]; }
    void store(std::uint32_t side, const IncomingFirstShot& incoming);

    const patches::Patches& patches_;
    HemisphereBins bins_;
    std::vector<std::size_t> first_;  ///< per side, and the end
    std::vector<patches::Float3>
        radiance_cd_m2_;  ///< per bin and band: the mean over the bin's projected solid angle
};

// Diffuse first shot: the part of the reflection that is the same in all directions is stored, one colour for
// each side, and the rest found by shadow rays.

/// Keeps references to scene and patches, and those of the shadow rays.
class DiffuseFirstShot {
  public:
    DiffuseFirstShot(const Scene& scene, const patches::Patches& patches, const IncomingFirstShot& incoming,
                     const ShadowRays& rays);

    /// As FirstShot; the position matters to the rest.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const { return reflects_alike(material_of(scene_, patches_, side)); }
    std::size_t bytes() const { return radiance_cd_m2_.size() * sizeof radiance_cd_m2_[0]; }

  private:
    const Scene& scene_;
    const patches::Patches& patches_;
    ShadowRays rays_;
    std::vector<Material> rest_;                   ///< per material of the scene
    std::vector<patches::Float3> radiance_cd_m2_;  ///< per side and band
};

}  // namespace stilb::estimators
