#include "estimators/local/guess/light_guess.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>

#include "base/parallel.h"
#include "math/sampling.h"
#include "patches/vertex_interpolation.h"
#include "transport/receiver.h"

namespace stilb::estimators {
namespace {

/// Patches of the guess. More of them make the residual smaller, and the guess dearer.
constexpr double kPatches = 3000;
/// Packets of rays from each lit side, each from another point of the side.
constexpr std::uint64_t kSidePackets = 4;

/// Samples of direct light at each of these points.
constexpr std::uint32_t kSideDirect = 2;
/// The equations are solved to this relative change, in so many sweeps at most.
constexpr double kChange = 1e-3;
constexpr int kMostSweeps = 200;
/// Lobes of a larger mean concentration, without a diffuse part beside them, are traced.
constexpr double kSharp = 100;

bool is_smooth(const Shape& shape) {
    const Mesh* mesh = geometry::stored_mesh(shape);
    return mesh != nullptr && !mesh->normals.empty();
}

bool is_traced(const Material& material) {
    const materials::SplitMaterial parts = materials::split(material);
    if (is_specular(material) || (transmits(material) && !(parts.transmitted.max() > 0))) return true;
    return !(parts.diffuse_reflectance.max() > 0) && parts.gloss && mean_concentration(*parts.gloss) > kSharp;
}

std::vector<materials::SplitMaterial> split_materials(const Scene& scene) {
    std::vector<materials::SplitMaterial> split;
    for (const auto& named : scene.materials) split.push_back(materials::split(named.material));
    return split;
}

std::vector<std::uint8_t> traced_materials(const Scene& scene) {
    std::vector<std::uint8_t> traced;
    for (const auto& named : scene.materials) traced.push_back(is_traced(named.material) ? 1 : 0);
    // Patches are of surfaces of which neither side is traced.
    for (std::size_t i = 0; i < traced.size(); ++i) {
        const auto back = index_of(scene.on_side(MaterialId{static_cast<std::uint32_t>(i)}, false));
        traced[i] = traced[back] = traced[i] | traced[back];
    }
    return traced;
}

std::vector<std::uint8_t> traced_objects(const Scene& scene) {
    std::vector<std::uint8_t> traced;
    for (const Object& object : scene.objects)
        traced.push_back(geometry::is_exact(object.shape) || is_smooth(object.shape) ||
                                 std::holds_alternative<Instance>(object.shape)
                             ? 1
                             : 0);
    return traced;
}

/// `corners`: those of a triangle, each with `count` luminances.
STILB_VECTORIZED void add_interpolated(const std::array<float, kBands>* __restrict corners,
                                       const std::array<float, 3>& weights, std::size_t count,
                                       Rgb* __restrict sums) {
    const float w0 = weights[0], w1 = weights[1], w2 = weights[2];
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t b = 0; b < kBands; ++b)
            sums[i][b] +=
                double{w0 * corners[i][b] + w1 * corners[count + i][b] + w2 * corners[2 * count + i][b]};
    }
}

}  // namespace

SurfacePoint side_point(const patches::Patches& patches, const rays::RayCaster& caster, std::uint32_t side,
                        const math::Barycentric& at) {
    const Vec3 position = patches.position(patches.patch_of(side), at);
    const Vec3 normal = patches.normal_of(side);
    return {position, normal, position + caster.offset_m(position, caster.lift().largest_size_m()) * normal};
}

double LightGuess::patch_count(const Scene& scene) {
    double count = kPatches;
    for (const Object& object : scene.objects) {
        if (const auto* mesh = std::get_if<Mesh>(&object.shape))
            count += static_cast<double>(mesh->triangles.size());
    }
    return count;
}

/// The rays of all sides, and the solution of the equations.
struct LightGuess::Solver {
    const LightGuess& guess;
    const rays::RayCaster& caster;
    const BoundedDirect& direct;
    const transport::PathTracer& tracer;
    math::KeyOf<Stream> key;
    const Monitor& monitor;

    /// What the rays of some sides have met.
    struct Rows {
        std::vector<std::uint32_t> sides;
        std::size_t width = 0;
        std::vector<std::uint32_t> seen;  ///< sides x width; kNoSide where there is none, or a mirror
        std::vector<transport::LightSum> source_lx;  ///< direct light, and light by mirrors and glass
    };

    Rows cast(std::vector<std::uint32_t> sides, std::uint64_t packets, Stream purpose) const {
        Rows rows{std::move(sides), packets * kPacketWidth, {}, {}};
        rows.seen.resize(rows.sides.size() * rows.width, patches::kNoSide);
        rows.source_lx.resize(rows.sides.size(), transport::LightSum(guess.channels_));
        parallel_for_parts(
            rows.sides.size(),
            [&](std::size_t first, std::size_t last) {
                monitor.require_more();
                for (std::size_t row = first; row < last; ++row) {
                    for (std::uint64_t i = 0; i < packets; ++i) cast_packet(rows, row, i, packets, purpose);
                }
            },
            64);
        return rows;
    }

    void cast_packet(Rows& rows, std::size_t row, std::uint64_t number, std::uint64_t packets,
                     Stream purpose) const {
        const patches::Patches& patches = guess.patches();
        const std::uint32_t side = rows.sides[row];
        math::SampleStream stream(key.derived(purpose).derived(side), number, 4);
        const auto [u1, u2] = stream.next_two();
        const SurfacePoint point = side_point(patches, caster, side, math::sample_triangle(u1, u2));
        transport::LightSum& source = rows.source_lx[row];
        direct.sample(point, BoundedDirect::Part::bounded, kSideDirect, stream, [&](const Arrival& arrival) {
            source.add(arrival.illuminance_lx * (1. / static_cast<double>(packets)), arrival.light);
        });
        const std::array<Vec3, kPacketWidth> directions =
            spread_directions(point.normal, stream.next_two(), number, packets);
        rays::RayHitPacket packet;
        LaneMask lanes;
        lanes.fill(-1);
        for (std::size_t i = 0; i < kPacketWidth; ++i)
            packet.ray.set(i, point.lifted - caster.center(), directions[i],
                           std::numeric_limits<float>::infinity());
        const patches::PatchHits hits = guess.patches_.closest(packet, lanes, rays::Coherence::scattered);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const std::uint32_t met = hits.sides[i];
            if (met != patches::kNoSide) {
                rows.seen[row * rows.width + number * kPacketWidth + i] = met;
            } else if ((hits.exact_lanes >> i & 1u) == 0) {
                continue;
            } else if (const auto hit = caster.closest(point.lifted, directions[i])) {
                source.add_sample(Rgb::grey(kPi / static_cast<double>(rows.width)), [&](auto* parts) {
                    return tracer.luminance_without_direct(*hit, directions[i], transport::kUnlimited, stream,
                                                           parts);
                });
            }
        }
    }

    /// The part `number` of `packets` x 16 directions that are spread evenly, shifted together.
    static std::array<Vec3, kPacketWidth> spread_directions(const Vec3& normal,
                                                            const std::array<double, 2>& shift,
                                                            std::uint64_t number, std::uint64_t packets) {
        const Frame frame = Frame::around(normal);
        std::array<Vec3, kPacketWidth> directions;
        for (std::uint32_t i = 0; i < kPacketWidth; ++i) {
            const auto all = static_cast<std::uint32_t>(packets * kPacketWidth);
            const auto [u1, u2] =
                math::even_point(static_cast<std::uint32_t>(i * packets + number), all, shift);
            directions[i] = frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
        }
        return directions;
    }

    /// The sides that any light reaches: those with a source, and those that see or are seen by a lit side.
    std::vector<std::uint32_t> lit(const Rows& rows) const {
        std::vector<std::uint8_t> is_lit(2 * guess.patches().count());
        const auto spread_light = [&](std::size_t row) {
            const auto seen = std::span(rows.seen).subspan(row * rows.width, rows.width);
            const bool was_lit = is_lit[rows.sides[row]] != 0;
            if (!was_lit && !is_source(rows, row) && !sees_lit(seen, is_lit)) return false;
            bool grows = !was_lit;
            is_lit[rows.sides[row]] = 1;
            const auto light = [&](std::uint32_t side) {
                if (side == patches::kNoSide || is_lit[side] != 0) return;
                is_lit[side] = 1;
                grows = true;
            };
            if (guess.material(rows.sides[row]).transmitted.max() > 0)
                light(guess.patches().other_side(rows.sides[row]));
            std::ranges::for_each(seen, light);
            return grows;
        };
        for (bool grows = true; grows;) {
            grows = false;
            for (std::size_t row = 0; row < rows.sides.size(); ++row) grows = spread_light(row) || grows;
        }
        std::vector<std::uint32_t> lit_sides;
        std::ranges::copy_if(rows.sides, std::back_inserter(lit_sides),
                             [&](std::uint32_t side) { return is_lit[side] != 0; });
        return lit_sides;
    }
    static bool is_source(const Rows& rows, std::size_t row) { return rows.source_lx[row].whole.max() > 0; }
    static bool sees_lit(std::span<const std::uint32_t> seen, const std::vector<std::uint8_t>& is_lit) {
        return std::ranges::any_of(
            seen, [&](std::uint32_t side) { return side != patches::kNoSide && is_lit[side] != 0; });
    }

    /// The luminances of all sides [cd/m2], by Gauss-Seidel sweeps. The sweeps keep the sum of the shares: it
    /// is the whole, after any number of them.
    std::vector<transport::LightSum> solve(const Rows& rows) const {
        std::vector<transport::LightSum> luminance(2 * guess.patches().count(),
                                                   transport::LightSum(guess.channels_));
        // By sides: the light of the other side that the patch lets through.
        std::map<std::uint32_t, transport::LightSum> through;
        const Rgb per_ray = Rgb::grey(kPi / static_cast<double>(rows.width));
        for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
            double change = 0, total = 0;
            for (std::size_t row = 0; row < rows.sides.size(); ++row) {
                transport::LightSum seen(guess.channels_), arriving = rows.source_lx[row];
                for (std::size_t i = row * rows.width; i < (row + 1) * rows.width; ++i) {
                    if (rows.seen[i] != patches::kNoSide) seen.add(luminance[rows.seen[i]], Rgb::grey(1));
                }
                arriving.add(seen, per_ray);
                arriving.reflect();
                const std::uint32_t side = rows.sides[row];
                const materials::SplitMaterial& material = guess.material(side);
                if (material.transmitted.max() > 0) {
                    transport::LightSum passing = arriving;
                    through.insert_or_assign(guess.patches().other_side(side),
                                             passing *= material.transmitted * (1 / kPi));
                }
                arriving *= (material.diffuse_reflectance + -1 * material.transmitted) * (1 / kPi);
                if (const auto found = through.find(side); found != through.end())
                    arriving.add(found->second, Rgb::grey(1));
                change += std::abs((arriving.whole + luminance[side].whole * -1).luminance());
                total += arriving.whole.luminance();
                luminance[side] = std::move(arriving);
            }
            if (change <= kChange * total) break;
        }
        return luminance;
    }
};

LightGuess::LightGuess(const Scene& scene, const rays::RayCaster& caster, const BoundedDirect& direct,
                       const transport::PathTracer& tracer, math::KeyOf<Stream> key,
                       const transport::Channels* channels, const Monitor& monitor)
    : scene_(scene),
      materials_(split_materials(scene)),
      is_traced_material_(traced_materials(scene)),
      is_traced_object_(traced_objects(scene)),
      patches_(
          scene, caster, kPatches,
          [this](ObjectId object, MaterialId material) { return !is_traced(object, material); }, monitor),
      shared_(scene, caster, patches(),
              [this](ObjectId object, MaterialId material) { return is_traced(object, material); }),
      channels_(channels) {
    std::vector<std::uint32_t> sides;
    for (std::uint32_t p = 0; p < patches().count(); ++p) {
        for (const std::uint32_t side : {p, patches().other_side(p)}) {
            if (material(side).diffuse_reflectance.max() > 0) sides.push_back(side);
        }
    }
    const Solver solver{*this, caster, direct, tracer, key, monitor};
    lit_sides_ = solver.lit(solver.cast(std::move(sides), 1, Stream::survey));
    std::ranges::sort(lit_sides_);
    shared_.set_lit(lit_sides_);
    interpolate(solver.solve(solver.cast(lit_sides_, kSidePackets, Stream::solution)));
    for (const std::uint32_t side : lit_sides_)
        lit_area_m2_ += double{patches().areas_m2[patches().patch_of(side)]};
}

void LightGuess::interpolate(const std::vector<transport::LightSum>& luminance_of_sides) {
    const std::size_t sides = luminance_of_sides.size();
    std::vector<std::uint8_t> is_lit(sides);
    for (const std::uint32_t side : lit_sides_) is_lit[side] = 1;
    const patches::VertexInterpolation interpolation(patches());
    // `corner_of(side, corner)`: where its luminance is kept.
    const auto set_corners = [&](const auto& luminance_of, const auto& corner_of) {
        std::vector<Rgb> luminances;
        for (const transport::LightSum& sum : luminance_of_sides) luminances.push_back(luminance_of(sum));
        for (const std::uint32_t first : {0u, static_cast<std::uint32_t>(patches().count())}) {
            const std::vector<Rgb> at_vertices =
                interpolation.at_vertices(std::span<const Rgb>(luminances).subspan(first, patches().count()));
            for (std::uint32_t p = 0; p < patches().count(); ++p) {
                if (is_lit[first + p] == 0) continue;
                for (std::size_t c = 0; c < 3; ++c) {
                    const Rgb& value = at_vertices[patches().corners[p][c]];
                    for (std::size_t b = 0; b < kBands; ++b)
                        corner_of(first + p, c)[b] = static_cast<float>(value[b]);
                }
            }
        }
    };
    corners_.resize(sides);
    set_corners([](const transport::LightSum& sum) { return sum.whole; },
                [&](std::size_t side, std::size_t corner) -> Luminance& { return corners_[side][corner]; });
    const std::size_t channels = channels_ ? channels_->count() : 0;
    corners_of_shares_.resize(sides * 3 * channels);
    for (std::size_t c = 0; c < channels; ++c)
        set_corners([c](const transport::LightSum& sum) { return sum.shares[c]; },
                    [&](std::size_t side, std::size_t corner) -> Luminance& {
                        return corners_of_shares_[(side * 3 + corner) * channels + c];
                    });
}

Rgb LightGuess::luminance_at(std::uint32_t side, const math::Barycentric& at) const {
    const std::array<Luminance, 3>& corners = corners_[side];
    Rgb luminance;
    for (std::size_t b = 0; b < kBands; ++b)
        luminance[b] =
            at.b0 * double{corners[0][b]} + at.b1 * double{corners[1][b]} + at.b2 * double{corners[2][b]};
    return luminance;
}

transport::LightSum LightGuess::at(std::uint32_t side, const math::Barycentric& at) const {
    transport::LightSum sum(channels_);
    sum.whole = luminance_at(side, at);
    add_shares(side, at, 1, sum.shares);
    return sum;
}

transport::LightSum LightGuess::seen(const GuessedLight& light, std::size_t lane) const {
    transport::LightSum sum(channels_);
    sum.whole = light.luminance_of(lane);
    add_shares(light.sides[lane], light.barycentric_of(lane), 1, sum.shares);
    return sum;
}

void LightGuess::add_shares(std::uint32_t side, const math::Barycentric& at, double weight,
                            std::vector<Rgb>& shares) const {
    if (shares.empty() || side == patches::kNoSide) return;
    add_interpolated(&corners_of_shares_[side * 3 * shares.size()],
                     {static_cast<float>(weight * at.b0), static_cast<float>(weight * at.b1),
                      static_cast<float>(weight * at.b2)},
                     shares.size(), shares.data());
}

void LightGuess::go_to_owners(patches::PatchHits& hits) const {
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (hits.sides[i] == patches::kNoSide || !shared_.shares(hits.sides[i])) continue;
        const SharedPlaces::Place owner = shared_.owner_of(hits.sides[i], hits.barycentric(i));
        hits.sides[i] = owner.side;
        hits.b1[i] = static_cast<float>(owner.at.b1);
        hits.b2[i] = static_cast<float>(owner.at.b2);
        if (owner.side == patches::kNoSide) hits.exact_lanes |= 1u << i;
    }
}

void LightGuess::look(rays::RayHitPacket& packet, const LaneMask& lanes, rays::Coherence coherence,
                      GuessedLight& light) const {
    patches::PatchHits hits = patches_.closest(packet, lanes, coherence);
    go_to_owners(hits);
    light.traced_lanes = hits.exact_lanes;
    light.sides = hits.sides;
    light.b1 = hits.b1;
    light.b2 = hits.b2;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        for (std::size_t b = 0; b < kBands; ++b) light.luminance[b][i] = 0;
        light.cosine[i] = 0;
        const std::uint32_t side = hits.sides[i];
        if (side == patches::kNoSide) continue;
        const std::uint32_t patch = patches().patch_of(side);
        const patches::Float3& normal = patches().normals[patch];
        const RayPacket& ray = packet.ray;
        light.cosine[i] = std::abs(normal.x * ray.direction_x[i] + normal.y * ray.direction_y[i] +
                                   normal.z * ray.direction_z[i]);
        const std::array<Luminance, 3>& corners = corners_[side];
        const float b1 = hits.b1[i], b2 = hits.b2[i], b0 = 1 - b1 - b2;
        for (std::size_t b = 0; b < kBands; ++b)
            light.luminance[b][i] = b0 * corners[0][b] + b1 * corners[1][b] + b2 * corners[2][b];
    }
}

}  // namespace stilb::estimators
