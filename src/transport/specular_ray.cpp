#include "transport/specular_ray.h"

namespace stilb::transport {
namespace {

/// Everything that the two functions need of a surface and the way that a path came to it.
struct Meeting {
    const rays::Hit& hit;
    bool is_pane;
    Frame frame;
    materials::SpecularBranches branches;

    Meeting(const Material& material, const rays::Hit& met, const Vec3& from)
        : hit(met),
          is_pane(passes_straight(material)),
          frame(Frame::of_surface(met.normal)),
          branches(specular_branches(
              material, met.on_front ? materials::LightSide::outside : materials::LightSide::inside,
              frame.to_local(from))) {}

    SpecularRay way(const materials::SpecularBranch& branch, double probability) const {
        const bool reflected = branch.direction.z > 0;
        return {reflected ? hit.lifted : hit.lifted_behind(), frame.to_world(branch.direction),
                branch.share * (1 / probability), branch.luminance_factor, is_pane && !reflected};
    }
};

}  // namespace

std::vector<SpecularRay> specular_rays(const Material& material, const rays::Hit& hit, const Vec3& from) {
    const Meeting meeting(material, hit, from);
    std::vector<SpecularRay> ways;
    for (const materials::SpecularBranch& branch : meeting.branches.list())
        ways.push_back(meeting.way(branch, 1));
    return ways;
}

std::optional<SpecularRay> choose_specular_ray(const Material& material, const rays::Hit& hit,
                                               const Vec3& from, double u) {
    const Meeting meeting(material, hit, from);
    const auto branches = meeting.branches.list();
    if (branches.empty()) return std::nullopt;
    if (branches.size() == 1) return meeting.way(branches[0], 1);
    const double first = branches[0].share.luminance(), second = branches[1].share.luminance();
    const double probability = first / (first + second);
    return u < probability ? meeting.way(branches[0], probability)
                           : meeting.way(branches[1], 1 - probability);
}

}  // namespace stilb::transport
