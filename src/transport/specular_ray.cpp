#include "transport/specular_ray.h"

namespace stilb::transport {
namespace {

/// Everything that the two functions need of a surface and the way that a path came to it.
struct Meeting {
    const rays::Hit& hit;
    bool is_pane;
    materials::ShadedSurface surface;
    materials::SpecularBranches branches;

    Meeting(const Material& material, const rays::Hit& met, const Vec3& from, Carried carried)
        : hit(met),
          is_pane(passes_straight(material)),
          surface(material, met.normal, met.shading_normal),
          branches(
              surface.branches(met.on_front ? materials::LightSide::outside : materials::LightSide::inside,
                               surface.frame().to_local(from), carried)) {}

    SpecularRay way(const materials::SpecularBranch& branch, double probability) const {
        const bool reflected = branch.direction.z > 0;
        return {reflected ? hit.lifted : hit.lifted_behind(), surface.frame().to_world(branch.direction),
                branch.share * (1 / probability), branch.luminance_factor, is_pane && !reflected};
    }
};

}  // namespace

std::vector<SpecularRay> specular_rays(const Material& material, const rays::Hit& hit, const Vec3& from) {
    const Meeting meeting(material, hit, from, Carried::luminance);
    std::vector<SpecularRay> ways;
    for (const materials::SpecularBranch& branch : meeting.branches.list())
        ways.push_back(meeting.way(branch, 1));
    return ways;
}

std::optional<SpecularRay> choose_specular_ray(const Material& material, const rays::Hit& hit,
                                               const Vec3& from, Carried carried, double u) {
    const Meeting meeting(material, hit, from, carried);
    const auto branches = meeting.branches.list();
    if (branches.empty()) return std::nullopt;
    double total = 0;
    for (const materials::SpecularBranch& branch : branches) total += branch.share.luminance();
    double before = 0;
    for (const materials::SpecularBranch& branch : branches.first(branches.size() - 1)) {
        const double probability = branch.share.luminance() / total;
        if (u < before + probability) return meeting.way(branch, probability);
        before += probability;
    }
    return meeting.way(branches.back(), 1 - before);
}

}  // namespace stilb::transport
