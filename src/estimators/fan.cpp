#include "estimators/fan.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/vectorized.h"
#include "estimators/kernel_split.h"

namespace stilb {
namespace {

using Floats = Fan::Tile::Floats;

/// Nodes whose contributions are summed in single precision before they are added to the sums in double.
constexpr std::size_t kBlock = 64;

/// A chain node as the inner loop wants it.
struct FanNode {
    float x, y, z;
    float lifted_x, lifted_y, lifted_z;
    float normal_x, normal_y, normal_z;
    float split;  ///< 0: the loop leaves w = 1
    std::array<float, kBands>
        coefficient;               ///< flux times BRDF; flux alone where the BRDF depends on direction
    const ChainNode* directional;  ///< null where the BRDF is constant
};

struct alignas(64) TileSums {
    std::array<Floats, kBands> band{};
    Floats largest{};
};

/// Segments from the node to the tile's points, and w G where both cosines are positive. False: no lane is
/// active. (Without the promise that nothing overlaps, the loops here and below would stay scalar.)
STILB_VECTORIZED bool prepare(const FanNode& __restrict node, const Fan::Tile& __restrict tile,
                              RayPacket& __restrict packet, LaneMask& __restrict lanes,
                              Floats& __restrict kernel) {
    std::int32_t any = 0;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float dx = tile.x[i] - node.x, dy = tile.y[i] - node.y, dz = tile.z[i] - node.z;
        packet.origin_x[i] = node.lifted_x, packet.origin_y[i] = node.lifted_y,
        packet.origin_z[i] = node.lifted_z;
        packet.direction_x[i] = tile.lifted_x[i] - node.lifted_x;
        packet.direction_y[i] = tile.lifted_y[i] - node.lifted_y;
        packet.direction_z[i] = tile.lifted_z[i] - node.lifted_z;
        packet.end[i] = 1;
        const float squared = dx * dx + dy * dy + dz * dz;
        const float cos_node = node.normal_x * dx + node.normal_y * dy + node.normal_z * dz;
        const float cos_point = -(tile.normal_x[i] * dx + tile.normal_y[i] * dy + tile.normal_z[i] * dz);
        const std::int32_t active = -static_cast<std::int32_t>((cos_node > 0) & (cos_point > 0));
        const float g = active ? cos_node * cos_point / (squared * squared) : 0;
        kernel[i] = g / (1 + g * tile.inverse_k[i] * node.split);
        lanes[i] = active;
        any |= active;
    }
    return any != 0;
}

STILB_VECTORIZED void add_visible(const FanNode& __restrict node, const RayPacket& __restrict packet,
                                  const LaneMask& __restrict lanes, const Floats& __restrict kernel,
                                  TileSums& __restrict sums) {
    const float luminance = static_cast<float>(kLuminanceWeights[0]) * node.coefficient[0] +
                            static_cast<float>(kLuminanceWeights[1]) * node.coefficient[1] +
                            static_cast<float>(kLuminanceWeights[2]) * node.coefficient[2];
    for (int i = 0; i < kPacketWidth; ++i) {
        // & rather than &&: without a branch the loop vectorises.
        const int lit = static_cast<int>(lanes[i] != 0) & static_cast<int>(packet.end[i] >= 0);
        const float visible = lit != 0 ? kernel[i] : 0;
        sums.band[0][i] += visible * node.coefficient[0];
        sums.band[1][i] += visible * node.coefficient[1];
        sums.band[2][i] += visible * node.coefficient[2];
        sums.largest[i] = std::max(sums.largest[i], visible * luminance);
    }
}

/// As add_visible() for a BRDF that depends on the direction to the point: evaluated lane by lane, w
/// included.
void add_visible_directional(const FanNode& node, const Fan::Tile& tile, const RayPacket& packet,
                             const LaneMask& lanes, const Floats& kernel, TileSums& sums) {
    const Frame frame = Frame::around(node.directional->normal);
    const Vec3 in = frame.to_local(node.directional->incoming);
    for (int i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] == 0 || packet.end[i] < 0) continue;
        const Vec3 to_point{packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]};
        const Spectrum brdf =
            evaluate_brdf_per_sr(*node.directional->material, in, frame.to_local(normalized(to_point)));
        const double g = kernel[i];
        const double gathered = relative_brdf(*node.directional->material, brdf) * g * tile.inverse_k[i];
        const double chain_share = node.directional->only_by_light ? 1 : 1 / (1 + gathered);
        const Spectrum added = node.directional->flux_lm * brdf * (g * chain_share);
        for (std::size_t b = 0; b < kBands; ++b) sums.band[b][i] += static_cast<float>(added[b]);
        sums.largest[i] = std::max(sums.largest[i], static_cast<float>(added.luminance()));
    }
}

void flush(const Fan::Tile& tile, TileSums& sums, ReadingSums& readings) {
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (tile.normal_x[i] == 0 && tile.normal_y[i] == 0 && tile.normal_z[i] == 0) continue;
        const std::uint32_t reading = tile.reading[i];
        for (std::size_t b = 0; b < kBands; ++b) readings.sum[reading][b] += double{sums.band[b][i]};
        readings.largest_lx[reading] = std::max(readings.largest_lx[reading], double{sums.largest[i]});
    }
    sums = {};
}

FanNode fan_node(const ChainNode& node, const Vec3& center) {
    const Vec3 p = node.position - center;
    const auto* diffuse = std::get_if<Diffuse>(node.material);
    const Spectrum coefficient =
        diffuse ? node.flux_lm * diffuse->reflectance * std::numbers::inv_pi : node.flux_lm;
    const Vec3 lifted = node.lifted - center;
    FanNode result{static_cast<float>(p.x),
                   static_cast<float>(p.y),
                   static_cast<float>(p.z),
                   static_cast<float>(lifted.x),
                   static_cast<float>(lifted.y),
                   static_cast<float>(lifted.z),
                   static_cast<float>(node.normal.x),
                   static_cast<float>(node.normal.y),
                   static_cast<float>(node.normal.z),
                   node.only_by_light || !diffuse ? 0.0f : 1.0f,
                   {},
                   diffuse ? nullptr : &node};
    for (std::size_t b = 0; b < kBands; ++b) result.coefficient[b] = static_cast<float>(coefficient[b]);
    return result;
}

}  // namespace

Fan::Fan(const RayCaster& caster, std::span<const PackedPoint> points, std::span<const double> k_per_m2)
    : caster_(caster), tiles_((points.size() + kPacketWidth - 1) / kPacketWidth) {
    for (std::size_t j = 0; j < points.size(); ++j) {
        const Vec3 p = points[j].position - caster.center();
        const Vec3 lifted = points[j].lifted - caster.center();
        const Vec3& normal = points[j].normal;
        Tile& tile = tiles_[j / kPacketWidth];
        const std::size_t i = j % kPacketWidth;
        tile.x[i] = static_cast<float>(p.x), tile.y[i] = static_cast<float>(p.y),
        tile.z[i] = static_cast<float>(p.z);
        tile.lifted_x[i] = static_cast<float>(lifted.x);
        tile.lifted_y[i] = static_cast<float>(lifted.y);
        tile.lifted_z[i] = static_cast<float>(lifted.z);
        tile.normal_x[i] = static_cast<float>(normal.x);
        tile.normal_y[i] = static_cast<float>(normal.y);
        tile.normal_z[i] = static_cast<float>(normal.z);
        tile.inverse_k[i] = static_cast<float>(1 / k_per_m2[j]);
        tile.reading[i] = points[j].reading;
    }
}

void Fan::collect(std::span<const ChainNode> nodes, ReadingSums& sums) const {
    std::vector<FanNode> fan_nodes;
    fan_nodes.reserve(nodes.size());
    for (const ChainNode& node : nodes) fan_nodes.push_back(fan_node(node, caster_.center()));
    RayPacket packet;
    LaneMask lanes;
    alignas(64) Floats kernel;
    for (const Tile& tile : tiles_) {
        TileSums tile_sums;
        for (std::size_t n = 0; n < fan_nodes.size(); ++n) {
            const FanNode& node = fan_nodes[n];
            if (prepare(node, tile, packet, lanes, kernel)) {
                sums.rays += static_cast<std::uint64_t>(-std::accumulate(lanes.begin(), lanes.end(), 0));
                caster_.occlude(packet, lanes);
                if (node.directional == nullptr) {
                    add_visible(node, packet, lanes, kernel, tile_sums);
                } else {
                    add_visible_directional(node, tile, packet, lanes, kernel, tile_sums);
                }
            }
            if (n % kBlock == kBlock - 1) flush(tile, tile_sums, sums);
        }
        flush(tile, tile_sums, sums);
    }
}

}  // namespace stilb
