// Which sides of a guess's patches groups of receivers see whole, for certain: no surface lies in the shaft
// between them (rays/shaft_query.h). The light of these is known in closed form (certain_light.h). An answer
// that is not certain is "no".
//
// Many receivers and many sides are asked together first, and divided where the answer is not certain. What
// is left open when a group has cost so many queries stays uncertain, so that cluttered scenes cost no more
// than others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "estimators/local/guess/light_guess.h"
#include "rays/shaft_query.h"
#include "transport/receiver.h"

namespace stilb::estimators {

/// How a group of receivers sees a side.
enum class Sight : std::uint8_t {
    uncertain,
    certain,  ///< all receivers see all of it that is above their horizons
    /// All receivers are behind it or, but for rounding, in its plane, or all of it is below their horizons.
    none,
};
using Sights = std::vector<Sight>;  ///< by sides

/// Keeps a reference to the guess. Immutable.
class CertainSides {
  public:
    using Group = std::span<const transport::Receiver>;

    CertainSides(const Scene& scene, const LightGuess& guess, const rays::RayCaster& caster);

    /// The sights of groups, whose receivers must lie on surfaces. Groups that lie close together should
    /// follow each other.
    std::vector<Sights> find(std::span<const Group> groups) const;

  private:
    /// Lit sides in one plane: a range of `sides_`.
    struct Cluster {
        std::uint32_t first = 0, last = 0;
        std::uint32_t children = 0;  ///< the first of two; 0: none
        /// The corners of a polygon around them, in order: lifted off the plane, as points of connections
        /// are, and drawn in as far at its edges, which may touch other surfaces.
        std::array<Vec3, 4> corners{};
        std::uint32_t corner_count = 4;

        std::span<const Vec3> polygon() const { return std::span(corners).first(corner_count); }
    };
    class Search;

    bool are_in_one_plane(std::uint32_t side, std::uint32_t other) const;
    void add_plane(std::uint32_t first, std::uint32_t last);
    void set_triangle(Cluster& cluster) const;
    void divide(std::uint32_t cluster, const Frame& frame);

    const LightGuess& guess_;
    double lift_m_;
    rays::ShaftQuery shafts_;
    std::vector<std::uint32_t> sides_;  ///< the lit ones
    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> planes_;  ///< clusters of whole planes
};

}  // namespace stilb::estimators
