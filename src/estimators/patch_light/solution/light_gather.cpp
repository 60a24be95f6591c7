#include "estimators/patch_light/solution/light_gather.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "math/sampling.h"
#include "stilb/error.h"
#include "transport/receiver.h"

namespace stilb::estimators {
namespace {

/// Vertices whose rays are followed together.
constexpr std::size_t kTogether = 32;
/// Rays start so far from the vertex towards the middle of a patch around it, because a vertex may lie where
/// two objects touch.
constexpr double kShareToMiddle = 0.2;
/// Rays that tell whether a place is covered by another object.
constexpr std::uint32_t kRaysToCover = 8;

/// From then on the light gathered twice is gathered again: by and by all reflections are seen from vertices,
/// and the error of the patches, which lack light by mirrors, leaves the result.
constexpr std::uint64_t kStepsToTrustSecond = 4;

std::vector<ReflectionTable> tables_of(const Scene& scene, int degree) {
    std::vector<ReflectionTable> tables(scene.materials.size());
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const Material& material = scene.materials[i].material;
        if (!reflects_nothing(material)) tables[i] = make_reflection_table(material, degree);
    }
    return tables;
}

HalfRgb stored(const Rgb& term) {
    constexpr double largest = 65504;
    if (std::max(term.max(), -term.min()) <= largest) return to_half_rgb(term);
    throw InputError(
        "after a reflection there is light of more than 116,000 lx, which a solution cannot store. Needed: "
        "lamps with less flux (the result is in proportion to it).");
}

/// The sides of vertices of patches that reflect light.
std::vector<std::uint32_t> reflecting_vertices(const PatchTransport& coarse, const patches::FinePatches& fine,
                                               const std::vector<bool>& is_lit) {
    const patches::Patches& patches = fine.patches;
    std::vector<bool> reflects(2 * patches.vertices.size());
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const std::uint32_t front = fine.parents[p], back = coarse.patches.other_side(front);
        const auto is_bright = [&](std::uint32_t side) {
            return is_lit[side] && !reflects_nothing(coarse.material_of(side));
        };
        for (const std::uint32_t corner : patches.corners[p]) {
            if (is_bright(front)) reflects[corner] = true;
            if (is_bright(back)) reflects[corner + patches.vertices.size()] = true;
        }
    }
    std::vector<std::uint32_t> sides;
    for (std::uint32_t side = 0; side < reflects.size(); ++side) {
        if (reflects[side]) sides.push_back(side);
    }
    return sides;
}

}  // namespace

struct LightGather::GatheredRay {
    std::uint32_t vertex = 0, replicate = 0;
    Vec3 local_direction;
    rays::Ray ray;
    transport::Path path;
    bool stands = false;             ///< on a surface that scatters
    std::span<Rgb> once{}, twice{};  ///< of groups [cd/m2]
    /// What is gathered twice, by all groups, if its replicate were alone. A sum of terms of which none is
    /// negative: a difference from the light of all replicates would leave rounding errors of either sign.
    Rgb own_cd_m2{};
};

/// Corners of a patch that carry light.
struct LightGather::LitCorners {
    std::size_t count = 0;
    std::array<std::uint32_t, 3> numbers{};
    std::array<double, 3> sums{};  ///< of the barycentric coordinates so far
    /// The illuminance that one replicate found there, divided by the mean of all replicates.
    double source_share = 0;

    std::uint32_t chosen(double u) const {
        std::size_t c = 0;
        while (c + 1 < count && sums[c] <= u * sums[count - 1]) ++c;
        return numbers[c];
    }
};

LightGather::LightGather(const PatchTransport& coarse, const TermSums& walks, std::size_t replicates,
                         const std::vector<bool>& is_lit, const patches::FinePatches& fine,
                         const LightGroups& groups, math::RandomKey key, const Monitor& monitor)
    : coarse_(coarse),
      walks_(walks),
      replicates_(replicates),
      fine_(fine),
      groups_(groups),
      key_(key),
      monitor_(monitor),
      fine_caster_(fine.patches),
      basis_(walks.layout().basis().degree()),
      tables_(tables_of(coarse.scene, basis_.degree())),
      lights_(coarse.scene, coarse.caster, groups, [](std::size_t) { return true; }),
      tracer_(coarse.scene, coarse.caster, coarse.lights),
      vertices_(coarse.scene, fine.patches, basis_.degree(), reflecting_vertices(coarse, fine, is_lit)) {
    const auto is_replaced = [&](std::size_t light) { return coarse.first_shot.replaces(light); };
    for (std::size_t light = 0; light < coarse.scene.lights.size() && !replaced_lights_; ++light) {
        if (!is_replaced(light)) replaced_lights_.emplace(coarse.scene, coarse.caster, groups, is_replaced);
    }
    find_origins(is_lit);
    add_direct_light();
    require_storable({.patches = fine.patches.count(),
                      .vertices = fine.patches.vertices.size(),
                      .lit_vertices = vertices_.count(),
                      .terms = vertices_.terms(),
                      .groups = groups.count(),
                      .replicates = replicates});
    sums_.resize(groups.count() * vertices_.terms());
    replicate_lx_.resize(vertices_.count() * replicates_);
    difference_lx_.resize(vertices_.count());
}

/// Drops vertices that are covered all around: nothing reaches them.
void LightGather::find_origins(const std::vector<bool>& is_lit) {
    const patches::Patches& patches = fine_.patches;
    std::vector<std::vector<SurfacePoint>> of_vertices(vertices_.count());
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const Vec3 middle = patches.middle(p);
        for (const std::uint32_t corner : patches.corners[p]) {
            const Vec3 place = patches.center + Vec3(patches.vertices[corner]);
            const Vec3 inside = place + kShareToMiddle * (middle - place);
            for (const std::uint32_t side : {p, patches.other_side(p)}) {
                const std::uint32_t number = vertices_.number_of(corner, side);
                if (number == LightVertices::kDark) continue;
                of_vertices[number].push_back(
                    {inside, patches.normal_of(side),
                     lifted_off(coarse_.scene, patches, coarse_.caster, side, inside)});
            }
        }
    }
    const auto drop_covered = [&](std::size_t first, std::size_t last) {
        monitor_.require_more();
        for (std::size_t i = first; i < last; ++i)
            std::erase_if(of_vertices[i],
                          [&](const SurfacePoint& origin) { return is_covered(origin, is_lit); });
    };
    parallel_for_parts(of_vertices.size(), drop_covered, kTogether);
    std::vector<std::uint32_t> lit;
    first_origin_ = {0};
    for (std::uint32_t i = 0; i < of_vertices.size(); ++i) {
        if (of_vertices[i].empty()) continue;
        lit.push_back(vertices_.sides()[i]);
        origins_.insert(origins_.end(), of_vertices[i].begin(), of_vertices[i].end());
        first_origin_.push_back(origins_.size());
    }
    vertices_ = LightVertices(coarse_.scene, patches, basis_.degree(), std::move(lit));
}

/// Whether all that a place sees is dark: below something that stands on the surface.
bool LightGather::is_covered(const SurfacePoint& origin, const std::vector<bool>& is_lit) const {
    const Frame frame = Frame::around(origin.normal);
    RayPacket packet;
    LaneMask lanes{};
    for (std::uint32_t i = 0; i < kRaysToCover; ++i) {
        packet.set(i, origin.lifted - fine_.patches.center,
                   frame.to_world(math::cosine_direction(i, kRaysToCover)),
                   std::numeric_limits<float>::infinity());
        lanes[i] = -1;
    }
    const patches::PatchHits hits = fine_caster_.closest(packet, lanes);
    return std::ranges::all_of(std::span(hits.sides).first(kRaysToCover), [&](std::uint32_t side) {
        if (side == patches::kNoSide) return false;
        const std::uint32_t parent = fine_.parents[fine_.patches.patch_of(side)];
        const std::uint32_t of_coarse =
            fine_.patches.is_front(side) ? parent : coarse_.patches.other_side(parent);
        return !is_lit[of_coarse] && !is_specular(coarse_.material_of(of_coarse));
    });
}

/// By first shot on the patches of the walks: for the relative errors only.
void LightGather::add_direct_light() {
    direct_lx_.resize(vertices_.count());
    area_m2_.resize(vertices_.count());
    const IncomingFirstShot* const first_shot = coarse_.first_shot.incoming();
    for (std::uint32_t p = 0; p < fine_.patches.count(); ++p) {
        const std::uint32_t parent = fine_.parents[p];
        for (const std::uint32_t side : {p, fine_.patches.other_side(p)}) {
            const std::uint32_t of_parent =
                fine_.patches.is_front(side) ? parent : coarse_.patches.other_side(parent);
            for (const std::uint32_t corner : fine_.patches.corners[p]) {
                const std::uint32_t number = vertices_.number_of(corner, side);
                if (number == LightVertices::kDark) continue;
                const double area_m2 = double{fine_.patches.areas_m2[p]} / 3;
                area_m2_[number] += area_m2;
                if (first_shot)
                    direct_lx_[number] += area_m2 * first_shot->illuminance_lx(of_parent).luminance();
            }
        }
    }
    for (std::size_t i = 0; i < direct_lx_.size(); ++i) direct_lx_[i] /= area_m2_[i];
}

/// The light that the rays have found so far, as light that reaches the vertices.
void LightGather::renew_source() {
    source_ = sums_;
    for (std::uint32_t i = 0; i < vertices_.count(); ++i) {
        const auto scale = static_cast<float>(1. / rays_that_count() / static_cast<double>(replicates_));
        for (std::size_t t = first_of(0, i); t < first_of(groups_.count(), i); ++t) {
            for (float& band : source_[t]) band *= scale;
        }
    }
    renew_source_shares();
}

/// All replicates see the same light, so that its noise would not show in how they differ: the shares tell
/// what each would see if it were alone.
void LightGather::renew_source_shares() {
    source_shares_.assign(replicate_lx_.size(), 1);
    for (std::uint32_t i = 0; i < vertices_.count(); ++i) {
        const double mean_lx = illuminance_lx(i);
        if (!(mean_lx > 0)) continue;
        for (std::size_t r = i * replicates_; r < (i + 1) * replicates_; ++r)
            source_shares_[r] = static_cast<float>(replicate_lx_[r] / rays_that_count() / mean_lx);
    }
}

/// The light gathered once has served: it is not part of the result.
void LightGather::forget_first_step() {
    std::ranges::fill(sums_, FloatRgb{});
    std::ranges::fill(replicate_lx_, 0.);
}

void LightGather::step() {
    if (steps_ == 1 || (steps_ >= kStepsToTrustSecond && std::has_single_bit(steps_))) renew_source();
    if (steps_ == 1) forget_first_step();
    const auto gather_part = [&](std::size_t first, std::size_t last) {
        gather(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
    };
    parallel_for_parts(vertices_.count(), gather_part, kTogether);
    ++steps_;
}

void LightGather::write(ByteWriter& bytes) const {
    bytes.add(steps_);
    bytes.add_list(sums_);
    bytes.add_list(source_);
    bytes.add_list(source_shares_);
    bytes.add_list(replicate_lx_);
    bytes.add_list(difference_lx_);
}

void LightGather::read(ByteReader& bytes) {
    steps_ = bytes.take<std::uint64_t>("the steps of the vertices");
    bytes.take_same_size(sums_, "the light of the vertices");
    // There is no source before the second step.
    source_.resize(steps_ > 1 ? sums_.size() : 0);
    source_shares_.resize(steps_ > 1 ? replicate_lx_.size() : 0);
    bytes.take_same_size(source_, "the light that is gathered");
    bytes.take_same_size(source_shares_, "the shares of replicates in it");
    bytes.take_same_size(replicate_lx_, "the illuminances of replicates");
    bytes.take_same_size(difference_lx_, "the differences from the patches");
}

void LightGather::gather(std::uint32_t first, std::uint32_t last) {
    std::vector<GatheredRay> rays;
    for (std::uint32_t vertex = first; vertex < last; ++vertex) {
        for (std::uint32_t r = 0; r < replicates_; ++r) {
            if (auto ray = start(vertex, r)) rays.push_back(*ray);
        }
    }
    const std::size_t groups = groups_.count();
    std::vector<Rgb> light(2 * groups * rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].once = std::span(light).subspan(2 * i * groups, groups);
        rays[i].twice = std::span(light).subspan((2 * i + 1) * groups, groups);
    }
    follow(rays);
    std::vector<ViewedHit> points;
    std::vector<GatheredRay*> standing;
    for (GatheredRay& ray : rays) {
        if (!ray.stands) continue;
        standing.push_back(&ray);
        points.push_back({ray.path.hit, ray.path.outgoing});
    }
    const auto locations = find_patch_locations(fine_caster_, points, rays::Coherence::scattered);
    for (std::size_t i = 0; i < standing.size(); ++i) reflect(*standing[i], locations[i]);
    for (GatheredRay& ray : rays) {
        add_of_lamps(ray);
        add(ray);
    }
}

/// Nothing where the ray would leave the surface to the other side of a patch.
auto LightGather::start(std::uint32_t vertex, std::uint32_t replicate) const -> std::optional<GatheredRay> {
    math::SampleStream stream(key_.derived(replicate).derived(vertices_.sides()[vertex]), steps_);
    const auto [u1, u2] = stream.next_two();
    const Vec3 local = math::sample_cosine_hemisphere(u1, u2).direction;
    const std::size_t count = first_origin_[vertex + 1] - first_origin_[vertex];
    const auto number = static_cast<std::size_t>(stream.next() * static_cast<double>(count));
    const SurfacePoint& origin = origins_[first_origin_[vertex] + number];
    const Vec3 direction = vertices_.frame(vertex).to_world(local);
    if (dot(direction, origin.normal) <= 0) return std::nullopt;
    return GatheredRay{vertex, replicate, local, {origin.lifted, direction}, {{}, -direction, stream}};
}

/// To the first surface that scatters.
void LightGather::follow(std::span<GatheredRay> rays) const {
    std::vector<rays::Ray> started;
    for (const GatheredRay& ray : rays) started.push_back(ray.ray);
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    coarse_.caster.closest(started, rays::Coherence::scattered, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i]) continue;
        GatheredRay& ray = rays[i];
        ray.path.hit = *hits[i];
        ray.path.reflections_left = transport::kUnlimited;
        ray.path.previous_vertex = transport::kDirectIsKnown;
        ray.stands = tracer_.follow_to_scattering(ray.path).has_value();
    }
}

/// Light that mirrors and glass bring from a lamp is light that was reflected; direct light, also through
/// panes, is left out.
void LightGather::add_of_lamps(GatheredRay& ray) const {
    if (!(ray.path.luminance_cd_m2.max() > 0)) return;
    const std::size_t group = group_of(ray.path);
    ray.once[group] += ray.path.luminance_cd_m2;
    ray.twice[group] += ray.path.luminance_cd_m2;
    ray.own_cd_m2 += ray.path.luminance_cd_m2;
}

/// The group of the lamp that a path ends on, or of the light from outside.
std::size_t LightGather::group_of(const transport::Path& ended) const {
    std::size_t outside = 0;
    for (std::size_t light = 0; light < coarse_.scene.lights.size(); ++light) {
        const auto surface = lights::emitting_object(coarse_.scene.lights[light]);
        if (surface && *surface == ended.hit.object) return groups_.of_light[light];
        if (location_of(coarse_.scene.lights[light]) == LightLocation::infinity)
            outside = groups_.of_light[light];
    }
    return outside;
}

void LightGather::reflect(GatheredRay& ray, const std::optional<PatchLocation>& location) const {
    transport::Path& path = ray.path;
    if (reflects_nothing(coarse_.scene.material(path.hit.material))) return;
    lights_.add_reflected(path.hit, path.outgoing, path.stream, ray.twice);
    if (replaced_lights_) {
        replaced_lights_->add_reflected(path.hit, path.outgoing, path.stream, ray.once);
    } else {
        std::ranges::copy(ray.twice, ray.once.begin());
    }
    for (const Rgb& light : ray.twice) ray.own_cd_m2 += light;
    if (location) {
        const std::uint32_t parent = fine_.parents[fine_.patches.patch_of(location->side)];
        const bool is_front = fine_.patches.is_front(location->side);
        add_of_walk(ray, is_front ? parent : coarse_.patches.other_side(parent));
        if (!source_.empty()) add_of_vertices(ray, *location);
    }
    for (Rgb& light : ray.once) light *= path.throughput;
    for (Rgb& light : ray.twice) light *= path.throughput;
    ray.own_cd_m2 *= path.throughput;
}

void LightGather::add_of_walk(const GatheredRay& ray, std::uint32_t coarse_side) const {
    const std::size_t count = walks_.layout().count_of(coarse_side);
    if (count == 0) return;
    std::array<FloatRgb, math::ZernikeBasis::kMostCount> factors;
    const std::span<FloatRgb> used(factors.data(), count);
    const Frame frame = frame_of(coarse_.patches, coarse_side);
    const Vec3 out = frame.to_local(ray.path.outgoing);
    // Not the material that the ray met: where two objects lie in one plane, that may be the other one's.
    const MaterialId material = coarse_.patches.material_of(coarse_.scene, coarse_side);
    interpolate_factors(tables_[index_of(material)], {out.x, out.y, std::abs(out.z)}, used);
    const double scale = 1 / static_cast<double>(walks_.steps());
    for (std::size_t g = 0; g < ray.once.size(); ++g)
        ray.once[g] += reflected_cd_m2(walks_.sums_of(g, coarse_side), used) * scale;
}

/// From one corner of the patch, chosen at random by the barycentric coordinates: a third of the work of all
/// three, for hardly more noise.
void LightGather::add_of_vertices(GatheredRay& ray, const PatchLocation& location) const {
    const LitCorners corners = lit_corners(location, ray.replicate);
    if (corners.count == 0) return;
    const std::uint32_t number = corners.chosen(ray.path.stream.next());
    std::array<FloatRgb, math::ZernikeBasis::kMostCount> factors;
    const std::span<FloatRgb> used(factors.data(), vertices_.terms_of(number));
    const Vec3 out = vertices_.frame(number).to_local(ray.path.outgoing);
    interpolate_factors(tables_[index_of(vertices_.material(number))], {out.x, out.y, std::abs(out.z)}, used);
    Rgb whole;
    for (std::size_t g = 0; g < ray.twice.size(); ++g) {
        const auto terms = std::span(source_).subspan(first_of(g, number), used.size());
        const Rgb reflected = reflected_cd_m2(terms, used);
        ray.twice[g] += reflected;
        whole += reflected;
    }
    ray.own_cd_m2 += corners.source_share * whole;
}

auto LightGather::lit_corners(const PatchLocation& location, std::uint32_t replicate) const -> LitCorners {
    const Triangle& corners = fine_.patches.corners[fine_.patches.patch_of(location.side)];
    const auto& [b0, b1, b2] = location.barycentric;
    const std::array weights{b0, b1, b2};
    LitCorners lit;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t number = vertices_.number_of(corners[c], location.side);
        if (number == LightVertices::kDark || !(weights[c] > 0)) continue;
        lit.source_share += weights[c] * double{source_shares_[number * replicates_ + replicate]};
        sum += weights[c];
        lit.numbers[lit.count] = number;
        lit.sums[lit.count++] = sum;
    }
    if (lit.count > 0) lit.source_share /= sum;
    return lit;
}

void LightGather::add(const GatheredRay& ray) {
    std::array<double, math::ZernikeBasis::kMostCount> values{1 / std::sqrt(kPi)};
    const std::uint32_t count = vertices_.terms_of(ray.vertex);
    if (count > 1) basis_.evaluate(ray.local_direction, values);
    const bool is_first = source_.empty();
    const Rgb own_lx =
        kPi * (is_first ? std::accumulate(ray.once.begin(), ray.once.end(), Rgb()) : ray.own_cd_m2);
    if (own_lx.is_finite()) replicate_lx_[ray.vertex * replicates_ + ray.replicate] += own_lx.luminance();
    for (std::size_t g = 0; g < groups_.count(); ++g) {
        const Rgb once_lx = ray.once[g] * kPi, twice_lx = ray.twice[g] * kPi;
        if (!once_lx.is_finite() || !twice_lx.is_finite()) continue;
        const Rgb& gathered_lx = is_first ? once_lx : twice_lx;
        const std::size_t first = first_of(g, ray.vertex);
        for (std::uint32_t k = 0; k < count; ++k) add_to(sums_[first + k], gathered_lx * values[k]);
        if (!is_first) difference_lx_[ray.vertex] += twice_lx.luminance() - once_lx.luminance();
    }
}

double LightGather::illuminance_lx(std::uint32_t vertex) const {
    const auto first = replicate_lx_.begin() + static_cast<std::ptrdiff_t>(vertex * replicates_);
    double sum = 0;
    for (std::size_t r = 0; r < replicates_; ++r) sum += first[static_cast<std::ptrdiff_t>(r)];
    return sum / rays_that_count() / static_cast<double>(replicates_);
}

double LightGather::bias_lx(std::uint32_t vertex) const {
    return std::abs(difference_lx_[vertex]) / rays_that_count() / static_cast<double>(replicates_);
}

auto LightGather::illuminances() const -> Illuminances {
    Illuminances result;
    result.area_m2 = area_m2_;
    result.lit_sides = vertices_.sides();
    for (std::size_t r = 0; r < replicates_; ++r) {
        for (std::uint32_t i = 0; i < vertices_.count(); ++i) {
            result.replicate_means.push_back(direct_lx_[i] +
                                             replicate_lx_[i * replicates_ + r] / rays_that_count());
        }
    }
    for (std::uint32_t i = 0; i < vertices_.count(); ++i) result.bias_lx.push_back(bias_lx(i));
    return result;
}

PatchSolution LightGather::solution() const {
    PatchSolution solution;
    solution.patches = fine_.patches;
    solution.groups = groups_.names;
    solution.degree = basis_.degree();
    solution.lit_vertices.assign(vertices_.sides().begin(), vertices_.sides().end());
    if (steps_ < kFirstSteps) return solution;
    solution.terms.resize(groups_.count());
    for (std::size_t g = 0; g < groups_.count(); ++g) {
        solution.terms[g].reserve(vertices_.terms());
        for (std::uint32_t i = 0; i < vertices_.count(); ++i) {
            const double scale = 1 / rays_that_count() / static_cast<double>(replicates_);
            for (std::uint32_t k = 0; k < vertices_.terms_of(i); ++k)
                solution.terms[g].push_back(stored(to_rgb(sums_[first_of(g, i) + k]) * scale));
        }
    }
    solution.replicates.resize(replicates_);
    for (std::uint32_t i = 0; i < vertices_.count(); ++i) {
        const double mean_lx = illuminance_lx(i), rays = rays_that_count();
        for (std::size_t r = 0; r < replicates_; ++r) {
            const double share = mean_lx > 0 ? replicate_lx_[i * replicates_ + r] / rays / mean_lx : 1;
            solution.replicates[r].push_back(to_half(static_cast<float>(share)));
        }
        solution.bias.push_back(to_half(static_cast<float>(mean_lx > 0 ? bias_lx(i) / mean_lx : 0)));
    }
    return solution;
}

}  // namespace stilb::estimators
