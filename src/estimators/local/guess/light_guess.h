// A quick guess of the light that surfaces reflect diffusely: a control variate for local estimation (theory
// T.8).
//
// The guess is a function of the point alone: the luminance of patches, interpolated between their vertices.
// It is wrong by some per cent, and lacks all gloss. Nothing is biased by that: what it lacks, the residual,
// is estimated beside it (residual_light.h). It must not depend on the samples that it is used with, so it
// has a random key of its own.
//
// Some surfaces are traced: mirrors and glass, sheets that light also passes straight, sharp gloss, exact
// surfaces and meshes with smooth normals have no guess, and no residual starts there. Path tracing finds the
// light that comes directly by them. Both sides of a translucent sheet send on what arrives on either.
//
// Each lit side of a patch sends out some rays once. The sides that they meet are a sampled matrix of form
// factors, and the guess is the solution of the equations of radiosity with it. Where light is divided into
// channels, the same equations are solved for each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.h"
#include "estimators/local/guess/bounded_direct.h"
#include "estimators/local/guess/shared_places.h"
#include "materials/split_material.h"
#include "math/random.h"
#include "patches/regular_patches.h"
#include "rays/ray_caster.h"
#include "transport/light_parts.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// The guessed light along the rays of a packet.
struct GuessedLight {
    using Floats = RayPacket::Floats;
    alignas(64) std::array<Floats, kBands> luminance{};  ///< [cd/m2]; 0 where a ray meets nothing
    alignas(64) Floats cosine{};     ///< at the surface that is met; 0 where there is none
    std::uint32_t traced_lanes = 0;  ///< bits of the lanes whose rays meet a traced surface
    alignas(64) std::array<std::uint32_t, kPacketWidth> sides{};  ///< that are met; else kNoSide
    alignas(64) Floats b1{}, b2{};  ///< where they are met: barycentric coordinates, if at all

    Rgb luminance_of(std::size_t lane) const {
        return {{luminance[0][lane], luminance[1][lane], luminance[2][lane]}};
    }
    math::Barycentric barycentric_of(std::size_t lane) const {
        return {1 - double{b1[lane]} - double{b2[lane]}, b1[lane], b2[lane]};
    }
};

/// Keeps references to its arguments. Immutable.
class LightGuess {
  public:
    /// Parts of its key.
    enum class Stream : std::uint64_t { survey, solution };

    /// The number of patches for a scene, about.
    static double patch_count(const Scene& scene);

    /// `channels`: null for none.
    LightGuess(const Scene& scene, const rays::RayCaster& caster, const BoundedDirect& direct,
               const transport::PathTracer& tracer, math::KeyOf<Stream> key,
               const transport::Channels* channels, const Monitor& monitor);

    const patches::Patches& patches() const { return patches_.patches(); }
    /// The sides that light reaches and that reflect it, ascending.
    const std::vector<std::uint32_t>& lit_sides() const { return lit_sides_; }
    const materials::SplitMaterial& material(std::uint32_t side) const {
        return material(patches().material_of(scene_, side));
    }
    const materials::SplitMaterial& material(MaterialId id) const { return materials_[index_of(id)]; }
    /// Whether the surface that a ray has met is traced.
    bool is_traced(const rays::Hit& hit) const {
        return is_traced(hit.object, hit.material) || shared_.is_traced_at(hit.position);
    }
    /// The places that several sides share: only their owners send out light there.
    const SharedPlaces& shared_places() const { return shared_; }

    /// The channels of the light, or null.
    const transport::Channels* channels() const { return channels_; }

    // The diffuse part of the reflected light [cd/m2]: at a point of a side, its mean there, and along the
    // ray of a lane.

    transport::LightSum at(std::uint32_t side, const math::Barycentric& at) const;
    static constexpr math::Barycentric kMiddle{1. / 3, 1. / 3, 1. / 3};
    transport::LightSum mean(std::uint32_t side) const { return at(side, kMiddle); }
    transport::LightSum seen(const GuessedLight& light, std::size_t lane) const;
    /// The whole of that at a point of a side.
    Rgb luminance_at(std::uint32_t side, const math::Barycentric& at) const;
    /// Adds the shares at a point of a side, times a weight, without another list. `shares`: by channel, or
    /// empty.
    void add_shares(std::uint32_t side, const math::Barycentric& at, double weight,
                    std::vector<Rgb>& shares) const;
    double lit_area_m2() const { return lit_area_m2_; }
    /// The guess along rays, for lanes that are set; the packet as RayCaster::closest() takes and leaves it.
    void look(rays::RayHitPacket& packet, const LaneMask& lanes, rays::Coherence coherence,
              GuessedLight& light) const;

  private:
    using Luminance = std::array<float, kBands>;

    struct Solver;

    bool is_traced(ObjectId object, MaterialId material) const {
        return is_traced_object_[index_of(object)] != 0 || is_traced_material_[index_of(material)] != 0;
    }
    void interpolate(const std::vector<transport::LightSum>& luminance_of_sides);
    /// Takes hits of shared places to the owners.
    void go_to_owners(patches::PatchHits& hits) const;

    const Scene& scene_;
    std::vector<materials::SplitMaterial> materials_;                  ///< per material of the scene
    std::vector<std::uint8_t> is_traced_material_, is_traced_object_;  ///< per material, per object
    patches::RegularPatches patches_;                                  ///< of surfaces that are not traced
    SharedPlaces shared_;
    std::vector<std::uint32_t> lit_sides_;
    std::vector<std::array<Luminance, 3>> corners_;  ///< per side
    const transport::Channels* channels_;
    std::vector<Luminance> corners_of_shares_;  ///< sides x corners x channels
    double lit_area_m2_ = 0;
};

SurfacePoint side_point(const patches::Patches& patches, const rays::RayCaster& caster, std::uint32_t side,
                        const math::Barycentric& at);

}  // namespace stilb::estimators
