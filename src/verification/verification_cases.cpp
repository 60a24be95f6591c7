
#include "verification/verification_cases.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace stilb::verification {

bool VerificationCase::is_for(const estimators::EstimatorEntry& method) const {
    if (!only_method.empty()) return method.name == only_method;
    // At points double-local is local.
    return measures_luminance() ? method.measures_luminance : method.name != "double-local";
}

std::vector<VerificationCase> verification_cases() {
    std::vector<VerificationCase> all;
    for (const auto family :
         {sobolev_cases, sphere_cases, furnace_cases, source_cases, seen_source_cases, environment_cases}) {
        std::vector<VerificationCase> cases = family();
        all.insert(all.end(), std::make_move_iterator(cases.begin()), std::make_move_iterator(cases.end()));
    }
    return all;
}

MaterialId add_material(Scene& scene, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({fmt::format("material {}", number + 1), material});
    return MaterialId{number};
}

ObjectId add_object(Scene& scene, const Shape& shape, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.push_back({fmt::format("object {}", number + 1), shape, {add_material(scene, material)}});
    return ObjectId{number};
}

void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2) {
    scene.lights.push_back({"light", AreaLight{object, Rgb::grey(luminance_cd_m2)}});
}

void add_environment(Scene& scene, double luminance_cd_m2) {
    scene.lights.push_back({"environment", EnvironmentLight{Rgb::grey(luminance_cd_m2)}});
}

std::vector<Vec3> spread_directions(int count) {
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double radius = std::sqrt(1 - z * z);
        directions.push_back({radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle), z});
    }
    return directions;
}

}  // namespace stilb::verification
