// Choice of one of many point lights for a tile of receivers at once, so that its shadow rays form a packet.
#pragma once

#include <span>

#include "base/rays.h"
#include "transport/light_sampler.h"
#include "transport/light_tree.h"
#include "transport/receiver.h"

namespace stilb::transport {

/// The probability of a light is the mean over the receivers of its share in their light, estimated as in
/// light_tree.h: above 0 where one of them receives light. No memory is allocated. Keeps references.
class TileChoice {
  public:
    /// `tile`: on surfaces; up to kPacketWidth receivers. `tree`: of point lights. `center`: the ray
    /// caster's.
    TileChoice(const LightTree& tree, const LightSampler& lights, std::span<const Receiver> tile,
               const Vec3& center);

    /// Where no light arrives.
    bool is_empty() const { return !(cut_.total_lx() > 0); }
    /// A light's number with its probability. Precondition: not empty.
    math::DiscreteChoice choose(double u) const { return tree_.choose(cut_, View{*this}, u); }

  private:
    using Floats = RayPacket::Floats;
    /// The view of light_tree.h.
    struct View {
        const TileChoice& own;
        double nearness(const LightTree::Node& node) const { return own.nearness(node); }
        double estimate_lx(const LightTree::Node& node) const;
    };

    double nearness(const LightTree::Node& node) const;
    void estimate(const LightTree::Node& node, Floats& lanes_lx) const;

    const LightTree& tree_;
    const LightSampler& lights_;
    std::span<const Receiver> tile_;
    Vec3 center_;
    /// Of the receivers, relative to the centre; normals are 0 in lanes without one.
    rays::LaneVectors positions_{}, normals_{};
    alignas(64) Floats weights_{};  ///< of lanes: over the estimates of all lights
    LightTree::Cut cut_;
};

}  // namespace stilb::transport
