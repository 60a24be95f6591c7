#include "transport/direct/tile_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stilb::transport {
namespace {

using LaneEstimates = RayPacket::Floats;

/// A box relative to the centre.
struct FloatBox {
    float x, y, z, half_x, half_y, half_z, squared_radius, intensity;
};

/// As LightTree estimates a box, for sixteen receivers. Without __restrict, which promises that nothing
/// overlaps, the loop would stay scalar.
STILB_VECTORIZED void estimate_lanes(const rays::LaneVectors& __restrict at,
                                     const rays::LaneVectors& __restrict normal,
                                     const FloatBox& __restrict box, float* __restrict lanes_lx) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const float dx = box.x - at.x[i], dy = box.y - at.y[i], dz = box.z - at.z[i];
        const float height = normal.x[i] * dx + normal.y[i] * dy + normal.z[i] * dz +
                             std::abs(normal.x[i]) * box.half_x + std::abs(normal.y[i]) * box.half_y +
                             std::abs(normal.z[i]) * box.half_z;
        const float squared = dx * dx + dy * dy + dz * dz + box.squared_radius;
        const float cosine = std::min(1.0f, std::max(0.0f, height) / std::sqrt(squared));
        lanes_lx[i] = box.intensity * cosine / squared;
    }
}

}  // namespace

TileChoice::TileChoice(const LightTree& tree, const LightSampler& lights, std::span<const Receiver> tile,
                       const Vec3& center)
    : tree_(tree), lights_(lights), tile_(tile), center_(center) {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        positions_.set(i, tile[i].position() - center);
        normals_.set(i, tile[i].normal());
    }
    /// Keeps the estimates of all lanes.
    struct RecordingView {
        const TileChoice& own;
        std::array<LaneEstimates, LightTree::Cut::kMostOpen>& recorded;
        mutable std::size_t count = 0;
        double nearness(const LightTree::Node& node) const { return own.nearness(node); }
        double estimate_lx(const LightTree::Node& node) const {
            own.estimate(node, recorded[count++]);
            return 0;
        }
    };
    alignas(64) std::array<LaneEstimates, LightTree::Cut::kMostOpen> recorded;
    cut_ = tree.cut(RecordingView{*this, recorded});
    for (std::size_t i = 0; i < tile.size(); ++i) {
        float total = 0;
        for (std::size_t n = 0; n < cut_.count(); ++n) total += recorded[n][i];
        weights_[i] = total > 0 ? 1 / total : 0;
    }
    std::array<double, LightTree::Cut::kMostOpen> estimates{};
    for (std::size_t n = 0; n < cut_.count(); ++n) {
        for (std::size_t i = 0; i < tile.size(); ++i) estimates[n] += double{recorded[n][i] * weights_[i]};
    }
    cut_.set_estimates_lx(estimates);
}

double TileChoice::View::estimate_lx(const LightTree::Node& node) const {
    alignas(64) LaneEstimates lanes_lx;
    own.estimate(node, lanes_lx);
    float sum = 0;
    for (std::size_t i = 0; i < kPacketWidth; ++i) sum += own.weights_[i] * lanes_lx[i];
    return double{sum};
}

double TileChoice::nearness(const LightTree::Node& node) const {
    const Vec3 c = node.center - center_;
    const auto x = static_cast<float>(c.x), y = static_cast<float>(c.y), z = static_cast<float>(c.z);
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < tile_.size(); ++i) {
        const float dx = x - positions_.x[i], dy = y - positions_.y[i], dz = z - positions_.z[i];
        nearest = std::min(nearest, dx * dx + dy * dy + dz * dz);
    }
    return nearest > 0 ? node.squared_radius_m2 / double{nearest} : std::numeric_limits<double>::infinity();
}

void TileChoice::estimate(const LightTree::Node& node, Floats& lanes_lx) const {
    if (node.is_point) {
        lanes_lx.fill(0);
        for (std::size_t i = 0; i < tile_.size(); ++i) {
            lanes_lx[i] = static_cast<float>(lights_.rough_illuminance_lx(node.first, tile_[i].point()));
        }
        return;
    }
    const Vec3 c = node.center - center_;
    const FloatBox box{static_cast<float>(c.x),
                       static_cast<float>(c.y),
                       static_cast<float>(c.z),
                       static_cast<float>(node.half.x),
                       static_cast<float>(node.half.y),
                       static_cast<float>(node.half.z),
                       static_cast<float>(node.squared_radius_m2),
                       static_cast<float>(node.intensity_cd)};
    estimate_lanes(positions_, normals_, box, lanes_lx.data());
}

}  // namespace stilb::transport
