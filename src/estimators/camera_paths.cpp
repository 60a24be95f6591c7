#include "estimators/camera_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stilb::estimators {
namespace {

/// The random numbers of a pixel's sample: Sobol' points for the position in the pixel and for the first
/// light and direction.
math::SampleStream stream_of(const Pixel& pixel, int width, const Pass& pass) {
    constexpr unsigned sobol_dimensions = 8;
    const auto number = static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(width) +
                        static_cast<std::uint64_t>(pixel.x);
    return {pass.key.derived(kPixels).derived(number), pass.index, sobol_dimensions};
}

/// The unit direction of a pixel's sample; nothing outside of the camera's field.
std::optional<Vec3> sample_pixel(const PictureTracing& tracing, const Pixel& pixel,
                                 math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    if (tracing.camera.filter == PixelFilter::box) {
        return tracing.view.direction_at(pixel.x + u1, pixel.y + u2);
    }
    // [Box and Muller 1958]; 1 - u1 is never 0.
    constexpr double deviation = 0.5;
    const double radius = deviation * std::sqrt(-2 * std::log(1 - u1));
    const double angle = 2 * std::numbers::pi * u2;
    return tracing.view.direction_at(pixel.x + 0.5 + radius * std::cos(angle),
                                     pixel.y + 0.5 + radius * std::sin(angle));
}

}  // namespace

PictureTracing::PictureTracing(const Problem& problem, const transport::LightSampler& all_lights)
    : scene(problem.scene),
      caster(problem.caster),
      camera(problem.camera.value()),
      view(camera),
      max_reflections(problem.max_reflections),
      lights(all_lights),
      tracer(scene, caster, lights) {}

CameraPaths PictureTracing::start_paths(std::span<const Pixel> pixels, const Pass& pass) const {
    std::vector<rays::Ray> rays;
    std::vector<math::SampleStream> streams;
    std::vector<std::size_t> pixel_of_ray;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        math::SampleStream stream = stream_of(pixels[i], camera.resolution[0], pass);
        const auto direction = sample_pixel(*this, pixels[i], stream);
        if (!direction) continue;
        rays.push_back({view.position(), *direction});
        streams.push_back(stream);
        pixel_of_ray.push_back(i);
    }
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    caster.closest(rays, rays::Coherence::coherent, hits);
    CameraPaths started;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i]) {
            if (lights.has_light_from_outside())
                started.outside.push_back({pixel_of_ray[i], lights.outside_luminance(rays[i].direction)});
            continue;
        }
        transport::Path path{*hits[i], -rays[i].direction, streams[i], max_reflections};
        path.luminance_cd_m2 = lights.emitted_luminance(path.hit);
        started.paths.push_back(path);
        started.pixels.push_back(pixel_of_ray[i]);
    }
    return started;
}

std::uint64_t CameraPaths::write_to(std::span<Rgb> luminances_cd_m2) const {
    std::ranges::fill(luminances_cd_m2, Rgb{});
    for (const auto& [pixel, luminance_cd_m2] : outside) luminances_cd_m2[pixel] = luminance_cd_m2;
    std::uint64_t invalid = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const Rgb& luminance = paths[i].luminance_cd_m2;
        if (luminance.is_finite()) {
            luminances_cd_m2[pixels[i]] = luminance;
        } else {
            ++invalid;
        }
    }
    return invalid;
}

std::vector<Pixel> pixels_of(const PixelBlock& block) {
    std::vector<Pixel> pixels;
    for (int y = block.top; y < block.top + block.height; ++y) {
        for (int x = block.left; x < block.left + block.width; ++x) pixels.push_back({x, y});
    }
    return pixels;
}

}  // namespace stilb::estimators
