#include "estimators/local/sub_points.h"

#include <algorithm>
#include <cmath>

namespace stilb::estimators {
namespace {

/// Sobol' dimensions of a sample of direct light.
constexpr unsigned kDirectDimensions = 8;

/// The edge of cells, in pixels: their plans must not take much memory.
int cell_edge_of(const std::array<int, 2>& resolution) {
    constexpr std::size_t most_cells = 4096;
    int edge = kBlockSize;
    while (blocks_of(resolution, {edge, edge}, edge).size() > most_cells) edge *= 2;
    return edge;
}

const transport::Receiver& middle_of(const SubPointPacket& packet) {
    return packet.receivers[packet.receivers.size() / 2];
}

/// Whether the sub-points lie in one plane: what is near to one of them is not far from the others, nor
/// behind them.
bool is_flat(const SubPointPacket& packet) {
    const transport::Receiver& middle = middle_of(packet);
    return std::ranges::all_of(packet.receivers, [&](const transport::Receiver& receiver) {
        constexpr double parallel = 0.95, level = 0.05;
        const Vec3 offset = receiver.position() - middle.position();
        return dot(receiver.normal(), middle.normal()) > parallel &&
               std::abs(dot(offset, middle.normal())) <= level * length(offset);
    });
}

}  // namespace

void choose_near(const NearNodePool& pool, std::span<const SubPointPacket> packets, double k_per_m2,
                 const ReceiveNear& receive) {
    std::vector<transport::Receiver> middles;
    for (const SubPointPacket& packet : packets) middles.push_back(middle_of(packet));
    const KernelChoice::Sums of_block = pool.sums_for(middles, k_per_m2);
    for (const SubPointPacket& packet : packets) {
        if (is_flat(packet)) {
            receive(packet, of_block);
        } else {
            receive(packet, pool.sums_for(packet.receivers, k_per_m2));
        }
    }
}

math::RandomKey SubPointPacket::key(const Pass& pass, PassStream purpose) const {
    return pass.key.derived(purpose).derived(static_cast<std::uint64_t>(first.x) << 32 |
                                             static_cast<std::uint64_t>(first.y));
}

SubPoints::SubPoints(const LocalTransport& transport, const Problem& problem, std::uint64_t direct_samples)
    : transport_(transport),
      tracing_(problem, transport.lights, problem.channels),
      direct_samples_(direct_samples),
      cell_edge_(cell_edge_of(tracing_.camera.resolution)),
      cells_(blocks_of(tracing_.camera.resolution, {cell_edge_, cell_edge_}, cell_edge_)) {}

std::vector<SubPointPacket> SubPoints::of_block(const PixelBlock& block, const Pass& pass,
                                                Tally& sums) const {
    std::vector<SubPointPacket> packets;
    for (int top = 0; top < block.height; top += kPacketSide) {
        for (int left = 0; left < block.width; left += kPacketSide) {
            SubPointPacket packet = of_packet(block, left, top, pass, sums);
            if (packet.receivers.empty()) continue;
            add_direct(packet, pass, sums);
            packets.push_back(std::move(packet));
        }
    }
    return packets;
}

SubPointPacket SubPoints::of_packet(const PixelBlock& block, int left, int top, const Pass& pass,
                                    Tally& sums) const {
    SubPointPacket packet;
    packet.first = {block.left + left, block.top + top};
    const int width = std::min(kPacketSide, block.width - left);
    const std::vector<Pixel> pixels =
        pixels_of({packet.first.x, packet.first.y, width, std::min(kPacketSide, block.height - top)});
    const auto reading_of = [&](std::size_t pixel) {
        const int x = left + static_cast<int>(pixel) % width, y = top + static_cast<int>(pixel) / width;
        return static_cast<std::uint32_t>(y * block.width + x);
    };
    packet.receivers.reserve(kPacketWidth);
    CameraPaths started = tracing_.start_paths(pixels, pass);
    for (const auto& [pixel, luminance_cd_m2] : started.outside) sums.add(reading_of(pixel), luminance_cd_m2);
    for (std::size_t i = 0; i < started.paths.size(); ++i) {
        const std::size_t pixel = started.pixels[i];
        sums.add(reading_of(pixel), add(started.paths[i], reading_of(pixel), packet.receivers));
        packet.pixels.resize(packet.receivers.size(), pixels[pixel]);
    }
    for (std::size_t pixel = 0; pixel < started.parts.size(); ++pixel)
        tracing_.channels->add(started.parts[pixel], Rgb::grey(1), 0, reading_of(pixel), sums.parts);
    return packet;
}

void SubPoints::add_direct(const SubPointPacket& packet, const Pass& pass, Tally& sums) const {
    const std::span<const transport::Receiver> receivers = packet.receivers;
    std::array<transport::LightParts, kPacketWidth> parts;
    const auto add = [&](const transport::DirectLight::TileLight& light, double weight) {
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            sums.add(receivers[i].reading(), light[i] * weight);
            if (!tracing_.channels) continue;
            tracing_.channels->add(parts[i], Rgb::grey(weight), receivers[i].reflections(),
                                   receivers[i].reading(), sums.parts);
            parts[i].clear();
        }
    };
    transport::DirectLight::TileLight light{{}, tracing_.channels ? &parts : nullptr}, sampled = light;
    const transport::DirectLight::Remainder remainder = transport_.direct.add_certain(receivers, light);
    add(light, 1);
    if (remainder.is_empty()) return;
    const auto width = static_cast<std::uint64_t>(tracing_.camera.resolution[0]);
    for (std::uint64_t sample = 0; sample < direct_samples_; ++sample) {
        std::vector<math::SampleStream> streams;
        for (const auto& [x, y] : packet.pixels) {
            const std::uint64_t pixel = static_cast<std::uint64_t>(y) * width + static_cast<std::uint64_t>(x);
            streams.emplace_back(pass.key.derived(PassStream::direct).derived(pixel),
                                 direct_samples_ * pass.index + sample, kDirectDimensions);
        }
        transport_.direct.add_sample(receivers, remainder, streams, sampled);
    }
    add(sampled, 1 / static_cast<double>(direct_samples_));
}

Rgb SubPoints::add(transport::Path& path, std::uint32_t reading,
                   std::vector<transport::Receiver>& receivers) const {
    const auto scattering = transport_.tracer.follow_to_scattering(path);
    const Rgb emission = path.luminance_cd_m2;
    if (!scattering || path.reflections_left == 0) return emission;
    receivers.emplace_back(
        reading,
        transport::SubPoint{path.hit, path.outgoing, path.throughput,
                            tracing_.max_reflections - path.reflections_left, scattering->lobe},
        tracing_.scene.material(path.hit.material));
    return emission;
}

std::size_t SubPoints::cell_of(const Pixel& pixel) const {
    const int cells_per_row = (tracing_.camera.resolution[0] + cell_edge_ - 1) / cell_edge_;
    const int cell = pixel.y / cell_edge_ * cells_per_row + pixel.x / cell_edge_;
    return static_cast<std::size_t>(cell);
}

std::vector<transport::Receiver> SubPoints::of_cell(std::size_t cell, const Pass& pass) const {
    const PixelBlock& block = cells_[cell];
    std::vector<Pixel> pixels;
    for (int i = 0; i < kPacketWidth; ++i) {
        pixels.push_back({block.left + (4 * (i % 4) + 2) * block.width / 16,
                          block.top + (4 * (i / 4) + 2) * block.height / 16});
    }
    std::vector<transport::Receiver> receivers;
    for (transport::Path& path : tracing_.start_paths(pixels, pass).paths) add(path, 0, receivers);
    return receivers;
}

}  // namespace stilb::estimators
