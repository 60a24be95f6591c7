#include "estimators/camera_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stilb::estimators {
namespace {

/// The identifier of a pixel for its key.
std::uint32_t number_of(const Pixel& pixel, int width) {
    return static_cast<std::uint32_t>(pixel.y) * static_cast<std::uint32_t>(width) +
           static_cast<std::uint32_t>(pixel.x);
}

/// The random numbers of a pixel's sample: Sobol' points for the position in the pixel and for the first
/// light and direction.
math::SampleStream stream_of(const Pixel& pixel, int width, const Pass& pass) {
    constexpr unsigned sobol_dimensions = 8;
    return {pass.key.derived(PassStream::pixels).derived(number_of(pixel, width)), pass.index,
            sobol_dimensions};
}

/// The unit direction of a pixel's sample; nothing outside of the camera's field.
std::optional<Vec3> sample_pixel(const PictureTracing& tracing, const Pixel& pixel, double u1, double u2) {
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

/// A sample of a pixel uses so many Sobol' dimensions: for the position in the pixel, and for light and
/// direction at two vertices.
constexpr unsigned kPacketSobolDimensions = 12;

/// The rays of up to sixteen pixels, the first of which has the number `first`. Sets the lanes that have one.
void start_packet(const PictureTracing& tracing, std::span<const Pixel> pixels, std::size_t first,
                  const Pass& pass, transport::PathPacket& packet, LaneMask& lanes) {
    math::StreamPacket::Words numbers{};
    for (std::size_t i = 0; i < pixels.size(); ++i)
        numbers[i] = number_of(pixels[i], tracing.camera.resolution[0]);
    set_derived_keys(pass.key.derived(PassStream::pixels), numbers, packet.streams);
    packet.streams.index_low.fill(static_cast<std::uint32_t>(pass.index));
    packet.streams.index_high.fill(static_cast<std::uint32_t>(pass.index >> 32));
    const math::NumberPacket in_pixel = next_four(packet.streams, kPacketSobolDimensions);
    const Vec3 position = tracing.view.position() - tracing.caster.center();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto direction = sample_pixel(tracing, pixels[i], math::unit_interval(in_pixel.words[0][i]),
                                            math::unit_interval(in_pixel.words[1][i]));
        if (!direction) continue;
        lanes[i] = -1;
        packet.number[i] = static_cast<std::uint32_t>(first + i);
        packet.set_ray(i, position, *direction);
    }
    packet.reflections_left.fill(static_cast<std::uint32_t>(tracing.max_reflections));
    packet.previous_pdf_per_sr.fill(std::numeric_limits<float>::infinity());
    for (auto& band : packet.throughput) band.fill(1);
}

}  // namespace

PictureTracing::PictureTracing(const Problem& problem, const transport::LightSampler& all_lights,
                               const transport::Channels* own_channels)
    : scene(problem.scene),
      caster(problem.caster),
      camera(problem.camera.value()),
      view(camera),
      max_reflections(problem.max_reflections),
      channels(own_channels),
      lights(all_lights),
      tracer(scene, caster, lights) {}

CameraPaths PictureTracing::start_paths(std::span<const Pixel> pixels, const Pass& pass) const {
    std::vector<rays::Ray> rays;
    std::vector<math::SampleStream> streams;
    std::vector<std::size_t> pixel_of_ray;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        math::SampleStream stream = stream_of(pixels[i], camera.resolution[0], pass);
        const auto [u1, u2] = stream.next_two();
        const auto direction = sample_pixel(*this, pixels[i], u1, u2);
        if (!direction) continue;
        rays.push_back({view.position(), *direction});
        streams.push_back(stream);
        pixel_of_ray.push_back(i);
    }
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    caster.closest(rays, rays::Coherence::coherent, hits);
    CameraPaths started;
    if (channels) started.parts.resize(pixels.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        transport::LightParts* const parts = channels ? &started.parts[pixel_of_ray[i]] : nullptr;
        if (!hits[i]) {
            if (!lights.has_light_from_outside()) continue;
            auto& [pixel, luminance_cd_m2] = started.outside.emplace_back(pixel_of_ray[i], Rgb{});
            transport::add_part(lights.outside_luminance(rays[i].direction), lights.light_from_outside(), 0,
                                luminance_cd_m2, parts);
            continue;
        }
        transport::Path path{*hits[i], -rays[i].direction, streams[i], max_reflections};
        path.parts = parts;
        path.luminance_cd_m2 = lights.emitted_luminance(path.hit, path.outgoing, parts);
        started.paths.push_back(path);
        started.pixels.push_back(pixel_of_ray[i]);
    }
    return started;
}

void PictureTracing::trace(std::span<const Pixel> pixels, const Pass& pass,
                           const transport::PathTracer& path_tracer, Tally& sums) const {
    if (channels) {  // packets of paths keep no parts
        CameraPaths started = start_paths(pixels, pass);
        path_tracer.trace(started.paths, rays::Coherence::coherent);
        return started.add_to(sums, channels);
    }
    const std::size_t count = (pixels.size() + kPacketWidth - 1) / kPacketWidth;
    std::vector<transport::PathPacket> packets(count);
    std::vector<LaneMask> lanes(count);
    for (std::size_t p = 0; p < count; ++p) {
        const std::size_t first = p * kPacketWidth;
        const auto part = pixels.subspan(first, std::min<std::size_t>(kPacketWidth, pixels.size() - first));
        start_packet(*this, part, first, pass, packets[p], lanes[p]);
    }
    std::vector<Rgb> luminances_cd_m2(pixels.size());
    path_tracer.trace(packets, lanes, kPacketSobolDimensions, rays::Coherence::coherent, luminances_cd_m2);
    for (std::size_t i = 0; i < pixels.size(); ++i) sums.add(i, luminances_cd_m2[i]);
}

void CameraPaths::add_to(Tally& sums, const transport::Channels* channels) const {
    for (const auto& [pixel, luminance_cd_m2] : outside) sums.add(pixel, luminance_cd_m2);
    for (std::size_t i = 0; i < paths.size(); ++i) sums.add(pixels[i], paths[i].luminance_cd_m2);
    for (std::size_t pixel = 0; pixel < parts.size(); ++pixel)
        channels->add(parts[pixel], Rgb::grey(1), 0, pixel, sums.parts);
}

std::vector<Pixel> pixels_of(const PixelBlock& block) {
    std::vector<Pixel> pixels;
    for (int y = block.top; y < block.top + block.height; ++y) {
        for (int x = block.left; x < block.left + block.width; ++x) pixels.push_back({x, y});
    }
    return pixels;
}

}  // namespace stilb::estimators
