#include "estimators/local/guess/residual_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "estimators/limits.h"
#include "estimators/local/guess/part_reflection.h"
#include "materials/shaded_surface.h"
#include "transport/lobe_choice.h"
#include "transport/receiver.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

/// Packets of rays on which a path's start spends its r: all receivers share it.
constexpr std::uint64_t kResidualPackets = 2;
/// Samples of direct light there, where they differ.
constexpr std::uint32_t kResidualDirect = 8;
/// Paths that go on from a start, which costs more than they do. A power of two.
constexpr std::uint32_t kBranches = 4;
/// Paths start with a density that is at least this share of what it would be if r were as large as the
/// guess; and so many of them, beside the others, evenly over all sides: light that the pilot has missed must
/// not be rare.
constexpr double kFloor = 0.1;
constexpr double kEvenShare = 0.1;
/// Sides get favour (LightVertex::favour) where the pilot finds less than this share of what they get evenly:
/// those of a room whose lamps are much weaker than those of other rooms.
constexpr double kWeakSide = 0.1;
/// Points of each side at which r is estimated for that.
constexpr std::uint64_t kPilots = 2;

Rgb magnitude(const Rgb& value) { return {{std::abs(value[0]), std::abs(value[1]), std::abs(value[2])}}; }

/// The reflected light, regardless of its sign: shares of channels do not cancel each other.
double magnitude_of(const transport::LightSum& light, const Rgb& reflectance) {
    if (light.shares.empty()) return magnitude(light.whole * reflectance).luminance();
    double sum = 0;
    for (const Rgb& share : light.shares) sum += magnitude(share * reflectance).luminance();
    return sum;
}

/// The direction of one of several arrivals, chosen in proportion to its light, with the light of all.
class ChosenArrival {
  public:
    /// `u`: in [0, 1).
    ChosenArrival(double u, const transport::Channels* channels) : u_(u), light_(channels) {}

    /// `set(sum)`: adds the shares of the arriving light to an empty sum.
    template <typename Set>
    void add(const Vec3& direction, const Rgb& arriving, const Set& set) {
        const double light = arriving.luminance();
        if (!(light > 0)) return;
        sum_ += light;
        const double probability = light / sum_;
        if (u_ < probability) {
            direction_ = direction;
            light_ *= Rgb{};
            set(light_);
            light_.whole = arriving;
            light_ *= Rgb::grey(1 / light);
            u_ /= probability;
        } else {
            u_ = (u_ - probability) / (1 - probability);
        }
    }
    const Vec3& direction() const { return direction_; }
    transport::LightSum light() const {
        transport::LightSum all = light_;
        return all *= Rgb::grey(sum_);
    }

  private:
    double u_, sum_ = 0;
    Vec3 direction_;
    transport::LightSum light_;
};

}  // namespace

ResidualLight::ResidualLight(const Scene& scene, const rays::RayCaster& caster,
                             const transport::LightSampler& lights, const BoundedDirect& direct,
                             const transport::PathTracer& tracer, const LightGuess& guess,
                             math::RandomKey key, const Monitor& monitor)
    : scene_(scene),
      caster_(caster),
      lights_(lights),
      direct_(direct),
      tracer_(tracer),
      guess_(guess),
      has_light_for_light_paths_only_(has_light_for_light_paths_only(scene)),
      area_m2_(guess.lit_area_m2()) {
    const patches::Patches& patches = guess.patches();
    for (std::uint32_t side = 0; side < 2 * patches.count(); ++side) {
        if (guess.material(side).reflects()) sides_.push_back(side);
    }
    const auto has_guess = [&](std::uint32_t side) {
        return guess.material(side).diffuse_reflectance.max() > 0;
    };
    std::vector<double> weights(sides_.size());
    parallel_for_parts(
        sides_.size(),
        [&](std::size_t first, std::size_t last) {
            monitor.require_more();
            for (std::size_t i = first; i < last; ++i) {
                if (!has_guess(sides_[i]) || std::ranges::binary_search(guess.lit_sides(), sides_[i]))
                    weights[i] = pilot(sides_[i], key);
            }
        },
        64);
    double sum = 0, area_m2 = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i)
        sum += weights[i], area_m2 += double{patches.areas_m2[patches.patch_of(sides_[i])]};
    const double evenly = sum > 0 ? kEvenShare * sum / area_m2 : 1;
    favours_.assign(sides_.size(), 1);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const double own_m2 = double{patches.areas_m2[patches.patch_of(sides_[i])]};
        if (weights[i] > 0 && !has_guess(sides_[i])) area_m2_ += own_m2;
        const double even = evenly * own_m2;
        if (weights[i] > 0 && weights[i] < kWeakSide * even) favours_[i] = even / weights[i];
        weights[i] += even;
    }
    if (!sides_.empty()) by_residual_ = math::DiscreteDistribution(weights);
}

/// The root mean square of r over a side, times its area.
double ResidualLight::pilot(std::uint32_t side, math::RandomKey key) const {
    const materials::SplitMaterial& material = guess_.material(side);
    double square = 0;
    for (std::uint64_t k = 0; k < kPilots; ++k) {
        math::SampleStream stream(key.derived(side), k, 4);
        const auto u = stream.next_two();
        const Start start =
            start_at(side, math::sample_triangle(u[0], u[1]), 1, BoundedDirect::Part::bounded, stream);
        const double missing = magnitude_of(start.missing_lx, material.diffuse_reflectance) / kPi;
        const double guessed = start.guessed_cd_m2.whole.luminance();
        square += missing * missing + kFloor * kFloor * guessed * guessed;
        if (!material.gloss) continue;
        const double gloss = magnitude_of(start.arriving_lx, material.gloss_reflectance()) / kPi;
        square += gloss * gloss * mean_concentration(*material.gloss);
    }
    return double{guess_.patches().areas_m2[guess_.patches().patch_of(side)]} *
           std::sqrt(square / static_cast<double>(kPilots));
}

template <typename Chosen>
transport::LightSum ResidualLight::arriving_at(const SurfacePoint& point, std::uint64_t packets,
                                               BoundedDirect::Part part, math::SampleStream& stream,
                                               Chosen& chosen) const {
    const transport::Channels* const channels = guess_.channels();
    transport::LightSum arriving_lx(channels);
    const Frame frame = Frame::around(point.normal);
    direct_.sample(point, part, kResidualDirect, stream, [&](const Arrival& arrival) {
        arriving_lx.add(arrival.illuminance_lx, arrival.light);
        chosen.add(arrival.direction, arrival.illuminance_lx,
                   [&](transport::LightSum& sum) { sum.add(arrival.illuminance_lx, arrival.light); });
    });
    const std::array<double, 2> shift = stream.next_two();
    const auto rays = static_cast<std::uint32_t>(packets * kPacketWidth);
    const double per_ray = kPi / rays;
    rays::RayHitPacket packet;
    LaneMask lanes;
    lanes.fill(-1);
    GuessedLight light;
    for (std::uint32_t first = 0; first < rays; first += kPacketWidth) {
        std::array<Vec3, kPacketWidth> directions;
        for (std::uint32_t i = 0; i < kPacketWidth; ++i) {
            const auto [u1, u2] = math::even_point(first + i, rays, shift);
            directions[i] = frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
            packet.ray.set(i, point.lifted - caster_.center(), directions[i],
                           std::numeric_limits<float>::infinity());
        }
        guess_.look(packet, lanes, rays::Coherence::scattered, light);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if ((light.traced_lanes >> i & 1u) != 0) {
                transport::LightSum traced_lx(channels);
                if (const auto hit = caster_.closest(point.lifted, directions[i]))
                    traced_lx.add_sample(Rgb::grey(per_ray), [&](auto* parts) {
                        return tracer_.luminance_without_direct(*hit, directions[i], transport::kUnlimited,
                                                                stream, parts);
                    });
                arriving_lx.add(traced_lx, Rgb::grey(1));
                chosen.add(directions[i], traced_lx.whole,
                           [&](transport::LightSum& sum) { sum.add(traced_lx, Rgb::grey(1)); });
                continue;
            }
            const Rgb illuminance_lx = light.luminance_of(i) * per_ray;
            arriving_lx.whole += illuminance_lx;
            const auto add_shares = [&](transport::LightSum& sum) {
                guess_.add_shares(light.sides[i], light.barycentric_of(i), per_ray, sum.shares);
            };
            add_shares(arriving_lx);
            chosen.add(directions[i], illuminance_lx, add_shares);
        }
    }
    arriving_lx.reflect();
    return arriving_lx;
}

auto ResidualLight::start_at(std::uint32_t side, const math::Barycentric& at, std::uint64_t packets,
                             BoundedDirect::Part part, math::SampleStream& stream) const -> Start {
    const patches::Patches& patches = guess_.patches();
    const transport::Channels* const channels = guess_.channels();
    const materials::SplitMaterial& material = guess_.material(side);
    Start start{side_point(patches, caster_, side, at),
                guess_.at(side, at),
                transport::LightSum(channels),
                {},
                transport::LightSum(channels)};
    // Without gloss nothing asks for the light of one direction.
    ChosenArrival chosen(stream.next(), material.gloss ? channels : nullptr);
    transport::LightSum& missing_lx = start.missing_lx;
    missing_lx = arriving_at(start.point, packets, part, stream, chosen);
    if (material.transmitted.max() > 0) {
        const SurfacePoint other = side_point(patches, caster_, patches.other_side(side), at);
        missing_lx *= material.own_share();
        missing_lx.add(arriving_at(other, packets, part, stream, chosen), material.other_share());
    }
    start.direction = chosen.direction();
    start.arriving_lx = chosen.light();
    start.arriving_lx.reflect();
    const transport::LightSum& guessed = start.guessed_cd_m2;
    const Rgb& reflectance = material.diffuse_reflectance;
    const auto subtract = [&](const Rgb& luminance_cd_m2, Rgb& from_lx) {
        for (std::size_t b = 0; b < kBands; ++b) {
            if (reflectance[b] > 0) from_lx[b] -= luminance_cd_m2[b] * kPi / reflectance[b];
        }
    };
    subtract(guessed.whole, missing_lx.whole);
    for (std::size_t c = 0; c < guessed.shares.size(); ++c) subtract(guessed.shares[c], missing_lx.shares[c]);
    return start;
}

transport::LightSum ResidualLight::missing_cd_m2(std::uint32_t side, const math::Barycentric& at,
                                                 math::SampleStream& stream) const {
    // A walk, not a recursion: in white rooms it takes thousands of steps.
    std::vector<Step> steps;
    Around next{side, at, transport::LightSum(guess_.channels())};
    while (next.side != patches::kNoSide) {
        const Start start = start_at(next.side, next.at, 1, BoundedDirect::Part::all, stream);
        const materials::SplitMaterial& material = guess_.material(next.side);
        const Rgb& reflectance = material.diffuse_reflectance;
        // The factor of a step is reflectance / survival: its square times survival must be less than 1.
        const double survival = transport::survival_probability(Rgb::grey(1), reflectance);
        steps.push_back({start.missing_lx, reflectance, survival, Rgb::grey(1)});
        if (stream.next() >= survival) {
            next = {patches::kNoSide, {}, transport::LightSum(guess_.channels())};
        } else if (!(material.transmitted.max() > 0)) {
            next = look_around(start.point, stream);
        } else {
            const double other = material.other_share().luminance();
            const bool crosses = stream.next() < other;
            steps.back().share =
                crosses ? material.other_share() * (1 / other) : material.own_share() * (1 / (1 - other));
            next = look_around(crosses ? side_point(guess_.patches(), caster_,
                                                    guess_.patches().other_side(next.side), next.at)
                                       : start.point,
                               stream);
        }
    }
    transport::LightSum missing = std::move(next.missing_cd_m2);
    std::ranges::reverse(steps);
    for (Step& step : steps) {
        missing.reflect();
        if (step.survival > 0) step.missing_lx.add(missing *= step.share * kPi, Rgb::grey(1 / step.survival));
        missing = std::move(step.missing_lx *= step.reflectance * (1 / kPi));
    }
    return missing;
}

auto ResidualLight::look_around(const SurfacePoint& point, math::SampleStream& stream) const -> Around {
    const auto [u1, u2] = stream.next_two();
    const Vec3 direction =
        Frame::around(point.normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    rays::RayHitPacket packet;
    LaneMask lanes{};
    lanes[0] = -1;
    packet.ray.set(0, point.lifted - caster_.center(), direction, std::numeric_limits<float>::infinity());
    GuessedLight light;
    guess_.look(packet, lanes, rays::Coherence::scattered, light);
    const std::uint32_t side = light.sides[0];
    Around around{patches::kNoSide, {}, transport::LightSum(guess_.channels())};
    // Traced surfaces lack nothing.
    if (side == patches::kNoSide || (light.traced_lanes & 1u) != 0) return around;
    if (!guess_.material(side).gloss) {
        around.side = side;
        around.at = light.barycentric_of(0);
        return around;
    }
    const auto hit = caster_.closest(point.lifted, direction);
    if (!hit) return around;
    around.missing_cd_m2.add_sample(Rgb::grey(1), [&](auto* parts) {
        return tracer_.luminance_without_direct(*hit, direction, transport::kUnlimited, stream, parts);
    });
    around.missing_cd_m2.add(guess_.seen(light, 0), Rgb::grey(-1));
    return around;
}

std::vector<transport::LightVertex> ResidualLight::trace(math::KeyOf<Stream> key, std::uint64_t first,
                                                         std::uint64_t end) const {
    std::vector<transport::LightVertex> nodes;
    if (!sides_.empty()) {
        for (std::uint64_t path = first; path < end; ++path)
            trace_one(math::SampleStream(key.derived(Stream::paths), path, 8), nodes);
    }
    for (std::uint64_t path = first; direct_.has_particles() && path < end; ++path)
        trace_particle(math::SampleStream(key.derived(Stream::particles), path, 8), nodes);
    if (has_light_for_light_paths_only_)
        trace_light_paths_only(key.derived(Stream::light_paths), first, end, nodes);
    return nodes;
}

void ResidualLight::trace_light_paths_only(math::RandomKey key, std::uint64_t first, std::uint64_t end,
                                           std::vector<transport::LightVertex>& nodes) const {
    for (const transport::LightVertex& node :
         transport::trace_light_paths(scene_, caster_, lights_, transport::kUnlimited, key, first, end)) {
        if (node.only_by_light) nodes.push_back(node);
    }
}

void ResidualLight::add(const transport::LightVertex& whole, const materials::SplitMaterial& parts,
                        std::vector<transport::LightVertex>& nodes) const {
    const auto add_part = [&](const Material& material) {
        nodes.push_back(whole);
        nodes.back().material = &material;
    };
    if (parts.diffuse_reflectance.max() > 0) add_part(parts.diffuse);
    if (!parts.gloss) return;
    add_part(*parts.gloss);
    nodes.back().split = split_of_gloss(parts);
}

void ResidualLight::add_all(const rays::Hit& hit, const Vec3& direction,
                            const materials::SplitMaterial& parts, const transport::LightVertex& carried,
                            std::vector<transport::LightVertex>& nodes) const {
    const auto vertex_at = [&](const rays::Hit& place, const Vec3& towards_light, const Material& material) {
        transport::LightVertex vertex = carried;
        static_cast<SurfacePoint&>(vertex) = place;
        vertex.shading_normal = place.normal;
        vertex.incoming = towards_light;
        vertex.material = &material;
        return vertex;
    };
    const Material& material = scene_.material(hit.material);
    const auto lobes = transport::lobes_at(hit, material, transport::Carried::flux);
    if (lobes.empty()) return add(vertex_at(hit, -direction, material), parts, nodes);
    for (const materials::Lobe& lobe : lobes) {
        rays::Hit place = hit;
        Vec3 towards_light = -direction;
        transport::cross(lobe, place, towards_light);
        nodes.push_back(vertex_at(place, towards_light, lobe.scattering));
    }
}

void ResidualLight::trace_one(math::SampleStream stream, std::vector<transport::LightVertex>& nodes) const {
    const patches::Patches& patches = guess_.patches();
    const math::DiscreteChoice choice = by_residual_.choose(stream.next());
    const std::uint32_t side = sides_[choice.index];
    const auto u = stream.next_two();
    const math::Barycentric at = math::sample_triangle(u[0], u[1]);
    if (!guess_.shared_places().owns(side, at)) return;
    const Start start = start_at(side, at, kResidualPackets, BoundedDirect::Part::bounded, stream);
    const double per_density = double{patches.areas_m2[patches.patch_of(side)]} / choice.probability;
    const materials::SplitMaterial& parts = guess_.material(side);
    const Vec3& normal = start.point.normal;
    // The direction of the light that comes in does not matter for the diffuse part.
    transport::LightVertex diffuse{
        start.point, normal, normal, &parts.diffuse, start.missing_lx.whole * per_density, 1};
    diffuse.shares = start.missing_lx.relative_shares();
    transport::LightVertex gloss = diffuse;
    gloss.incoming = start.direction;
    gloss.material = parts.gloss ? &*parts.gloss : nullptr;
    gloss.flux_lm = start.arriving_lx.whole * per_density;
    gloss.split = split_of_gloss(parts);
    gloss.shares = start.arriving_lx.relative_shares();
    // Where shares have different signs, they are more than the whole.
    const double reflected = magnitude(start.missing_lx.whole * parts.diffuse_reflectance).luminance();
    if (diffuse.shares && reflected > 0)
        diffuse.favour = magnitude_of(start.missing_lx, parts.diffuse_reflectance) / reflected;
    const std::size_t own = nodes.size();
    if (diffuse.flux_lm * parts.diffuse_reflectance != Rgb{}) nodes.push_back(diffuse);
    if (gloss.flux_lm * parts.gloss_reflectance() != Rgb{}) nodes.push_back(gloss);
    branch_out(parts, diffuse, gloss, stream, nodes);
    const double favour = favours_[choice.index];
    for (transport::LightVertex& node : std::span(nodes).subspan(own)) node.favour *= favour;
}

void ResidualLight::branch_out(const materials::SplitMaterial& parts, const transport::LightVertex& diffuse,
                               const transport::LightVertex& gloss, math::SampleStream& stream,
                               std::vector<transport::LightVertex>& nodes) const {
    const double of_diffuse =
        diffuse.favour * magnitude(diffuse.flux_lm * parts.diffuse_reflectance).luminance();
    const double sum = of_diffuse + (gloss.flux_lm * parts.gloss_reflectance()).luminance();
    if (!(sum > 0)) return;
    const Vec3& normal = diffuse.normal;
    const double first = stream.next();
    const std::array<double, 2> shift = stream.next_two();
    for (std::uint32_t i = 0; i < kBranches; ++i) {
        const bool is_diffuse = (i + first) / kBranches < of_diffuse / sum;
        const transport::LightVertex& start = is_diffuse ? diffuse : gloss;
        const Rgb& reflectance = is_diffuse ? parts.diffuse_reflectance : parts.gloss_reflectance();
        const double survival = transport::survival_probability(magnitude(start.flux_lm), reflectance);
        if (stream.next() >= survival) continue;
        const auto [u1, u2] = math::even_point(i, kBranches, shift);
        const materials::ShadedSurface surface(*start.material, normal, normal);
        const auto scattered = surface.sample_outgoing(surface.frame().to_local(start.incoming), u1, u2);
        if (!scattered) continue;
        const Vec3 direction = surface.frame().to_world(scattered->direction);
        const double probability = survival * (is_diffuse ? of_diffuse : sum - of_diffuse) / sum;
        transport::LightVertex from = start;
        from.flux_lm = start.flux_lm * scattered->weight * (1 / (kBranches * probability));
        walk(caster_.closest(start.lifted, direction), direction, std::move(from), stream, nodes);
    }
}

void ResidualLight::trace_particle(math::SampleStream stream,
                                   std::vector<transport::LightVertex>& nodes) const {
    const auto particle = direct_.sample_particle(stream);
    if (!particle) return;
    transport::LightVertex lamp;
    lamp.flux_lm = particle->flux_lm;
    lamp.favour = particle->favour;
    lamp.light = particle->light;
    walk(particle->hit, particle->direction, std::move(lamp), stream, nodes);
}

void ResidualLight::walk(std::optional<rays::Hit> hit, Vec3 direction, transport::LightVertex from,
                         math::SampleStream& stream, std::vector<transport::LightVertex>& nodes) const {
    transport::LightVertex vertex = std::move(from);
    vertex.split = 1;
    while (hit && !guess_.is_traced(*hit)) {
        const materials::SplitMaterial& parts = guess_.material(hit->material);
        if (!parts.reflects()) return;
        ++vertex.reflections;
        add_all(*hit, direction, parts, vertex, nodes);
        Vec3 towards_light = -direction;
        const auto scattering = transport::choose_lobe(scene_.material(hit->material), *hit, towards_light,
                                                       transport::Carried::flux, stream);
        if (!scattering) return;
        const double survival =
            transport::survival_probability(magnitude(vertex.flux_lm), scattering->sent_on);
        if (stream.next() >= survival) return;
        const auto [u1, u2] = stream.next_two();
        const materials::ShadedSurface surface(*scattering->material, hit->normal, hit->normal);
        const auto scattered = surface.sample_outgoing(surface.frame().to_local(towards_light), u1, u2);
        if (!scattered) return;
        vertex.flux_lm *= scattered->weight * (scattering->weight / survival);
        direction = surface.frame().to_world(scattered->direction);
        hit = caster_.closest(hit->lifted, direction);
    }
}

}  // namespace stilb::estimators
