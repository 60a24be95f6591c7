#include "verification/case_scenes.h"

#include <fmt/format.h>

#include <cmath>

namespace stilb::verification {

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
