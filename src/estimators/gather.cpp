#include "estimators/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/sampling.h"
#include "estimators/kernel_split.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;

/// A place y that a ray has met, and the points of the ray's packet that may see it. Keeps references.
class SharedPlace {
  public:
    SharedPlace(const Hit& hit, const Material& material, const PointTile& tile, const Vec3& center)
        : material_(material), tile_(tile), frame_(Frame::of_surface(hit.normal)) {
        connect(SegmentOrigin(hit.position, hit.lifted, hit.normal, center), tile, segments_, lanes_,
                g_per_m2_);
    }

    bool reaches(std::size_t point) const { return lanes_[point] != 0; }

    /// 1 - w as it is on average over the ways of the light, at the point where it is largest.
    double gathered_share() const {
        const double concentration = mean_concentration(material_);
        double largest = 0;
        for_each_point([&](std::size_t i) { largest = std::max(largest, share_at(i)(concentration)); });
        return largest;
    }

    /// Leaves the points that see y. `own` does: its ray has shown it.
    void test_visibility(const RayCaster& caster, std::size_t own) {
        lanes_[own] = 0;
        caster.occlude(segments_, lanes_);
        lanes_[own] = -1;
        for_each_point([&](std::size_t i) {
            if (segments_.end[i] < 0) {
                lanes_[i] = 0;
                return;
            }
            const Vec3 segment{segments_.direction_x[i], segments_.direction_y[i], segments_.direction_z[i]};
            out_[i] = frame_.to_local(normalized(segment));
        });
    }

    Vec3 direction_to(std::size_t point) const { return frame_.to_world(out_[point]); }

    /// How densely the packet's rays meet y [1/m2].
    double ray_density() const {
        double sum = 0;
        for_each_point([&](std::size_t i) { sum += double{g_per_m2_[i]} / kPi; });
        return sum;
    }

    /// How densely they meet y and go on along `direction` [1/(m2 sr)].
    double beam_density(const Vec3& direction) const {
        const Vec3 in = frame_.to_local(direction);
        double sum = 0;
        for_each_point(
            [&](std::size_t i) { sum += double{g_per_m2_[i]} / kPi * pdf_per_sr(material_, out_[i], in); });
        return sum;
    }

    /// Adds what the points receive of light that comes to y from `direction`, given its illuminance on a
    /// surface across it, over the density of y.
    void reflect(const Vec3& direction, const Spectrum& normal_illuminance, ReadingSums& sums) const {
        const Vec3 in = frame_.to_local(direction);
        for_each_point([&](std::size_t i) {
            const Spectrum brdf = evaluate_brdf_per_sr(material_, in, out_[i]);
            const double gathered = share_at(i)(relative_brdf(material_, brdf));
            sums.add(tile_.reading[i], normal_illuminance * brdf * (in.z * double{g_per_m2_[i]} * gathered));
        });
    }

  private:
    template <typename Action>
    void for_each_point(const Action& action) const {
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes_[i] != 0) action(i);
        }
    }
    GatheredShare share_at(std::size_t point) const {
        return {double{g_per_m2_[point]} * double{tile_.inverse_k[point]}};
    }

    const Material& material_;
    const PointTile& tile_;
    Frame frame_;
    RayPacket segments_;
    LaneMask lanes_;
    alignas(64) PointTile::Floats g_per_m2_;
    std::array<Vec3, kPacketWidth> out_;  ///< to the points, in the frame of y
};

}  // namespace

void Gather::collect(const Batch& batch, ReadingSums& sums) const {
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        const RandomKey key = batch.key.derived(tile);
        const std::uint64_t chains = plans_[tile * kPacketWidth].chains_per_ray;
        for (std::uint64_t i = batch.first / chains; i < (batch.first + batch.count) / chains; ++i) {
            trace_round(tile, key, i, static_cast<double>(chains), sums);
        }
    }
}

void Gather::trace_round(std::size_t tile, RandomKey key, std::uint64_t round, double weight,
                         ReadingSums& sums) const {
    const std::span<const PackedPoint> points =
        points_.subspan(tile * kPacketWidth).first(static_cast<std::size_t>(tiles_[tile].count));
    for (std::size_t i = 0; i < points.size(); ++i) {
        SampleStream stream(key.derived(i), round);
        const auto [u1, u2] = stream.next_two();
        const Vec3 direction =
            Frame::around(points[i].normal).to_world(sample_cosine_hemisphere(u1, u2).direction);
        const auto hit = caster_.closest(points[i].lifted, direction);
        if (!hit) continue;
        if (is_specular(tracer_.material(*hit))) {
            const Spectrum luminance =
                tracer_.luminance_without_direct(*hit, direction, max_reflections_, stream);
            sums.add(points[i].reading, weight * kPi * luminance);
        } else {
            share_out(*hit, tiles_[tile], i, stream, weight, sums);
        }
    }
}

void Gather::share_out(const Hit& hit, const PointTile& tile, std::size_t own, SampleStream& stream,
                       double weight, ReadingSums& sums) const {
    SharedPlace place(hit, tracer_.material(hit), tile, caster_.center());
    if (max_reflections_ == 0 || !place.reaches(own)) return;
    const double survival = place.gathered_share();
    if (stream.next() >= survival) return;
    weight /= survival;
    place.test_visibility(caster_, own);
    const double ray_density = place.ray_density();
    if (const auto light = tracer_.sample_light(hit, stream)) {
        // Beams make the light of emitters too; the balance heuristic over both.
        const double light_density = light->pdf_per_sr * ray_density;
        const double share = std::isinf(light_density)
                                 ? 1
                                 : light_density / (light_density + place.beam_density(light->direction));
        place.reflect(light->direction, light->normal_illuminance_lx * (weight * share / ray_density), sums);
    }
    if (const auto beam = tracer_.sample_beam(hit, place.direction_to(own), max_reflections_ - 1, stream)) {
        const double density = place.beam_density(beam->direction);
        if (!(density > 0)) return;
        const double emission_density = density + beam->light_pdf_per_sr * ray_density;
        place.reflect(
            beam->direction,
            beam->luminance_cd_m2 * (weight / density) + beam->emission_cd_m2 * (weight / emission_density),
            sums);
    }
}

}  // namespace stilb
