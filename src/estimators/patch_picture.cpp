#include "estimators/patch_picture.h"

#include <algorithm>
#include <iterator>

#include "estimators/patch_place.h"

namespace stilb {

SeenSides::SeenSides(const PatchTransport& transport, const Vec3& eye)
    : transport_(transport), eye_(eye), sums_(2 * transport.patches.count()) {}

void SeenSides::add(const PatchLight& light) {
    const Patches& patches = transport_.patches;
    lights_ += 1;
    for (std::uint32_t patch = 0; patch < patches.count(); ++patch) {
        const std::uint32_t back = patches.other_side(patch);
        const Vec3 normal = patches.normal_of(patch);
        if (transport_.reflects_alike(patch)) {
            add_to(sums_[patch], light.reflected(patch, normal));
            add_to(sums_[back], light.reflected(back, -normal));
            continue;
        }
        const Vec3 to_eye = normalized(eye_ - patches.middle(patch));
        const bool front_is_seen = dot(to_eye, normal) > 0;
        add_to(sums_[patch], light.reflected(patch, front_is_seen ? to_eye : normal));
        add_to(sums_[back], light.reflected(back, front_is_seen ? -normal : to_eye));
    }
}

void SeenSides::add(const SeenSides& others) {
    lights_ += others.lights_;
    for (std::size_t side = 0; side < sums_.size(); ++side)
        add_to(sums_[side], spectrum_of(others.sums_[side]));
}

std::vector<Rgb> SeenSides::mean_cd_m2() const {
    std::vector<Rgb> means;
    means.reserve(sums_.size());
    for (const Rgb& sum : sums_) means.push_back(rgb_of(spectrum_of(sum) * (1 / lights_)));
    return means;
}

PatchPass::PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
                     const std::vector<Rgb>& sides_cd_m2)
    : tracing_(tracing), transport_(transport), pass_(pass) {
    std::vector<Spectrum> values;
    values.reserve(sides_cd_m2.size());
    std::ranges::transform(sides_cd_m2, std::back_inserter(values), spectrum_of);
    const std::span<const Spectrum> all(values);
    fronts_ = transport.interpolation.at_vertices(all.first(transport.patches.count()));
    backs_ = transport.interpolation.at_vertices(all.subspan(transport.patches.count()));
}

std::uint64_t PatchPass::sample(const PixelBlock& block, std::span<Spectrum> pixels) const {
    std::ranges::fill(pixels, Spectrum{});
    auto [paths, numbers] = tracing_.start_paths(pixels_of(block), pass_);
    std::uint64_t invalid = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const bool meets_surface = tracing_.tracer.look_through(paths[i]);
        Spectrum luminance = paths[i].luminance_cd_m2;
        if (meets_surface) luminance += paths[i].throughput * reflected(paths[i]);
        if (luminance.is_finite()) {
            pixels[numbers[i]] = luminance;
        } else {
            ++invalid;
        }
    }
    return invalid;
}

Spectrum PatchPass::reflected(const Path& path) const {
    const auto seen = find_place(transport_.patch_caster, path.hit, path.outgoing);
    if (!seen) return {};
    const bool is_front = transport_.patches.is_front(seen->side);
    const std::span<const Spectrum> vertices(is_front ? fronts_ : backs_);
    return transport_.interpolation.at(vertices, transport_.patches.patch_of(seen->side), seen->place) +
           transport_.first_reflected_at(seen->side, path.hit.position, path.outgoing);
}

}  // namespace stilb
