// Places that several surfaces share, because they lie in one plane: the floor below a box, walls and faces
// that occur twice. A ray meets one of the surfaces there, but points of all of them would send out the light
// of the guess and its residual: each place must have one owner, for rays and for points alike.
//
// The owner is a side that light does not reach, if there is one: inside a box on a lit floor it is dark.
// Else it is the side with the lowest number. Where one of the surfaces is traced, the place is.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "patches/patches.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

/// Immutable. Keeps references to its arguments.
class SharedPlaces {
  public:
    /// `is_traced`: whether an object's surface of a material has no patches. Traced instances count as if
    /// they shared no places.
    SharedPlaces(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                 const std::function<bool(ObjectId, MaterialId)>& is_traced);

    /// The sides that light reaches; none before. Sets the owners.
    void set_lit(const std::vector<std::uint32_t>& lit_sides);

    /// Whether a side shares some of its places.
    bool shares(std::uint32_t side) const {
        if (covers_.empty()) return false;
        const std::uint32_t patch = patches_.patch_of(side);
        return first_cover_[patch] != first_cover_[patch + 1];
    }
    struct Place {
        std::uint32_t side = patches::kNoSide;  ///< the owner; kNoSide where the place is traced
        math::Barycentric at;
    };
    Place owner_of(std::uint32_t side, const math::Barycentric& at) const;
    /// Whether a side is the owner of one of its places.
    bool owns(std::uint32_t side, const math::Barycentric& at) const {
        return !shares(side) || owner_of(side, at).side == side;
    }
    /// Whether a surface that is not traced itself shares a place with one that is.
    bool is_traced_at(const Vec3& position) const;

  private:
    /// A triangle that shares places with a patch.
    struct Cover {
        std::uint32_t patch = patches::kNoSide;  ///< kNoSide: it is traced
        std::array<Vec3, 3> corners;             ///< relative to the patches' centre
    };

    /// Between surfaces that share a place.
    double largest_gap_m(const Vec3& position) const;
    std::array<Vec3, 3> corners_of(std::uint32_t patch) const;
    bool is_lit(std::uint32_t side) const { return !is_lit_.empty() && is_lit_[side] != 0; }

    const rays::RayCaster& caster_;
    const patches::Patches& patches_;
    std::vector<Cover> covers_;               ///< by patch
    std::vector<std::uint32_t> first_cover_;  ///< per patch, and their number; empty where there are none
    bool has_traced_ = false;
    std::vector<std::uint8_t> is_lit_;  ///< per side
};

}  // namespace stilb::estimators
