#include "estimators/patch_light/ray_bundle/bundle_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "math/random.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

/// Dimensions of a step: three for the frame, two for each axis' offset.
constexpr unsigned kDimensions = 12;
/// The low-discrepancy sequence is used in a random order within blocks of this many points: consecutive
/// steps must be independent of each other, or their product would be biased.
constexpr std::uint64_t kShuffled = 256;

/// Uniform among all rotations [Shoemake 1992].
Frame random_frame(double u1, double u2, double u3) {
    const double a = std::sqrt(1 - u1), b = std::sqrt(u1);
    const double x = a * std::sin(2 * kPi * u2), y = a * std::cos(2 * kPi * u2);
    const double z = b * std::sin(2 * kPi * u3), w = b * std::cos(2 * kPi * u3);
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

/// The position of number `step` in the random order of its block.
std::uint64_t shuffled(std::uint64_t step, math::RandomKey key) {
    const std::uint64_t block = step / kShuffled;
    std::array<std::uint16_t, kShuffled> order;
    std::iota(order.begin(), order.end(), std::uint16_t{0});
    for (std::size_t i = kShuffled - 1; i > 0; --i) {
        const double u = math::unit_interval(random_block(key, block, i)[0]);
        std::swap(order[i], order[static_cast<std::size_t>(u * static_cast<double>(i + 1))]);
    }
    return block * kShuffled + order[step % kShuffled];
}

/// A frame with the axis as w.
Frame frame_along(const Frame& frame, std::size_t axis) {
    if (axis == 0) return frame;
    return axis == 1 ? Frame{frame.v, frame.w, frame.u} : Frame{frame.w, frame.u, frame.v};
}

std::size_t axes_of(BundleDirections directions) { return directions == BundleDirections::frame ? 3 : 1; }

/// The weight of each axis (theory 8).
double weight_of(BundleDirections directions) {
    switch (directions) {
        case BundleDirections::single:
            return 4 * kPi;
        case BundleDirections::pair:
            return 2 * kPi;
        case BundleDirections::frame:
            break;
    }
    return 2 * kPi / 3;
}

}  // namespace

BundleIteration::BundleIteration(const PatchTransport& transport, math::KeyOf<Stream> key)
    : BundleIteration(transport,
                      {{transport.first_reflection, transport.emission, &transport.first_shot, true}}, key) {}

BundleIteration::BundleIteration(const PatchTransport& transport, std::vector<BundleSource> sources,
                                 math::KeyOf<Stream> key)
    : transport_(transport),
      sources_(std::move(sources)),
      key_(key),
      axes_(axes_of(transport.options.directions)),
      weight_(weight_of(transport.options.directions)),
      radiance_(2 * transport.patches.count() * groups()),
      received_(radiance_.size()),
      receiving_(radiance_.size()),
      glossy_received_(axes_ * transport.glossy_sides.size() * groups()),
      glossy_receiving_(glossy_received_.size()) {}

void BundleIteration::step() {
    math::SampleStream stream(key_.derived(Stream::points), shuffled(steps_++, key_.derived(Stream::order)),
                              kDimensions);
    const auto [u1, u2] = stream.next_two();
    const Frame frame = random_frame(u1, u2, stream.next());
    std::ranges::fill(receiving_, FloatRgb{});
    std::ranges::fill(glossy_receiving_, FloatRgb{});
    radiate_constant();
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        radiate_glossy(axis_of(frame, axis));
        transfer(axis, {frame_along(frame, axis), transport_.spacing_m, stream.next_two()});
    }
    std::swap(received_, receiving_);
    std::swap(glossy_received_, glossy_receiving_);
    received_along_ = frame;
}

void BundleIteration::write(ByteWriter& bytes) const {
    bytes.add(steps_);
    bytes.add(rays_);
    bytes.add(received_along_);
    bytes.add_list(received_);
    bytes.add_list(glossy_received_);
}

void BundleIteration::read(ByteReader& bytes) {
    steps_ = bytes.take<std::uint64_t>("the steps of a walk");
    rays_ = bytes.take<std::uint64_t>("the rays of a walk");
    received_along_ = bytes.take<Frame>("the axes of a walk");
    bytes.take_same_size(received_, "the light of a walk");
    bytes.take_same_size(glossy_received_, "the light of a walk on glossy sides");
}

/// Step n lacks about r^n of the reflected light, where r is the mean reflectance; all steps from m on,
/// averaged over m steps, r^m / (m (1 - r)).
std::uint64_t first_steps(const PatchTransport& transport) {
    constexpr double most_missing = 1e-3;
    constexpr std::uint64_t most_steps = 8192;
    const double r = transport.mean_reflectance;
    std::uint64_t steps = 1;
    while (std::pow(r, static_cast<double>(steps)) > most_missing * static_cast<double>(steps) * (1 - r)) {
        if (++steps <= most_steps) continue;
        throw InputError(fmt::format(
            "the surfaces reflect {:.5g} % of the light on average: ray bundles would take more than "
            "{} steps before all reflections are there. Lower the reflectances, or use method auto.",
            100 * r, most_steps));
    }
    return steps;
}

void BundleIteration::radiate_constant() {
    const auto weight = static_cast<float>(weight_);
    const std::size_t patches = transport_.patches.count();
    for (std::uint32_t side = 0; side < 2 * patches; ++side) {
        for (std::size_t g = 0; g < groups(); ++g) {
            const BundleSource& source = sources_[g];
            const FloatRgb& received = received_[index(side, g)];
            FloatRgb& radiance = radiance_[index(side, g)];
            for (std::size_t b = 0; b < kBands; ++b) {
                radiance[b] = source.first_reflection[side][b] +
                              weight * transport_.constant_brdf[side][b] * received[b];
                if (side < patches) radiance[b] += source.emission[side][b];
            }
        }
    }
}

void BundleIteration::radiate_glossy(const Vec3& axis) {
    const patches::Patches& patches = transport_.patches;
    for (std::uint32_t number = 0; number < transport_.glossy_sides.size(); ++number) {
        const std::uint32_t side = transport_.glossy_sides[number], patch = patches.patch_of(side);
        const Vec3 out = dot(patches.normal_of(side), axis) > 0 ? axis : -axis;
        for (std::size_t g = 0; g < groups(); ++g) {
            const BundleSource& source = sources_[g];
            Rgb luminance = reflected_of(g, side, number, out);
            if (!source.first_shot->needs_position(side))
                luminance += source.first_shot->reflected(side, patches.middle(patch), {}, out);
            if (side == patch) luminance += to_rgb(source.emission[patch]);
            radiance_[index(side, g)] = to_float_rgb(luminance);
        }
    }
}

FloatRgb BundleIteration::sent(std::size_t group, std::uint32_t side, const patches::CrossedLine& line,
                               std::size_t i, const Vec3& out, const Vec3& along) const {
    const FloatRgb& radiance = radiance_[index(side, group)];
    if (!transport_.first_shot.needs_position(side)) return radiance;
    const Vec3 position = line.origin + double{line.distances_m[i]} * along;
    return to_float_rgb(to_rgb(radiance) + transport_.first_reflected_at(side, position, {}, out));
}

void BundleIteration::transfer(std::size_t axis, const patches::Bundle& bundle) {
    const patches::Patches& patches = transport_.patches;
    const bool both_ways = transport_.options.directions != BundleDirections::single;
    const Vec3& along = bundle.frame.w;
    const bool has_outside = transport_.lights.has_light_from_outside();
    const FloatRgb from_behind = to_float_rgb(transport_.lights.outside_luminance(-along));
    const FloatRgb from_ahead = to_float_rgb(transport_.lights.outside_luminance(along));
    transport_.bundles->cast(bundle, [&](const patches::CrossedLines& lines) {
        const double ray_area_m2 = lines.line_area_m2();
        for (std::size_t n = 0; n < lines.count(); ++n) {
            const patches::CrossedLine line = lines.line(n);
            for (std::size_t i = 0; i + 1 < line.sides.size(); ++i) {
                const std::uint32_t from = patches.other_side(line.sides[i]), to = line.sides[i + 1];
                for (std::size_t g = 0; g < groups(); ++g) {
                    receive(g, to, axis, sent(g, from, line, i, along, along), ray_area_m2);
                    if (both_ways)
                        receive(g, from, axis, sent(g, to, line, i + 1, -along, along), ray_area_m2);
                }
            }
            for (std::size_t g = 0; has_outside && g < groups(); ++g) {
                if (!sources_[g].has_outside) continue;
                const std::uint32_t last = patches.other_side(line.sides.back());
                receive(g, line.sides.front(), axis, from_behind, ray_area_m2);
                if (both_ways) receive(g, last, axis, from_ahead, ray_area_m2);
            }
            rays_ += line.sides.size();
        }
    });
}

void BundleIteration::receive(std::size_t group, std::uint32_t side, std::size_t axis,
                              const FloatRgb& luminance, double ray_area_m2) {
    const std::uint32_t patch = transport_.patches.patch_of(side);
    const std::uint32_t glossy = transport_.glossy_number[side];
    FloatRgb& sum = glossy == PatchTransport::kConstant
                        ? receiving_[index(side, group)]
                        : glossy_receiving_[glossy_index(glossy, axis) + group];
    const auto weight = static_cast<float>(ray_area_m2 / double{transport_.patches.areas_m2[patch]});
    for (std::size_t b = 0; b < kBands; ++b) sum[b] += weight * luminance[b];
}

std::size_t BundleIteration::glossy_index(std::uint32_t number, std::size_t axis) const {
    return (std::size_t{number} * axes_ + axis) * groups();
}

Rgb BundleIteration::reflected(std::uint32_t side, const Vec3& out) const {
    const std::uint32_t glossy = transport_.glossy_number[side];
    Rgb luminance;
    for (std::size_t g = 0; g < groups(); ++g) {
        luminance += glossy == PatchTransport::kConstant ? to_rgb(transport_.constant_brdf[side]) *
                                                               to_rgb(received_[index(side, g)]) * weight_
                                                         : reflected_of(g, side, glossy, out);
    }
    return luminance;
}

Rgb BundleIteration::reflected_of(std::size_t group, std::uint32_t side, std::uint32_t glossy,
                                  const Vec3& out) const {
    const Material& material = transport_.material_of(side);
    const Vec3 normal = transport_.patches.normal_of(side);
    const Frame frame = Frame::of_surface(normal);
    const Vec3 local_out = frame.to_local(out);
    Rgb luminance;
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        const Rgb received = to_rgb(glossy_received_[glossy_index(glossy, axis) + group]);
        if (!(received.max() > 0)) continue;
        const Vec3& along = axis_of(received_along_, axis);
        const Vec3 in = dot(along, normal) < 0 ? -along : along;
        luminance += evaluate_brdf_per_sr(material, frame.to_local(in), local_out) * (received * weight_);
    }
    return luminance;
}

}  // namespace stilb::estimators
