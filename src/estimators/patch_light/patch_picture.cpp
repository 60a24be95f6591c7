#include "estimators/patch_light/patch_picture.h"

#include <algorithm>
#include <iterator>

namespace stilb::estimators {

VisibleSides::VisibleSides(const PatchTransport& transport, const Vec3& eye)
    : transport_(transport),
      eye_(eye),
      are_backs_seen_(std::ranges::any_of(transport.scene.materials,
                                          [](const auto& named) { return is_specular(named.material); })),
      first_(2 * transport.patches.count()) {
    for_each([&](std::uint32_t side, const Vec3& out) {
        first_[side] = to_float_rgb(transport.first_reflected(side, out));
    });
}

void VisibleSides::add(const PatchLight& light, std::vector<FloatRgb>& sums_cd_m2) const {
    for_each(
        [&](std::uint32_t side, const Vec3& out) { add_to(sums_cd_m2[side], light.reflected(side, out)); });
}

std::vector<FloatRgb> VisibleSides::mean_cd_m2(const std::vector<FloatRgb>& sums_cd_m2, double lights) const {
    std::vector<FloatRgb> means = first_;
    for (std::size_t side = 0; side < means.size(); ++side) {
        add_to(means[side], to_rgb(sums_cd_m2[side]) * (1 / lights));
    }
    return means;
}

PatchPass::PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
                     const std::vector<FloatRgb>& sides_cd_m2)
    : tracing_(tracing), transport_(transport), pass_(pass) {
    std::vector<Rgb> values;
    values.reserve(sides_cd_m2.size());
    std::ranges::transform(sides_cd_m2, std::back_inserter(values), to_rgb);
    const std::span<const Rgb> all(values);
    fronts_ = transport.interpolation.at_vertices(all.first(transport.patches.count()));
    backs_ = transport.interpolation.at_vertices(all.subspan(transport.patches.count()));
}

std::uint64_t PatchPass::sample(const PixelBlock& block, std::span<Rgb> pixels) const {
    CameraPaths started = tracing_.start_paths(pixels_of(block), pass_);
    std::vector<transport::Path>& paths = started.paths;
    std::vector<std::size_t> standing;
    std::vector<ViewedHit> points;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (!tracing_.tracer.look_through(paths[i])) continue;
        standing.push_back(i);
        points.push_back({paths[i].hit, paths[i].outgoing});
    }
    const auto places = find_patch_locations(transport_.patch_caster, points);
    for (std::size_t i = 0; i < places.size(); ++i) {
        transport::Path& path = paths[standing[i]];
        if (places[i]) path.luminance_cd_m2 += path.throughput * reflected(path, *places[i]);
    }
    return started.write_to(pixels);
}

Rgb PatchPass::reflected(const transport::Path& path, const PatchLocation& seen) const {
    const bool is_front = transport_.patches.is_front(seen.side);
    const std::span<const Rgb> vertices(is_front ? fronts_ : backs_);
    return transport_.interpolation.at(vertices, transport_.patches.patch_of(seen.side), seen.place) +
           transport_.first_reflected_at(seen.side, path.hit.position, {}, path.outgoing);
}

}  // namespace stilb::estimators
