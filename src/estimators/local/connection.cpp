
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

using Bands = std::array<Floats, kBands>;

struct alignas(64) TileSums {
    Bands band{};
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

struct alignas(64) ChannelSums {
    Bands band{};
};

STILB_INLINED void add_share(const Bands& __restrict received, const Rgb& share, Bands& __restrict sums) {
    const auto s0 = static_cast<float>(share[0]), s1 = static_cast<float>(share[1]),
               s2 = static_cast<float>(share[2]);
    for (int i = 0; i < kPacketWidth; ++i) {
        sums[0][i] += s0 * received[0][i], sums[1][i] += s1 * received[1][i],
            sums[2][i] += s2 * received[2][i];
    }
}

/// Adds what a tile receives to each channel, by its share, after so many more reflections.
STILB_VECTORIZED void spread(const Bands& __restrict received, const Rgb* __restrict shares,
                             const transport::Channels& channels, int reflections,
                             ChannelSums* __restrict sums) {
    channels.for_all_after(reflections, [&](std::size_t channel, std::size_t after) {
        add_share(received, shares[channel], sums[after].band);
    });
}

/// What the receivers of a tile get from the points of a block. Where there are channels, it is kept by
/// these.
class BlockSums {
  public:
    explicit BlockSums(const transport::Channels* channels)
        : channels_(channels), of_channels_(channels ? channels->count() : 0), shares_(of_channels_.size()) {}

    /// `add(sums)`: adds what the receivers get from a point.
    template <typename Add>
    void add(const EmittingPoint& point, const Add& add) {
        add(whole_);
        if (!channels_) return;
        if (point.shares) {
            spread(whole_.band, point.shares->data(), *channels_, point.reflections - 1, of_channels_.data());
        } else {
            add_share(whole_.band, Rgb::grey(1),
                      of_channels_[channels_->of(point.light, point.reflections)].band);
        }
        whole_.band = {};
    }

    /// Adds the sums to the readings. Constant responses are multiplied here, once for a block; others are in
    /// the sums.
    void flush(const PointTile& tile, Tally& readings) {
        for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
            const Rgb response = tile.response_of(i);
            readings.sum[tile.readings[i]] += response * received(tile, i, response, readings);
            double& largest = readings.largest[tile.readings[i]];
            largest = std::max(largest, response.luminance() * double{whole_.largest[i]});
        }
        whole_ = {};
        std::ranges::fill(of_channels_, ChannelSums{});
    }

  private:
    static Rgb of_lane(const Bands& bands, std::size_t i) {
        return {{bands[0][i], bands[1][i], bands[2][i]}};
    }

    /// What a receiver gets; adds its shares to the channels.
    Rgb received(const PointTile& tile, std::size_t i, const Rgb& response, Tally& readings) {
        if (!channels_) return of_lane(whole_.band, i);
        Rgb sum;
        for (std::size_t c = 0; c < shares_.size(); ++c) {
            shares_[c] = of_lane(of_channels_[c].band, i);
            sum += shares_[c];
        }
        channels_->add(std::span<const Rgb>(shares_), response, tile.receivers[i].reflections(),
                       tile.readings[i], readings.parts);
        return sum;
    }

    const transport::Channels* channels_;
    TileSums whole_;  ///< with channels: its largest ones alone
    std::vector<ChannelSums> of_channels_;
    std::vector<Rgb> shares_;  ///< of a receiver
};

/// Connects points to the receivers of a tile. `add_visible(point, packet, lanes, g_per_m2, sums)`: adds what
/// these get.
template <typename Point, typename AddVisible>
void connect_all(const rays::RayCaster& caster, const PointTile& tile, std::span<const Point> points,
                 BlockSums& block, Tally& sums, const AddVisible& add_visible) {
    RayPacket packet;
    LaneMask lanes;
    alignas(64) Floats g_per_m2;
    for (std::size_t n = 0; n < points.size(); ++n) {
        const Point& point = points[n];
        if (connect(point.origin, point.reflections, tile, packet, lanes, g_per_m2)) {
            sums.rays += static_cast<std::uint64_t>(-std::accumulate(lanes.begin(), lanes.end(), 0));
            caster.occlude(packet, lanes);
            block.add(point, [&](TileSums& to) { add_visible(point, packet, lanes, g_per_m2, to); });
        }
        if (ends_block(n, points.size())) block.flush(tile, sums);
    }
}

ConnectedVertex connected_vertex(const transport::LightVertex& node, const Vec3& center) {
    const bool is_smooth = node.shading_normal != node.normal;
    const auto* diffuse = is_smooth ? nullptr : node.material->get_if<Diffuse>();
    const Rgb coefficient =
        diffuse ? node.flux_lm * diffuse->reflectance * std::numbers::inv_pi : node.flux_lm;
    ConnectedVertex result{{.origin = SegmentOrigin(node, center),
                            .split = node.only_by_light || !diffuse ? 0.0f : 1.0f,
                            .reflections = node.reflections,
                            .light = node.light,
                            .shares = node.shares},
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
    BlockSums block(channels_);
    for (const PointTile& tile : tiles_) {
        monitor_.require_more();
        connect_all(caster_, tile, std::span<const ConnectedVertex>(connected_vertices), block, sums,
                    [&](const ConnectedVertex& node, const RayPacket& packet, const LaneMask& lanes,
                        const Floats& g_per_m2, TileSums& to) {
                        if (node.directional || tile.directional) {
                            add_visible_directional(node, tile, packet, lanes, g_per_m2, to);
                        } else {
                            add_visible(node, tile, packet, lanes, g_per_m2, to);
                        }
                    });
    }
}

void connect_points(const rays::RayCaster& caster, const PointTile& tile,
                    std::span<const EmittingPoint> points, Tally& sums, const transport::Channels* channels) {
    BlockSums block(channels);
    connect_all(
        caster, tile, points, block, sums,
        [&](const EmittingPoint& point, const RayPacket& packet, const LaneMask& lanes,
            const Floats& g_per_m2, TileSums& to) { add_visible(point, tile, packet, lanes, g_per_m2, to); });
}

}  // namespace stilb::estimators
