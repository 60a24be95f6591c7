// Choosing one of many lights at a point, without asking each of them [Conty Estevez and Kulla 2018].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::transport {

/// A binary tree of bounding boxes. At each node the branch is chosen by what its lights would give a surface
/// there at most, about: their flux over the squared distance, times the largest cosine above the surface. A
/// group of up to kGroup lights is chosen; among them the caller chooses by what each gives. Groups wholly
/// behind the surface are never chosen. Immutable.
class LightTree {
  public:
    struct Light {
        std::uint32_t number = 0;  ///< the caller's
        Bounds bounds;
        double flux_lm = 0;
    };
    static constexpr std::size_t kGroup = 8;

    LightTree() = default;
    explicit LightTree(std::vector<Light> lights);

    /// About the illuminance [lx] by all lights, on the scale of Emitter::rough_illuminance_lx(); 0 only
    /// where it is 0.
    double rough_illuminance_lx(const Vec3& from, const Vec3& normal) const;

    struct Choice {
        std::span<const std::uint32_t> lights;
        double probability = 0;
        double remainder = 0;  ///< uniform in [0, 1), independent of the choice
    };
    /// rough_illuminance_lx() is not 0 there.
    Choice choose(const Vec3& from, const Vec3& normal, double u) const;
    /// The group that a light (of those of the tree) is in, with its probability.
    Choice group_of(std::uint32_t number, const Vec3& from, const Vec3& normal) const;

  private:
    struct Node {
        Vec3 center;
        Vec3 half;  ///< of the box's edges
        double squared_radius_m2 = 0;
        double flux_lm = 0;
        std::uint32_t parent = 0;
        std::uint32_t first = 0;  ///< child, the other follows; of groups: place in `numbers_`
        std::uint32_t count = 0;  ///< of lights in a group; 0 of inner nodes
    };

    void divide(std::uint32_t node, std::span<Light> lights);
    double importance(const Node& node, const Vec3& from, const Vec3& normal) const;
    /// Of the first child beside the other.
    double first_probability(const Node& parent, const Vec3& from, const Vec3& normal) const;
    std::span<const std::uint32_t> group(const Node& node) const {
        return std::span(numbers_).subspan(node.first, node.count);
    }

    std::vector<Node> nodes_;  ///< the root first
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint32_t> group_of_;  ///< by number: the node
};

}  // namespace stilb::transport
