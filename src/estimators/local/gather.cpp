#include "estimators/local/gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/shaded_surface.h"
#include "math/sampling.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

/// Directions in which the light that comes to a point y is sought. Few rays get so far, and most of their
/// noise is that of what comes next: a bright spot under the ceiling, say (docs/lab-book.md).
constexpr int kBeams = 2;

/// A point y that a ray has met, and the receivers of the ray's packet that may see it. Keeps references.
class SharedPoint {
  public:
    /// `from`: the place where light arrives, by the scattering of a path that has met `hit`. Light for
    /// receivers that are farther from their sensors may have met fewer surfaces: only receivers with the
    /// same count as `own` share.
    SharedPoint(const rays::Hit& hit, const rays::Hit& from, const transport::LobeChoice& scattering,
                const PointTile& tile, std::size_t own, const Vec3& center)
        : surface_(*scattering.material, from.normal, from.shading_normal),
          sent_on_(scattering.sent_on),
          met_(hit),
          crosses_(from.on_front != hit.on_front),
          tile_(tile) {
        // There is at least one reflection, at y.
        connect(SegmentOrigin(hit, center), 1, tile, segments_, lanes_, g_per_m2_);
        for_each_lane([&](std::size_t i) {
            if (tile.reflections_left[i] == tile.reflections_left[own]) {
                const auto [value, relative] = response_to_y(i);
                response_[i] = value;
                relative_response_[i] = relative;
            } else {
                lanes_[i] = 0;
            }
        });
    }

    bool reaches(std::size_t lane) const { return lanes_[lane] != 0; }

    /// 1 - w, averaged over the directions of the light, at the receiver where it is largest.
    double gathered_share() const {
        const double concentration = mean_concentration(surface_.material());
        double largest = 0;
        for_each_lane([&](std::size_t i) { largest = std::max(largest, share_at(i)(concentration)); });
        return largest;
    }

    /// Keeps only the receivers that see y, and computes their directions and ray densities, which all
    /// functions below need. `own` sees y: its ray has met it.
    void keep_visible(const rays::RayCaster& caster, std::size_t own) {
        lanes_[own] = 0;
        caster.occlude(segments_, lanes_);
        lanes_[own] = -1;
        for_each_lane([&](std::size_t i) {
            if (segments_.end[i] < 0) {
                lanes_[i] = 0;
            } else {
                join(i);
            }
        });
    }

    /// A direction of incident light at y, drawn by the BRDF as a receiver sees y.
    struct Beam {
        Vec3 direction;
        double density = 0;  ///< of y and the direction together, over all receivers' rays [1/(m2 sr)]
        double weight = 0;   ///< 1 / probability of having survived
    };
    std::optional<Beam> sample_beam(std::size_t lane, math::SampleStream& stream) const {
        const double survival = transport::survival_probability(Rgb::grey(1), sent_on_);
        if (stream.next() >= survival) return std::nullopt;
        const auto [u1, u2] = stream.next_two();
        const auto scattered = surface_.sample_incoming(out_[lane], u1, u2);
        if (!scattered) return std::nullopt;
        const Vec3 direction = surface_.frame().to_world(scattered->direction);
        const double density = beam_density(direction);
        if (!(density > 0)) return std::nullopt;
        return Beam{direction, density, 1 / survival};
    }

    /// The density with which the packet's rays meet y [1/m2].
    double ray_density() const {
        double sum = 0;
        for_each_lane([&](std::size_t i) { sum += ray_density_per_m2_[i]; });
        return sum;
    }

    /// The density with which they meet y and continue along `direction` [1/(m2 sr)].
    double beam_density(const Vec3& direction) const {
        const Vec3 in = surface_.frame().to_local(direction);
        double sum = 0;
        for_each_lane([&](std::size_t i) {
            sum += ray_density_per_m2_[i] * surface_.pdf_of_incoming_per_sr(out_[i], in);
        });
        return sum;
    }

    /// Adds to the readings the light that comes to y from `direction`, given its illuminance on a surface
    /// across it, over the density of y: that is `weight` times its parts. `channels`: null, or those of the
    /// readings.
    void reflect(const Vec3& direction, const Rgb& normal_illuminance,
                 std::span<const transport::LightPart> parts, double weight,
                 const transport::Channels* channels, Tally& sums) const {
        const Vec3 in = surface_.frame().to_local(direction);
        for_each_lane([&](std::size_t i) {
            const transport::Receiver& receiver = tile_.receivers[i];
            const Rgb brdf = surface_.brdf_per_sr(in, out_[i]);
            const double gathered = share_at(i)(
                transport::bounding_brdf(transport::relative_brdf(surface_.material(), brdf), tile_.choice));
            const double factor = in.z * double{g_per_m2_[i]} * gathered;
            sums.add(receiver.reading(), normal_illuminance * brdf * response_[i] * factor);
            if (channels)
                channels->add(parts, brdf * response_[i] * (factor * weight), receiver.reflections() + 1,
                              receiver.reading(), sums.parts);
        });
    }

  private:
    template <typename Action>
    void for_each_lane(const Action& action) const {
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes_[i] != 0) action(i);
        }
    }
    transport::GatheredShare share_at(std::size_t lane) const {
        return {double{g_per_m2_[lane]} * double{tile_.inverse_k[lane]} * relative_response_[lane]};
    }

    Vec3 towards_receiver(std::size_t i) const {
        return normalized(Vec3{segments_.direction_x[i], segments_.direction_y[i], segments_.direction_z[i]});
    }

    transport::Receiver::Response response_to_y(std::size_t i) const {
        const transport::Receiver& receiver = tile_.receivers[i];
        const auto& constant = receiver.constant_response();
        return constant ? transport::Receiver::Response{*constant} : receiver.response(-towards_receiver(i));
    }

    void join(std::size_t i) {
        const Vec3 segment = towards_receiver(i);
        out_[i] = surface_.frame().to_local(crosses_ ? met_.mirrored(segment) : segment);
        const transport::Receiver& receiver = tile_.receivers[i];
        if (receiver.constant_response()) {
            ray_density_per_m2_[i] = double{g_per_m2_[i]} / kPi;
            return;
        }
        const double squared_distance = squared_length(receiver.position() - met_.position);
        ray_density_per_m2_[i] = receiver.pdf_per_sr(-segment) * out_[i].z / squared_distance;
    }

    materials::ShadedSurface surface_;  ///< on the side where light arrives
    Rgb sent_on_;
    const rays::Hit& met_;  ///< on that of the receivers
    bool crosses_;
    const PointTile& tile_;
    RayPacket segments_;
    LaneMask lanes_;
    alignas(64) PointTile::Floats g_per_m2_;
    std::array<Rgb, kPacketWidth> response_;  ///< of the receivers to light from y
    std::array<Vec3, kPacketWidth> out_;      ///< to the receivers that see y, in its frame
    std::array<double, kPacketWidth> relative_response_, ray_density_per_m2_;
};

}  // namespace

void Gather::collect(const Batch& batch, Tally& sums) const {
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        monitor_.require_more();
        const math::RandomKey key = batch.key.derived(BatchStream::gather).derived(tile);
        const std::uint64_t light_paths = plans_[tile * kPacketWidth].paths_per_ray;
        for (std::uint64_t i = batch.first / light_paths; i < (batch.first + batch.count) / light_paths;
             ++i) {
            trace_round(tiles_[tile], key, i, static_cast<double>(light_paths), sums);
        }
    }
}

void Gather::trace_round(const PointTile& tile, math::RandomKey key, std::uint64_t round, double weight,
                         Tally& sums) const {
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        math::SampleStream stream(key.derived(i), round);
        const transport::Receiver& receiver = tile.receivers[i];
        const auto [u1, u2] = stream.next_two();
        const auto sample = receiver.sample(u1, u2);
        if (!sample) continue;
        const auto hit = caster_.closest(receiver.lifted(), sample->direction);
        if (!hit) continue;
        // A number is looked at only: path tracing chooses the same.
        math::SampleStream next = stream;
        rays::Hit from = *hit;
        Vec3 back = -sample->direction;
        const auto scattering =
            transport::choose_lobe(tracer_.material(*hit), from, back, transport::Carried::luminance, next);
        if (!scattering) continue;
        if (is_specular(*scattering->material)) {
            transport::LightParts parts;
            const Rgb luminance = tracer_.luminance_without_direct(
                *hit, sample->direction, tile.reflections_left[i], stream, channels_ ? &parts : nullptr);
            sums.add(receiver.reading(), weight * sample->weight * luminance);
            if (channels_)
                channels_->add(parts, weight * sample->weight, receiver.reflections(), receiver.reading(),
                               sums.parts);
        } else {
            share_out(*hit, from, *scattering, tile, i, next, weight, sums);
        }
    }
}

void Gather::share_out(const rays::Hit& hit, const rays::Hit& from, const transport::LobeChoice& scattering,
                       const PointTile& tile, std::size_t own, math::SampleStream& stream, double weight,
                       Tally& sums) const {
    SharedPoint shared(hit, from, scattering, tile, own, caster_.center());
    if (!shared.reaches(own)) return;
    weight *= scattering.weight;
    const double survival = shared.gathered_share();
    if (stream.next() >= survival) return;
    weight /= survival;
    shared.keep_visible(caster_, own);
    const double ray_density = shared.ray_density();
    if (const auto light = tracer_.sample_light(from, stream)) {
        // BRDF samples may hit emitters, too; the balance heuristic weights both techniques.
        const double light_density = light->pdf_per_sr * ray_density;
        const double share =
            std::isinf(light_density)
                ? 1
                : light_density / (light_density + kBeams * shared.beam_density(light->direction));
        const double of_light = weight * share / ray_density;
        const transport::LightPart part{light->normal_illuminance_lx, light->light, 0};
        shared.reflect(light->direction, light->normal_illuminance_lx * of_light, {&part, 1}, of_light,
                       channels_, sums);
    }
    for (int i = 0; i < kBeams; ++i) {
        const auto beam = shared.sample_beam(own, stream);
        if (!beam) continue;
        const transport::PreviousVertex previous_vertex{kBeams * beam->density / ray_density, from.position,
                                                        from.normal};
        transport::LightParts parts;
        const Rgb luminance =
            tracer_.incoming_luminance({from.lifted, beam->direction}, previous_vertex,
                                       tile.reflections_left[own] - 1, stream, channels_ ? &parts : nullptr);
        const double of_beam = weight * beam->weight / (kBeams * beam->density);
        shared.reflect(beam->direction, luminance * of_beam, parts, of_beam, channels_, sums);
    }
}
}  // namespace stilb::estimators
