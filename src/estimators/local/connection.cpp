
#include "estimators/local/connection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/rays.h"
#include "materials/diffuse.h"
#include "materials/shaded_surface.h"
#include "transport/weights.h"

namespace stilb::estimators {

namespace {

using Floats = PointTile::Floats;

/// Vertices whose contributions are summed in single precision before they are added to the sums in double.
constexpr std::size_t kBlock = 64;

/// Whether vertex n of `count` is the last of its block.
bool ends_block(std::size_t n, std::size_t count) { return n % kBlock == kBlock - 1 || n + 1 == count; }

/// A light vertex in the form of the inner loop. Its coefficient is its flux alone where the BRDF depends on
/// direction.
struct ConnectedVertex : EmittingPoint {
    const transport::LightVertex* node;
    bool directional;  ///< the BRDF depends on direction
};

struct alignas(64) TileSums {
    std::array<Floats, kBands> band{};
    Floats largest{};
};

/// (Without __restrict, which promises that nothing overlaps, the loop would stay scalar.)
STILB_VECTORIZED void add_visible(const EmittingPoint& __restrict node, const PointTile& __restrict tile,
                                  const RayPacket& __restrict packet, const LaneMask& __restrict lanes,
                                  const Floats& __restrict g, TileSums& __restrict sums) {
    const float luminance = std::abs(static_cast<float>(kLuminanceWeights[0]) * node.coefficient[0] +
                                     static_cast<float>(kLuminanceWeights[1]) * node.coefficient[1] +
                                     static_cast<float>(kLuminanceWeights[2]) * node.coefficient[2]);
    for (int i = 0; i < kPacketWidth; ++i) {
        // & rather than &&: without a branch the loop vectorises.
        const int lit = static_cast<int>(lanes[i] != 0) & static_cast<int>(packet.end[i] >= 0);
        const float visible = lit != 0 ? g[i] / (1 + g[i] * tile.inverse_k[i] * node.split) : 0;
        sums.band[0][i] += visible * node.coefficient[0];
        sums.band[1][i] += visible * node.coefficient[1];
        sums.band[2][i] += visible * node.coefficient[2];
        sums.largest[i] = std::max(sums.largest[i], visible * luminance);
    }
}

/// The counterpart of add_visible() where the BRDF of the vertex or the response of a receiver depends on
/// direction: lane by lane, w included.
void add_visible_directional(const ConnectedVertex& node, const PointTile& tile, const RayPacket& packet,
                             const LaneMask& lanes, const Floats& g_per_m2, TileSums& sums) {
    const transport::LightVertex& vertex = *node.node;
    const materials::ShadedSurface surface(*vertex.material, vertex.normal, vertex.shading_normal);
    const Frame& frame = surface.frame();
    const Vec3 in = frame.to_local(vertex.incoming);
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        if (lanes[i] == 0 || packet.end[i] < 0) continue;
        const Vec3 to_point =
            normalized(Vec3{packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]});
        const Rgb brdf = surface.brdf_per_sr(in, frame.to_local(to_point));
        const transport::Receiver::Response response = tile.receivers[i].response(-to_point);
        const double relative =
            transport::bounding_brdf(transport::relative_brdf(*vertex.material, brdf), tile.choice) *
            response.relative * vertex.split;
        const double g = g_per_m2[i];
        const double connected_share = vertex.only_by_light ? 1 : 1 / (1 + relative * g * tile.inverse_k[i]);
        Rgb added = vertex.flux_lm * brdf * (g * connected_share);
        if (tile.directional) added = added * response.value;
        for (std::size_t b = 0; b < kBands; ++b) sums.band[b][i] += static_cast<float>(added[b]);
        sums.largest[i] = std::max(sums.largest[i], static_cast<float>(added.luminance()));
    }
}

/// Constant responses are multiplied here, once for a block of vertices; others are in the sums.
/// `add_shares(reading, received, response, reflections)`: adds what the channels get of what a receiver
/// gets.
template <typename AddShares>
void flush(const PointTile& tile, TileSums& sums, Tally& readings, const AddShares& add_shares) {
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const Rgb response = tile.response_of(i);
        const Rgb received{{sums.band[0][i], sums.band[1][i], sums.band[2][i]}};
        readings.sum[tile.readings[i]] += response * received;
        add_shares(tile.readings[i], received, response, tile.receivers[i].reflections());
        double& largest = readings.largest[tile.readings[i]];
        largest = std::max(largest, response.luminance() * double{sums.largest[i]});
    }
    sums = {};
}

ConnectedVertex connected_vertex(const transport::LightVertex& node, const Vec3& center) {
    const bool is_smooth = node.shading_normal != node.normal;
    const auto* diffuse = is_smooth ? nullptr : node.material->get_if<Diffuse>();
    const Rgb coefficient =
        diffuse ? node.flux_lm * diffuse->reflectance * std::numbers::inv_pi : node.flux_lm;
    ConnectedVertex result{
        {SegmentOrigin(node, center), node.only_by_light || !diffuse ? 0.0f : 1.0f, {}, node.shares},
        &node,
        diffuse == nullptr};
    for (std::size_t b = 0; b < kBands; ++b) result.coefficient[b] = static_cast<float>(coefficient[b]);
    return result;
}

}  // namespace

void Connections::collect(std::span<const transport::LightVertex> nodes, Tally& sums) const {
    std::vector<ConnectedVertex> connected_vertices;
    connected_vertices.reserve(nodes.size());
    for (const transport::LightVertex& node : nodes)
        connected_vertices.push_back(connected_vertex(node, caster_.center()));
    // Vertices of one channel, or of the same shares, one after another, so that their sums are flushed
    // together.
    const auto channel_of = [&](const ConnectedVertex& vertex) {
        return std::pair(channels_->groups.of_light[vertex.node->light], vertex.node->reflections);
    };
    if (channels_) std::ranges::stable_sort(connected_vertices, {}, channel_of);
    const auto ends_channel = [&](std::size_t n) {
        return channels_ && n + 1 < connected_vertices.size() &&
               (channel_of(connected_vertices[n]) != channel_of(connected_vertices[n + 1]) ||
                connected_vertices[n].shares != connected_vertices[n + 1].shares);
    };
    const auto flush_channel = [&](const PointTile& tile, TileSums& tile_sums,
                                   const transport::LightVertex& node) {
        flush(tile, tile_sums, sums,
              [&](std::size_t reading, const Rgb& received, const Rgb& response, int reflections) {
                  if (!channels_) return;
                  if (node.shares)
                      return channels_->add(std::span(*node.shares), response * received,
                                            node.reflections - 1 + reflections, reading, sums.parts);
                  const transport::LightPart part{received, node.light, node.reflections};
                  channels_->add({&part, 1}, response, reflections, reading, sums.parts);
              });
    };
    RayPacket packet;
    LaneMask lanes;
    alignas(64) Floats g_per_m2;
    for (const PointTile& tile : tiles_) {
        monitor_.require_more();
        TileSums tile_sums;
        for (std::size_t n = 0; n < connected_vertices.size(); ++n) {
            const ConnectedVertex& node = connected_vertices[n];
            if (connect(node.origin, node.node->reflections, tile, packet, lanes, g_per_m2)) {
                sums.rays += static_cast<std::uint64_t>(-std::accumulate(lanes.begin(), lanes.end(), 0));
                caster_.occlude(packet, lanes);
                if (node.directional || tile.directional) {
                    add_visible_directional(node, tile, packet, lanes, g_per_m2, tile_sums);
                } else {
                    add_visible(node, tile, packet, lanes, g_per_m2, tile_sums);
                }
            }
            if (ends_block(n, connected_vertices.size()) || ends_channel(n))
                flush_channel(tile, tile_sums, *node.node);
        }
    }
}

void connect_points(const rays::RayCaster& caster, const PointTile& tile,
                    std::span<const EmittingPoint> points, Tally& sums, const transport::Channels* channels) {
    RayPacket packet;
    LaneMask lanes;
    alignas(64) Floats g_per_m2;
    TileSums tile_sums;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (connect(points[n].origin, 1, tile, packet, lanes, g_per_m2)) {
            sums.rays += static_cast<std::uint64_t>(-std::accumulate(lanes.begin(), lanes.end(), 0));
            caster.occlude(packet, lanes);
            add_visible(points[n], tile, packet, lanes, g_per_m2, tile_sums);
        }
        if (!channels && !ends_block(n, points.size())) continue;
        flush(tile, tile_sums, sums,
              [&](std::size_t reading, const Rgb& received, const Rgb& response, int reflections) {
                  if (channels)
                      channels->add(std::span(*points[n].shares), response * received, reflections, reading,
                                    sums.parts);
              });
    }
}

}  // namespace stilb::estimators
