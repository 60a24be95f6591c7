// Lights as tables of a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/image/picture_file.h"
#include "io/import/scene_parts.h"
#include "io/photometry/photometry_file.h"
#include "io/scene/toml_text.h"
#include "io/text/text.h"
#include "lights/opening_shape.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr double kDegreesPerTurn = 360;

void push_key(TomlMembers& members, std::string key, TomlValue value) {
    members.push_back({std::move(key), 0, std::move(value)});
}

/// The rotation about the nadir that aim_luminaire() needs for a frame.
double spin_deg(const Vec3& aim, const Vec3& c0) {
    const lights::LuminaireFrame unturned = lights::aim_luminaire(aim, 0);
    return std::atan2(dot(c0, unturned.c90), dot(c0, unturned.c0)) * kDegreesPerTurn / (2 * kPi);
}

/// Every degree of gamma and every 2.5 degrees of C.
PhotometricSolid::Grid tabulated(const PhotometricSolid& solid) {
    constexpr double kStepC = 2.5, kDegree = kPi / 180;
    PhotometricSolid::Grid grid;
    for (int i = 0; i <= 144; ++i) grid.planes_deg.push_back(i * kStepC);
    for (int i = 0; i <= 180; ++i) grid.polar_deg.push_back(i);
    for (const double c : grid.planes_deg) {
        for (const double gamma : grid.polar_deg) {
            const double radius = std::sin(gamma * kDegree);
            grid.intensity_cd.push_back(solid.intensity_cd(
                {radius * std::cos(c * kDegree), radius * std::sin(c * kDegree), std::cos(gamma * kDegree)}));
        }
    }
    return grid;
}

class LightTable {
  public:
    LightTable(const SceneFile& file, const Light& light, SceneOutput& output)
        : file_(file), light_(light), output_(output) {}

    /// Any kind that imports do not make.
    template <typename Source>
    TomlMembers operator()(const Source&) const {
        throw InputError(fmt::format("light {} is of type \"{}\", which only scenes in TOML have.",
                                     in_quotes(light_.name), Source::kType));
    }
    TomlMembers operator()(const PointLight& light) const {
        TomlMembers members{{"type", 0, toml_text("point")}, {"position", 0, toml_vector(light.position)}};
        add_quantity(members, "intensity", light.intensity_cd);
        return members;
    }

    TomlMembers operator()(const AreaLight& light) const {
        const Object& object = file_.scene.object(light.object);
        TomlMembers members{{"type", 0, toml_text("area")}};
        push_key(members, "object",
                 toml_text(object.cut_from ? file_.scene.object(*object.cut_from).name : object.name));
        if (object.cut_from) push_key(members, "material", toml_text(part_name(file_.scene, light.object)));
        add_quantity(members, "luminance", light.luminance_cd_m2);
        return members;
    }

    TomlMembers operator()(const Luminaire& light) const { return luminaire(light, toml_text("point")); }

    TomlMembers operator()(const LuminousOpening& light) const {
        const Shape& shape = file_.scene.object(light.object).shape;
        lights::Opening opening;
        TomlValue written;
        if (const auto* const r = std::get_if<Rectangle>(&shape)) {
            const bool is_along_c0 = std::abs(dot(r->edge_u, light.luminaire.c0)) > length(r->edge_u) / 2;
            const double along_c0 = length(is_along_c0 ? r->edge_u : r->edge_v),
                         along_c90 = length(is_along_c0 ? r->edge_v : r->edge_u);
            opening = {lights::Opening::Form::box, {along_c0, along_c90, 0}};
            written = {TomlArray{toml_number(along_c90), toml_number(along_c0)}};
        } else if (const auto* const disk = std::get_if<Disk>(&shape)) {
            opening = {lights::Opening::Form::vertical_cylinder, {2 * disk->radius, 2 * disk->radius, 0}};
            written = toml_number(2 * disk->radius);
        } else {
            throw InputError(
                fmt::format("the opening of light {} is neither a rectangle nor a disk, which only "
                            "scenes in TOML have.",
                            in_quotes(light_.name)));
        }
        Luminaire source = light.luminaire;
        const auto& solid = file_.scene.solid(source.solid);
        source.scale(Rgb::grey(1 - lights::shape_of(opening, source, solid).hidden_share));
        return luminaire(source, std::move(written));
    }

    TomlMembers operator()(const EnvironmentLight& light) const {
        TomlMembers members{{"type", 0, toml_text("environment")}};
        if (!light.panorama) {
            add_quantity(members, "luminance", light.luminance_cd_m2);
            return members;
        }
        Picture picture;
        picture.width = light.panorama->width();
        picture.height = light.panorama->height();
        picture.rgb_cd_m2 = light.panorama->image().rgb_cd_m2;
        push_key(members, "file", toml_text(output_.write(light_.name, ".exr", to_exr(picture))));
        push_key(members, "up", toml_vector(light.axes.w));
        push_key(members, "rotation", toml_number(spin_deg(-light.axes.w, light.axes.u)));
        return members;
    }

  private:
    /// The quantity without the maintenance factor, which is a key of its own, and its colour.
    void add_quantity(TomlMembers& members, std::string key, const Rgb& quantity) const {
        push_key(members, std::move(key), toml_number(quantity.luminance() / light_.maintenance));
        if (quantity.max() != quantity.min())
            push_key(members, "color", toml_rgb(quantity * (1 / quantity.max())));
    }

    TomlMembers luminaire(const Luminaire& light, TomlValue opening) const {
        TomlMembers members{{"type", 0, toml_text("photometry")}};
        push_key(members, "file", toml_text(luminaire_file(light.solid)));
        push_key(members, "position", toml_vector(light.position));
        push_key(members, "aim", toml_vector(light.nadir));
        push_key(members, "spin", toml_number(spin_deg(light.nadir, light.c0)));
        push_key(members, "opening", std::move(opening));
        add_quantity(members, "dimming", light.factor);
        return members;
    }

    /// Lights with the same file share it.
    std::string luminaire_file(SolidId id) const {
        const std::string& file = file_.scene.solids[index_of(id)].file;
        const std::string content = luminaire_content(file, file_.scene.solid(id));
        const bool is_ies = read_photometry(content, file).format.starts_with("IES");
        const std::string extension = is_ies ? ".ies" : ".ldt";
        return output_.write_once(std::filesystem::path(file).stem().string(), extension, content);
    }

    std::string luminaire_content(const std::string& file, const PhotometricSolid& solid) const {
        const auto known = file_.embedded_luminaires.find(file);
        if (known != file_.embedded_luminaires.end()) return known->second;
        try {
            std::string content = read_whole_file(file);
            read_photometry(content, file);
            return content;
        } catch (const InputError&) {  // a distribution in a format of another program
            return to_ies(tabulated(solid), file);
        }
    }

    const SceneFile& file_;
    const Light& light_;
    SceneOutput& output_;
};

}  // namespace

TomlMembers light_tables(const SceneFile& file, SceneOutput& output) {
    TomlMembers tables;
    for (const Light& light : file.scene.lights) {
        TomlMembers table = std::visit(LightTable(file, light, output), light.source);
        if (!light.group.empty()) push_key(table, "group", toml_text(light.group));
        if (light.maintenance < 1) push_key(table, "maintenance", toml_number(light.maintenance));
        if (light.power_w) push_key(table, "power", toml_number(*light.power_w));
        tables.push_back({light.name, 0, {std::move(table)}});
    }
    return tables;
}

}  // namespace stilb::io
