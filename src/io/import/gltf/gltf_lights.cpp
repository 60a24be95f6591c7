#include "io/import/gltf/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io/import/luminaires.h"
#include "io/photometry/photometry_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::gltf {
namespace {

constexpr double kDegreesPerRadian = 180 / kPi;

std::string name_of(const PlacedNode& node, const std::string& otherwise) {
    return node.node->name.empty() ? otherwise : node.node->name;
}

class LightReader {
  public:
    LightReader(File& file, ImportedScene& scene) : file_(file), scene_(scene) {}

    void add(const PlacedNode& node) {
        const auto& extensions = node.node->extensions;
        const auto* punctual = find_extension(extensions, "KHR_lights_punctual");
        const auto* profile = find_extension(extensions, "EXT_lights_ies");
        if (punctual == nullptr && profile == nullptr) return;
        if (!is_placeable(node.to_world.translation)) file_.fail(node.part, "its light lies beyond 1e9 m.");
        if (punctual != nullptr) add_punctual(node, index_in(*punctual, "light"));
        if (profile != nullptr) add_profile(node, *profile);
    }

    /// The environment of the directional lights; to be called once, after all nodes.
    void add_distant() {
        if (distant_.empty()) return;
        if (distant_.size() > 1)
            scene_.note(fmt::format("{} directional lights become one, {}.", distant_.size(),
                                    in_quotes(distant_name_)));
        scene_.add_light(distant_name_, distant_lights(distant_));
    }

  private:
    double checked(double value, std::string_view part, std::string_view key) const {
        if (!(value >= 0 && value <= 1e15))
            file_.fail(part, fmt::format("{} is {}. Allowed: from 0 to 1e15.", key, value));
        return value;
    }
    Rgb checked_colour(const Rgb& colour, std::string_view part) const {
        for (const double band : colour.band) checked(band, part, "color");
        return colour;
    }

    void add_punctual(const PlacedNode& node, int index) {
        const tinygltf::Light& light =
            element(file_, file_.model.lights, index, "extensions.KHR_lights_punctual.lights", node.part);
        const std::string part = fmt::format("extensions.KHR_lights_punctual.lights[{}]", index);
        const std::string name =
            name_of(node, light.name.empty() ? fmt::format("light_{}", index) : light.name);
        const Rgb quantity = checked(light.intensity, part, "intensity") *
                             checked_colour(rgb_of(light.color, Rgb::grey(1)), part);
        if (!(quantity.luminance() > 0)) {
            scene_.warnings.add("light", name, "it is dark and left out.");
            return;
        }
        if (light.range > 0)
            scene_.warnings.add("light", name,
                                "its range is left out: its light reaches as far as it does in reality.");
        const Vec3& position = node.to_world.translation;
        if (light.type == "point") return scene_.add_light(name, PointLight{position, quantity});
        const Vec3 forward = forward_of(node);
        if (light.type == "spot") return add_spot(node, name, part, light.spot, quantity);
        if (light.type != "directional") {
            file_.fail(part, fmt::format("type \"{}\" is not allowed. Allowed: point, spot, directional.",
                                         light.type));
        }
        if (distant_.empty()) distant_name_ = name;
        distant_.push_back({-forward, quantity});
    }

    Vec3 forward_of(const PlacedNode& node) const {
        const Vec3 forward = -node.to_world.z_axis;
        if (!(squared_length(forward) > 0) || !is_finite(forward))
            file_.fail(node.part, "its light has no direction, because the scale of the node is 0.");
        return normalized(forward);
    }

    Luminaire luminaire_at(const PlacedNode& node, NamedSolid solid, const Rgb& factor) {
        const auto [c0, c90, nadir] = luminaire_frame(forward_of(node), node.to_world.x_axis);
        std::vector<NamedSolid>& solids = scene_.file.scene.solids;
        const auto found = std::ranges::find(solids, solid.file, &NamedSolid::file);
        const SolidId id{static_cast<std::uint32_t>(found - solids.begin())};
        if (found == solids.end()) solids.push_back(std::move(solid));
        return {node.to_world.translation, id, c0, c90, nadir, factor};
    }

    void add_spot(const PlacedNode& node, const std::string& name, const std::string& part,
                  const tinygltf::SpotLight& spot, const Rgb& intensity_cd) {
        const double inner = spot.innerConeAngle, outer = spot.outerConeAngle;
        if (!(inner >= 0 && outer > 0 && outer <= kPi / 2 + 1e-6 && inner <= outer)) {
            file_.fail(part, fmt::format("its cone angles are {} and {}. Allowed: 0 <= innerConeAngle < "
                                         "outerConeAngle <= pi / 2.",
                                         inner, outer));
        }
        const double inner_deg = inner * kDegreesPerRadian, outer_deg = outer * kDegreesPerRadian;
        const std::string file = fmt::format("spot of {:.6g} to {:.6g} degrees", inner_deg, outer_deg);
        const std::string text = to_ies(spot_grid(inner_deg, outer_deg), file);
        scene_.add_light(name, luminaire_at(node, solid_of(text, file), intensity_cd));
    }

    void add_profile(const PlacedNode& node, const tinygltf::Value& reference) {
        const int index = index_in(reference, "light");
        const std::string name = name_of(node, fmt::format("luminaire_{}", index));
        const NamedSolid& solid = profile(index, node.part);
        const Rgb colour = checked_colour(rgb_in(reference, "color", Rgb::grey(1)), node.part);
        const double multiplier = checked(number_in(reference, "multiplier", 1), node.part, "multiplier");
        if (!(multiplier * colour.luminance() > 0)) {
            scene_.warnings.add("light", name, "it is dark and left out.");
            return;
        }
        scene_.add_light(name, luminaire_at(node, solid, multiplier * colour));
    }

    const NamedSolid& profile(int index, const std::string& part) {
        if (const auto known = profiles_.find(index); known != profiles_.end()) return known->second;
        const auto* const list = find_extension(file_.model.extensions, "EXT_lights_ies");
        const tinygltf::Value* const profiles = list == nullptr ? nullptr : &list->Get("lights");
        if (profiles == nullptr || !profiles->IsArray() || index < 0 ||
            static_cast<std::size_t>(index) >= profiles->ArrayLen())
            file_.fail(part,
                       fmt::format("it refers to extensions.EXT_lights_ies.lights[{}], which does not exist.",
                                   index));
        const std::string where = fmt::format("extensions.EXT_lights_ies.lights[{}]", index);
        const auto [content, name] = profile_content(profiles->Get(index), where);
        return profiles_.try_emplace(index, solid_of(content, name)).first->second;
    }

    /// `name`: of the file; the content of other files is kept for `import`.
    NamedSolid solid_of(const std::string& content, const std::string& name) {
        const PhotometryFile photometry = read_photometry(content, name);
        const PhotometricSolid solid(photometry.grid);
        for (const std::string& warning : photometry_warnings(photometry, solid))
            scene_.warnings.add("luminaire", name, warning);
        scene_.file.embedded_luminaires[name] = content;
        return {name,
                photometry.luminaire,
                solid,
                photometry.format,
                check_flux(photometry, solid.flux_lm()).description(),
                {},
                photometry.power_w};
    }

    /// The text of an IES file and its name for messages.
    std::pair<std::string, std::string> profile_content(const tinygltf::Value& profile,
                                                        const std::string& part) {
        if (const int view = index_in(profile, "bufferView"); view >= 0)
            return {std::string(file_.bytes_of_view(view, part)), file_.path.string() + ": " + part};
        const tinygltf::Value& uri = profile.Get("uri");
        if (!uri.IsString()) file_.fail(part, "it has neither a \"uri\" nor a \"bufferView\".");
        const std::string& text = uri.Get<std::string>();
        if (!is_data_uri(text)) return {file_.read_beside(text, part), text};
        const auto content = data_of_uri(text);
        if (!content) file_.fail(part, "its data URI is not in base64.");
        return {*content, file_.path.string() + ": " + part};
    }

    File& file_;
    ImportedScene& scene_;
    std::vector<DistantLight> distant_;
    std::string distant_name_;
    std::map<int, NamedSolid> profiles_;
};

void add_camera(const File& file, const PlacedNode& node, ImportedScene& scene) {
    const tinygltf::Camera& camera =
        element(file, file.model.cameras, node.node->camera, "cameras", node.part);
    const std::string part = fmt::format("cameras[{}]", node.node->camera);
    const std::string name = name_of(node, camera.name.empty() ? part : camera.name);
    if (camera.type != "perspective") {
        scene.warnings.add("camera", name, "it is no perspective camera and is left out.");
        return;
    }
    constexpr double kUsualAspect = 16.0 / 9;
    const double aspect = camera.perspective.aspectRatio > 0 ? camera.perspective.aspectRatio : kUsualAspect;
    const double height = std::tan(camera.perspective.yfov / 2);
    if (!(camera.perspective.yfov > 0 && camera.perspective.yfov < kPi && aspect > 0.01 && aspect < 100))
        file.fail(part, "yfov must lie between 0 and pi, and aspectRatio between 0.01 and 100.");
    const Vec3 forward = -node.to_world.z_axis, up = node.to_world.y_axis;
    if (!is_placeable(node.to_world.translation) || !(squared_length(cross(forward, up)) > 0)) {
        scene.warnings.add("camera", name, "it has no place or no direction and is left out.");
        return;
    }
    constexpr double kLongSide = 1280;
    const double width = aspect >= 1 ? kLongSide : kLongSide * aspect;
    Camera view;
    view.position = node.to_world.translation;
    view.target = view.position + normalized(forward);
    view.up = normalized(up);
    view.fov_deg = std::clamp(2 * std::atan(height * aspect) * kDegreesPerRadian, 0.001, 179.9);
    view.resolution = {std::max(1, static_cast<int>(std::lround(width))),
                       std::max(1, static_cast<int>(std::lround(width / aspect)))};
    scene.add_sensor(name, view);
}

}  // namespace

void add_lights(File& file, const std::vector<PlacedNode>& nodes, ImportedScene& scene) {
    LightReader reader(file, scene);
    for (const PlacedNode& node : nodes) {
        if (!node.is_copy) reader.add(node);
    }
    reader.add_distant();
}

void add_cameras(const File& file, const std::vector<PlacedNode>& nodes, ImportedScene& scene) {
    for (const PlacedNode& node : nodes) {
        if (node.node->camera >= 0 && !node.is_copy) add_camera(file, node, scene);
    }
}

}  // namespace stilb::io::gltf
