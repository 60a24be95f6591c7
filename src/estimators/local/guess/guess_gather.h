// Gathering rays to a guess of the light. The light that receivers get from surfaces which reflect as guessed
// is shared between connections to points of these surfaces (guess_points.h) and gathering rays, by the
// weights w and 1 - w of bounded connections (theory T.1b); where a surface is seen for certain, between
// closed forms and rays (certain_light.h). What the guess lacks comes from connections with the vertices of
// its residual (residual_light.h), bounded by a larger k; some rays find the rest of that by path tracing.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/local/guess/certain_sides.h"
#include "estimators/local/guess/guess_points.h"
#include "estimators/local/guess/light_guess.h"
#include "estimators/local/guess/part_reflection.h"
#include "estimators/local/guess/residual_light.h"
#include "estimators/local/point_tile.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// The directions of a tile's rays: all lanes take the same point of the unit square, each with a shift of
/// its own, in the frame of its receiver.
struct alignas(64) GatherLanes {
    using Floats = PointTile::Floats;
    std::array<Floats, 3> u{}, v{}, w{};         ///< the frames
    Floats shift{}, turn_cos{}, turn_sin{};      ///< of the two coordinates
    std::array<float, kPacketWidth> roulette{};  ///< shift of the third random number

    GatherLanes(const PointTile& tile, std::span<const std::array<double, 2>> shifts);
};

/// A random point of rays: two numbers for the direction, one for roulette.
using GatherPoint = std::array<double, 3>;
/// Points number `first` ... `first` + `count` - 1.
std::vector<GatherPoint> gather_points(math::RandomKey key, std::uint64_t first, std::uint64_t count);
/// Lanes whose shifts differ by little: enough that neighbours do not have the same noise, little enough that
/// the packet of rays stays together. `random`: in [0, 1), of the whole tile. `lane`: among neighbours.
std::array<double, 2> gather_shift(const std::array<double, 2>& random, std::size_t lane);

inline double fraction(double x) { return x - std::floor(x); }

/// Keeps references to its arguments. Immutable.
class GuessGather {
  public:
    GuessGather(const rays::RayCaster& caster, const transport::PathTracer& tracer, const LightGuess& guess,
                const ResidualLight& residual)
        : caster_(caster), tracer_(tracer), guess_(guess), residual_(residual) {}

    /// Sums of luminances over rays, by lanes [cd/m2].
    struct Sums {
        std::array<PointTile::Floats, kBands> guessed{};
        std::array<Rgb, kPacketWidth> found{};              ///< by path tracing beyond the guess
        std::array<std::vector<Rgb>, kPacketWidth> shares;  ///< of the channels in both; empty without
        std::array<double, kPacketWidth> largest{};
        std::uint64_t continued = 0;  ///< rays
    };
    /// The shares of the guess that rays from a group of receivers bring.
    struct Shares {
        /// By sides. Connections share the light of uncertain ones; closed forms have the mean luminance of
        /// certain ones. Empty: all are uncertain.
        std::span<const Sight> sights;
        float split = 0;  ///< as that of the points of the guess
    };
    /// Adds one ray from every receiver of a tile, whose responses must be constant and whose k is that of
    /// the residual. `u`: the random point of the rays. `key`, `round`: for the paths of rays that path
    /// tracing continues.
    void add_round(const PointTile& tile, const GatherLanes& lanes, const GatherPoint& u, math::RandomKey key,
                   std::uint64_t round, const Shares& shares, Sums& sums) const;
    /// The same with receivers of any response, by rays about in proportion to it: the rays bring all the
    /// light of the guess.
    void add_general_round(const PointTile& tile, math::RandomKey key, std::uint64_t round,
                           Tally& readings) const;
    /// A sample of a receiver's light by path tracing alone.
    transport::LightSum traced(const transport::Receiver& receiver, math::SampleStream stream) const;
    /// Adds the light of the rays to the readings, `weight` times.
    void flush(const PointTile& tile, const Sums& sums, double weight, Tally& readings) const;
    /// Adds light that a receiver gets to its reading.
    void add(const transport::LightSum& light, const transport::Receiver& receiver, Tally& readings) const;

  private:
    void set_rays(const PointTile& tile, const GatherLanes& lanes, const GatherPoint& u, RayPacket& packet,
                  PointTile::Floats& cosine) const;
    /// The guessed light that the ray of a lane brings [cd/m2]; adds its shares to the sums. `g_over_k`: with
    /// the k of the residual.
    Rgb gathered_cd_m2(const GuessedLight& light, std::size_t lane, float g_over_k, const Shares& shares,
                       Sums& sums) const;
    /// How a ray is continued beyond the guess.
    struct Continuation {
        PartShares shares;
        double probability = 0;
        bool is_traced = false;  ///< the surface that it meets
    };
    Continuation continuation_of(const GuessedLight& light, std::size_t lane, double g_over_k) const;
    /// The luminance that the continued ray of a lane finds beyond the guess, divided by the probability
    /// [cd/m2].
    transport::LightSum missing(const transport::Receiver& receiver, const Vec3& direction,
                                const GuessedLight& light, std::size_t lane, const Continuation& continuation,
                                math::SampleStream stream) const;

    const rays::RayCaster& caster_;
    const transport::PathTracer& tracer_;
    const LightGuess& guess_;
    const ResidualLight& residual_;
};

}  // namespace stilb::estimators
