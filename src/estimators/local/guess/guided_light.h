// Indirect light by a guess as control variate (theory T.8):
//
//     light of the guess: closed forms (certain_light.h), connections to points of it (guess_points.h), and
//     gathering rays (guess_gather.h)
//     + connections with the vertices of the residual (residual_light.h)
//
// Direct light is added elsewhere. The receivers' k bounds the connections.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "estimators/local/connection.h"
#include "estimators/local/guess/certain_light.h"
#include "estimators/local/guess/certain_sides.h"
#include "estimators/local/guess/guess_gather.h"
#include "estimators/local/guess/guess_points.h"
#include "estimators/local/guess/light_guess.h"
#include "estimators/local/guess/residual_light.h"
#include "estimators/local/node_pool.h"

namespace stilb::estimators {

/// The common part of readings and pictures. Keeps references to its arguments. Immutable.
struct GuidedLight {
    /// Parts of its key.
    enum class Stream : std::uint64_t { guess, pilot, dark };

    /// The guided light of a problem, divided into its channels; null where reflections have a limit, or
    /// there are none.
    static std::unique_ptr<GuidedLight> make(const Problem& problem, const transport::LightSampler& lights,
                                             const transport::PathTracer& tracer, math::KeyOf<Stream> key);

    GuidedLight(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& lights,
                const transport::PathTracer& tracer, math::KeyOf<Stream> key,
                const transport::Channels* channels, const Monitor& monitor);

    /// Of connections to the residual, where so many points of the guess are connected at once.
    double k_per_m2(std::size_t points_at_once) const { return points.residual_k_per_m2(points_at_once); }

    /// Sorts receivers by what brings light to them, and divides glossy ones into the parts of their
    /// material.
    struct Divided {
        std::vector<transport::Receiver> even;     ///< of constant response, on surfaces
        std::vector<transport::Receiver> general;  ///< all others
    };
    Divided divide(std::span<const transport::Receiver> receivers) const;
    /// Packets of one of the two sorts.
    std::vector<PointTile> tiles(std::span<const transport::Receiver> receivers,
                                 std::size_t points_at_once) const;

    /// Moves receivers that hardly any light reaches, as in a cupboard, to the end, and returns their number:
    /// their light, if there is any, is found by path tracing, without the noise that the residual brings
    /// into the dark. None where they are many: then they are what is measured.
    std::size_t put_dark_last(std::vector<transport::Receiver>& receivers, const Monitor& monitor) const;

    const rays::RayCaster& caster;
    bool finds_all_by_rays;          ///< no light is found by light paths alone
    math::RandomKey dark_key;        ///< of the search for dark receivers
    std::uint64_t samples_together;  ///< whose vertices of the residual are selected together
    BoundedDirect direct;
    LightGuess guess;
    ResidualLight residual;
    GuessPoints points;
    GuessGather gather;
    CertainSides sides;
};

/// Light of readings. Keeps references to its arguments' targets, also to the receivers. Immutable.
class GuidedReadings {
  public:
    /// Samples of a batch are a multiple of this. A sample is one gathering ray from every receiver, with its
    /// share of the residual.
    static constexpr std::uint64_t kGranularity = 1;

    /// Points of the guess that are connected to a tile for each gathering ray of its receivers; fewer where
    /// closed forms bring much of the light.
    static constexpr std::size_t kPoints = 8;

    /// `dark`: so many receivers at the end are dark.
    GuidedReadings(const GuidedLight& light, std::span<const transport::Receiver> receivers, std::size_t dark,
                   const Monitor& monitor);

    /// A packet of readings with a pace of its own is sixteen receivers in their order, so there must be as
    /// many of these as readings, all of constant response.
    void collect(const Batch& batch, Tally& sums) const;
    bool can_have_paces() const { return general_tiles_.empty(); }
    /// Adds the light that needs no samples. `parts`: as Estimator's known_parts().
    void add_known(std::span<Rgb> readings, std::span<Rgb> parts) const;
    // As Estimator's.
    bool is_met_by_chance(const rays::Hit& place) const { return light_.guess.is_traced(place); }
    double rays_per_sample() const;
    /// As Estimator's, where each receiver stands for so many.
    double cost_per_sample(double stands_for) const;

  private:
    /// Tiles first ... last - 1, which lie so close together that the same is near to all of them.
    struct Group {
        std::size_t first = 0, last = 0;
        std::vector<transport::Receiver> spread;  ///< some of their receivers
    };
    /// How a group of even receivers gets the light of the guess.
    struct Sources {
        GuessPoints::Choice points;
        Sights sights;
    };
    static std::vector<Group> groups_of(std::span<const PointTile> tiles, double largest_extent_m);

    /// Sets also the known light of the groups' receivers.
    void make_sources();
    void gather(const Batch& batch, Tally& sums) const;
    void gather_general(const Batch& batch, Tally& sums) const;
    void gather_dark(const Batch& batch, Tally& sums) const;
    void connect_residual(const Batch& batch, Tally& sums) const;
    void connect(const NearNodePool& pool, std::span<const PointTile> tiles, std::span<const Group> groups,
                 math::RandomKey key, const Batch& batch, Tally& sums) const;

    const GuidedLight& light_;
    /// Empty where all receivers are even as they are: there may be millions.
    GuidedLight::Divided divided_;
    std::span<const transport::Receiver> even_;
    std::size_t lit_;                               ///< of the even ones; those behind them are dark
    std::vector<PointTile> tiles_, general_tiles_;  ///< not of dark ones
    std::vector<Group> groups_, general_groups_;
    std::vector<Sources> sources_;                ///< per group of tiles_
    std::vector<Rgb> known_;                      ///< per even receiver that is lit
    std::vector<std::vector<Rgb>> known_shares_;  ///< of the channels in it; none without channels
    const Monitor& monitor_;
};

}  // namespace stilb::estimators
