// Direct light at tiles of receivers, with as little noise as there is [LocalEstimation 3].
//
// For a receiver on a surface whose response does not depend on direction, a lamp of uniform luminance gives
//
//     response x luminance x projected solid angle x visible fraction.
//
// The projected solid angle has a closed form (lights/solid_angle/projected_solid_angle.h). The fraction is 1
// for certain where no surface lies in the shaft between tile and lamp (rays/shaft_query.h), and for readings
// 0 where one flat face hides all of the lamp: then no ray is traced. Elsewhere one shadow ray goes to a
// point that is drawn by projected solid angle, so that it is 0 or 1 but for panes: there is no noise where
// all of the lamp is seen, or nothing of it. The shadow rays of a tile form packets.
//
// Where the luminance depends on direction, as that of a luminaire's opening, a lamp that a reading sees for
// certain is integrated by quadrature, once (transport/direct/opening_lamp.h).
//
// Where lamps are many (LightSampler::chooses_extended()), readings settle those that each receiver sees for
// certain, or not at all, and choose among the others (open_lamps.h); pictures, and readings that are too
// many for that, choose some of all lamps by a tree.
//
// Point lights are exact, one packet of shadow rays each. Where there are many of them, pictures choose
// kChosen by a tree for the whole tile, with exact probabilities. All other lights, and receivers whose
// response depends on direction, are sampled as in sample_direct_from_areas() (one_receiver.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "rays/shaft_query.h"
#include "transport/direct/open_lamps.h"
#include "transport/direct/opening_lamp.h"
#include "transport/direct/uniform_lamp.h"
#include "transport/receiver.h"

namespace stilb::transport {

/// Immutable. Keeps references to its arguments.
class DirectLight {
  public:
    DirectLight(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights);

    /// Light of each of up to kPacketWidth receivers.
    struct TileLight {
        std::array<Rgb, kPacketWidth> sum{};
        std::array<LightParts, kPacketWidth>* parts = nullptr;  ///< of the sums; null where nobody asks

        Rgb& operator[](std::size_t lane) { return sum[lane]; }
        const Rgb& operator[](std::size_t lane) const { return sum[lane]; }
        LightParts* parts_of(std::size_t lane) const { return parts ? &(*parts)[lane] : nullptr; }
        void add(std::size_t lane, const Rgb& value, std::size_t light) {
            add_part(value, light, 0, sum[lane], parts_of(lane));
        }
    };

    /// The parts of a tile's light that have to be sampled.
    struct Remainder {
        /// Of few lamps: for each receiver, one bit for each that may be partly hidden: uniform lamps, then
        /// openings.
        std::array<std::uint32_t, kPacketWidth> lamps{};
        /// Of many lamps: for each receiver, those that may be partly hidden; empty where there are none.
        std::vector<OpenLamps> open;
        bool by_directions = false;    ///< lights without closed form, or receivers with gloss
        bool chooses_by_tree = false;  ///< some of all lamps, likewise by directions
        bool points = false;           ///< point lights that are chosen by the tree
        bool has_lamps() const {
            return std::ranges::any_of(lamps, [](std::uint32_t bits) { return bits != 0; });
        }
        /// Shadow rays of a sample, roughly; `receivers` of the tile.
        double rays(std::size_t receivers) const;
        bool is_empty() const { return !has_lamps() && open.empty() && !by_directions && !points; }
    };
    struct Prepared {
        std::vector<Rgb> known;             ///< of each receiver, exact
        std::vector<LightParts> parts;      ///< of `known`, where they are asked for
        std::vector<Remainder> remainders;  ///< of each tile: kPacketWidth receivers in their order
    };
    /// For receivers that stay. May use several threads.
    Prepared prepare(std::span<const Receiver> receivers, const Monitor& monitor,
                     PartsOfLight parts = PartsOfLight::none) const;
    /// Adds a sample of the remainder. `streams`: of each receiver.
    void add_sample(std::span<const Receiver> tile, const Remainder& remainder,
                    std::span<math::SampleStream> streams, TileLight& light) const;

    /// For a tile of receivers that were drawn for one sample: adds what needs no random numbers.
    Remainder add_certain(std::span<const Receiver> tile, TileLight& light) const;

    /// The largest number of point lights that pictures take one by one.
    static constexpr std::size_t kFewPoints = 16;
    /// Point lights chosen for a tile where there are more.
    static constexpr std::uint32_t kChosen = 16;

  private:
    struct ShadowRays;

    /// Point lights times receivers up to which readings take all of them once: seconds. Likewise of lamps
    /// with an area, where they are many.
    static constexpr std::size_t kMostExact = 100'000'000, kMostSettled = 300'000;

    bool has_closed_form(const Receiver& receiver) const {
        return receiver.constant_response() && !receiver.is_body();
    }
    /// Whether samples of all lights and of the response are weighted together.
    bool samples_all(const Receiver& receiver, const Remainder& remainder) const {
        return !has_closed_form(receiver) || remainder.chooses_by_tree;
    }
    /// `settles`: each receiver's many lamps are looked at.
    Remainder add_known(std::span<const Receiver> tile, bool settles, TileLight& light) const;
    void add_few_lamps(std::span<const Receiver> tile, Remainder& remainder, TileLight& light) const;
    void settle_many_lamps(std::span<const Receiver> tile, Remainder& remainder, TileLight& light) const;
    void settle_one_by_one(std::span<const Receiver> tile, Remainder& remainder, TileLight& light) const;
    void add_points(std::span<const Receiver> tile, TileLight& light) const;
    void add_point(std::span<const Receiver> tile, std::size_t point, double factor, TileLight& light) const;
    void add_chosen_points(std::span<const Receiver> tile, math::SampleStream& stream,
                           TileLight& light) const;
    /// The number of the light of a lamp, or of a surface without closed form.
    std::size_t light_of(std::size_t lamp) const;
    std::size_t lamp_count() const { return lamps_.size() + openings_.size(); }
    const LampHull& hull_of(std::size_t lamp) const;
    std::optional<Rgb> whole_lx(std::size_t lamp, const SurfacePoint& at) const;
    double rough_lx(std::size_t lamp, const SurfacePoint& at) const;
    /// The illuminance of one receiver by a lamp, where that is certain.
    std::optional<Rgb> settled_lx(std::size_t lamp, const Receiver& receiver) const;
    std::optional<DirectSample> sample_lamp(std::size_t lamp, const SurfacePoint& at,
                                            math::SampleStream& stream) const;
    void add_shadowed(std::span<const Receiver> tile, std::size_t lamp, const Remainder& remainder,
                      std::span<math::SampleStream> streams, TileLight& light) const;
    void add_chosen_lamps(std::span<const Receiver> tile, const Remainder& remainder,
                          std::span<math::SampleStream> streams, TileLight& light) const;
    void add_by_directions(std::span<const Receiver> tile, const Remainder& remainder,
                           std::span<math::SampleStream> streams, TileLight& light) const;
    void add_ray(std::span<const Receiver> tile, std::size_t lane, std::size_t light,
                 const std::array<double, 2>& u, double factor, ShadowRays& shadow_rays) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const LightSampler& lights_;
    std::vector<UniformLamp> lamps_;
    std::vector<OpeningLamp> openings_;
    /// Numbers of lights: of surfaces without closed form where lamps are many, of point lights, and of all
    /// others.
    std::vector<std::size_t> surfaces_, points_, others_;
    LightTree tree_of_points_;
    std::optional<rays::ShaftQuery> shafts_;
    bool has_many_lamps_;  ///< so many that some are chosen
};

}  // namespace stilb::transport
