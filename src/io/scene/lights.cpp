// [lights.NAME]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <unordered_map>
#include <utility>

#include "io/image/picture_file.h"
#include "io/photometry/photometry_file.h"
#include "io/scene/repetition.h"
#include "io/scene/sections.h"
#include "io/text/text.h"
#include "lights/colour_temperature.h"
#include "lights/opening_shape.h"
#include "materials/black.h"
#include "scene/cut_lamps.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr Range kColourTemperature{lights::kMinColourTemperature_k, lights::kMaxColourTemperature_k,
                                   "from 1000 to 25000 K"};
constexpr double kWholeTurnDeg = 360;
/// The objects of a luminaire's opening and of its body have the name of its light, with these endings.
constexpr std::string_view kOpeningSuffix = " (opening)", kBodySuffix = " (body)";
constexpr Range kColour{0, 1e6, "from 0 to 1e6"};
constexpr Range kPower{1e-6, 1e9, "a power from 1e-6 to 1e9 W"};

/// Finds objects and the lamps that they are without a search through all of them, while lights are added.
class LampObjects {
  public:
    explicit LampObjects(const Scene& scene) : scene_(scene) {}

    std::optional<ObjectId> find(const std::string& name) {
        update();
        const auto found = by_name_.find(name);
        return found == by_name_.end() ? std::nullopt : std::optional(found->second);
    }
    /// The name of the light that shines from the object.
    const std::string* light_of(ObjectId object) {
        update();
        const auto found = light_of_.find(object);
        return found == light_of_.end() ? nullptr : &scene_.lights[found->second].name;
    }
    /// The name of the first object that was cut out of this one.
    const std::string* cut_from(ObjectId object) {
        update();
        const auto found = cut_from_.find(object);
        return found == cut_from_.end() ? nullptr : &scene_.object(found->second).name;
    }

  private:
    void update() {
        for (; objects_ < scene_.objects.size(); ++objects_) {
            const Object& object = scene_.objects[objects_];
            const auto id = static_cast<ObjectId>(objects_);
            by_name_.try_emplace(object.name, id);
            if (object.cut_from) cut_from_.try_emplace(*object.cut_from, id);
        }
        for (; lights_ < scene_.lights.size(); ++lights_) {
            if (const auto surface = lights::emitting_object(scene_.lights[lights_]))
                light_of_.try_emplace(*surface, lights_);
        }
    }

    const Scene& scene_;
    std::unordered_map<std::string, ObjectId> by_name_;  ///< the first of each name
    std::unordered_map<ObjectId, ObjectId> cut_from_;
    std::unordered_map<ObjectId, std::size_t> light_of_;
    std::size_t objects_ = 0, lights_ = 0;  ///< those that are known
};

/// The context of reading one light, besides its table.
struct Context {
    const std::string& name;
    const std::filesystem::path& directory;
    PartsOfObjects& parts;
    LampObjects& lamp_objects;
    SceneFile& file;
};

/// A colour of luminance 1.
Rgb read_colour(const TomlTable& table) {
    table.expect_not_both("cct", "color");
    if (const auto cct = table.find("cct"))
        return lights::colour_of_temperature(cct->number(kColourTemperature));
    const auto color = table.find("color");
    if (!color) return Rgb::grey(1);
    const Rgb rgb = color->rgb(kColour);
    constexpr double darkest = 1e-9;
    if (rgb.luminance() < darkest)
        color->fail("black has no colour. Allowed: [r, g, b] with a channel above 0.");
    return rgb * (1 / rgb.luminance());
}

PointLight read_point(TomlTable& table) {
    const double quantity = table.one_of({"flux", "intensity"}).item.number(kLightQuantity);
    const double intensity_cd = table.has("flux") ? quantity / (4 * kPi) : quantity;
    return {table.at("position").vector(), intensity_cd * read_colour(table)};
}

double read_luminance(const TomlTable& table, const Shape& shape) {
    const TomlItem item = table.one_of({"flux", "luminance"}).item;
    const double quantity = item.number(kLightQuantity);
    if (table.has("luminance")) return quantity;
    const double luminance_cd_m2 = quantity / (kPi * area_m2(shape));
    if (!std::isfinite(luminance_cd_m2)) item.fail("the object has no area that could emit a flux.");
    return luminance_cd_m2;
}

/// The object of the scene that the key names; it must not shine already.
ObjectId find_unlit(const TomlItem& item, const Context& context) {
    auto object = context.lamp_objects.find(item.text());
    if (!object) {
        std::vector<std::string_view> names;
        for (const Object& known : context.file.scene.objects) names.push_back(known.name);
        object = static_cast<ObjectId>(item.index_in(names, "object"));  // throws
    }
    if (const std::string* other = context.lamp_objects.light_of(*object)) {
        item.fail(
            fmt::format("{} is already the emitter of the light {}. Allowed: one area light per object.",
                        in_quotes(item.text()), in_quotes(*other)));
    }
    return *object;
}

/// The object that a light shines from: the one that it names, or some faces of it.
ObjectId read_emitter(const TomlTable& table, const Context& context) {
    Scene& scene = context.file.scene;
    const TomlItem item = table.at("object");
    const ObjectId object = find_unlit(item, context);
    table.expect_not_both("material", "mesh_group");
    for (const std::string_view key : {"material", "mesh_group"}) {
        if (const auto part = table.find(key))
            return cut_out_lamp(scene, object, {std::string(key), *part}, context.parts);
    }
    if (const std::string* lamp = context.lamp_objects.cut_from(object)) {
        item.fail(fmt::format(
            "some of its faces are another light, {}. Allowed: \"material\" or \"mesh_group\", which "
            "pick faces for each light of the object.",
            in_quotes(*lamp)));
    }
    return object;
}

AreaLight read_area(TomlTable& table, const Context& context) {
    const ObjectId object = read_emitter(table, context);
    Object& lamp = context.file.scene.objects[index_of(object)];
    if (const std::size_t repeated = scene::remove_repeated_faces(lamp); repeated > 0) {
        context.file.warnings.push_back(
            fmt::format("{}: {} of the faces of object {} lie on others of it. In a lamp each place shines "
                        "once, so they are left out. Remove the copies.",
                        table.at("object").where(), repeated, in_quotes(lamp.name)));
    }
    return {object, read_luminance(table, lamp.shape) * read_colour(table)};
}

/// The surfaces of luminous spheres and openings reflect nothing; all of them share one material.
MaterialId black_of_lights(Scene& scene) {
    constexpr std::string_view name = "(lamps)";
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const NamedMaterial& material) { return material.name == name; });
    const auto index = static_cast<std::uint32_t>(found - scene.materials.begin());
    if (found == scene.materials.end()) scene.materials.push_back({std::string(name), Black{}});
    return MaterialId{index};
}

/// Adds an object that comes with a light.
ObjectId add_object(const TomlTable& table, Object object, const Context& context) {
    if (context.lamp_objects.find(object.name)) {
        table.fail(fmt::format(
            "the light adds an object {}, but the scene already has an object of this name. Allowed: "
            "another name of the light or of the object.",
            in_quotes(object.name)));
    }
    std::vector<Object>& objects = context.file.scene.objects;
    objects.push_back(std::move(object));
    return ObjectId{static_cast<std::uint32_t>(objects.size() - 1)};
}

/// The object of a light that comes with a surface of its own.
ObjectId add_emitter(const TomlTable& table, const std::string& name, Shape shape, const Context& context) {
    return add_object(table, {name, std::move(shape), {black_of_lights(context.file.scene)}}, context);
}

AreaLight read_sphere(TomlTable& table, const Context& context) {
    const Sphere sphere{table.at("center").vector(), table.at("radius").number(kRadius)};
    const Rgb luminance_cd_m2 = read_luminance(table, sphere) * read_colour(table);
    return {add_emitter(table, context.name, sphere, context), luminance_cd_m2};
}

/// Lights with the same file share one photometric solid.
SolidId read_solid(const TomlItem& item, const Context& context) {
    std::vector<NamedSolid>& solids = context.file.scene.solids;
    const std::filesystem::path path = item.existing_file(context.directory).lexically_normal();
    const auto found = std::find_if(solids.begin(), solids.end(),
                                    [&](const NamedSolid& solid) { return solid.file == path.string(); });
    const auto index = static_cast<std::uint32_t>(found - solids.begin());
    if (found == solids.end()) {
        context.file.sources.push_back(path);
        const PhotometryFile file = read_photometry_file(path);
        const PhotometricSolid solid(file.grid);
        solids.push_back({path.string(), file.luminaire, solid, file.format,
                          check_flux(file, solid.flux_lm()).description(),
                          lights::Opening::of_signed(file.opening_m), file.power_w});
        for (const std::string& warning : photometry_warnings(file, solid))
            context.file.warnings.push_back(fmt::format("{}: {}", item.where(), warning));
    }
    return SolidId{index};
}

/// "point", the diameter of a round opening, [length, width] or [length, width, height].
lights::Opening read_opening(const TomlItem& item) {
    using Form = lights::Opening::Form;
    if (item.is_text()) {
        if (item.text() != "point") {
            item.fail(
                fmt::format("{} is no opening. Allowed: \"point\", a diameter, [length, width] or [length, "
                            "width, height] "
                            "in metres.",
                            in_quotes(item.text())));
        }
        return {};
    }
    if (item.is_array()) {
        const std::size_t count = item.elements().size() == 3 ? 3 : 2;
        const std::vector<double> size = item.numbers(count, kRadius);
        return {Form::box, {size[1], size[0], count == 3 ? size[2] : 0}};
    }
    const double diameter_m = item.number(kRadius);
    return {Form::vertical_cylinder, {diameter_m, diameter_m, 0}};
}

/// Adds the body of a luminaire: its x points to C0, its y to C90, its z against the nadir. Returns how far
/// it reaches beyond the plane of the opening.
lights::BodyExtent add_body(const TomlTable& table, const TomlItem& geometry, const Luminaire& luminaire,
                            const Context& context) {
    Object body = read_body(geometry, context.directory, context.file);
    body.name = context.name + std::string(kBodySuffix);
    const geometry::Transform placed{luminaire.c0, luminaire.c90, -luminaire.nadir, luminaire.position};
    // Between the body and the opening. It grows with the body, so that a scene of another size has the same
    // light, up to bodies of 10 cm.
    constexpr double most_m = 1e-4, share = 1e-3;
    const Bounds bounds = geometry::bounds_of(body.shape);
    const double gap_m = std::min(most_m, share * length(bounds.max - bounds.min));
    lights::BodyExtent extent;
    for (const Vec3& vertex : std::get<Mesh>(body.shape).vertices) {
        extent.below_m = std::max(extent.below_m, gap_m - vertex.z);
        extent.above_m = std::max(extent.above_m, gap_m + vertex.z);
    }
    body.shape = transformed(std::move(body.shape), placed);
    add_object(table, std::move(body), context);
    return extent;
}

lights::LightSource read_photometry(TomlTable& table, const Context& context) {
    const Vec3 position = table.at("position").vector();
    const auto aim = table.find("aim"), spin = table.find("spin"), dimming = table.find("dimming"),
               flux = table.find("flux");
    const auto [c0, c90, nadir] =
        lights::aim_luminaire(aim ? aim->direction() : Vec3{0, 0, -1}, spin ? spin->number(kAngle) : 0);
    Rgb factor = read_colour(table);
    if (dimming) factor *= dimming->number(kDimming);
    const SolidId solid = read_solid(table.at("file"), context);
    Scene& scene = context.file.scene;
    if (flux) factor *= flux->number(kLightQuantity) / scene.solid(solid).flux_lm();
    Luminaire luminaire{position, solid, c0, c90, nadir, factor};
    const auto opening = table.find("opening");
    const lights::Opening of_light = opening ? read_opening(*opening) : scene.solids[index_of(solid)].opening;
    lights::BodyExtent body;
    if (const auto geometry = table.find("geometry")) {
        if (!of_light.is_flat()) {
            geometry->fail(
                "a body needs a flat opening, which is moved out of it so that it hides none of its light. "
                "Allowed: opening = [length, width] or a diameter.");
        }
        body = add_body(table, *geometry, luminaire, context);
    }
    if (of_light.is_point()) return luminaire;
    auto [shape, hidden_share] = lights::shape_of(of_light, luminaire, scene.solid(solid), body);
    luminaire.scale(Rgb::grey(1 / (1 - hidden_share)));
    return LuminousOpening{
        add_emitter(table, context.name + std::string(kOpeningSuffix), std::move(shape), context), luminaire};
}

/// The map from an OpenEXR or Radiance picture, in cd/m2 as the picture reader gives them.
std::shared_ptr<const Panorama> read_panorama(const TomlItem& item, double dimming, const Context& context) {
    const std::filesystem::path path = item.existing_file(context.directory).lexically_normal();
    context.file.sources.push_back(path);
    const Picture picture = read_picture(path);
    if (picture.camera &&
        (picture.camera->projection != Projection::panorama || picture.camera->fov_deg < kWholeTurnDeg)) {
        item.fail(
            "the picture does not cover all directions. Needed: projection = \"panorama\", "
            "fov = 360.");
    }
    Panorama::Image image{picture.width, picture.height, picture.rgb_cd_m2};
    for (auto& rgb : image.rgb_cd_m2) {
        for (float& value : rgb) value *= static_cast<float>(dimming);
    }
    try {
        return std::make_shared<const Panorama>(std::move(image));
    } catch (const InputError& error) {
        item.fail(error.what());
    }
}

EnvironmentLight read_environment(TomlTable& table, const Context& context) {
    for (const Light& other : context.file.scene.lights) {
        if (location_of(other) != LightLocation::infinity) continue;
        table.fail(fmt::format("surrounds the scene, as light {} does. Allowed: one environment.",
                               in_quotes(other.name)));
    }
    const TomlTable::NamedItem source = table.one_of({"luminance", "file"});
    for (const std::string_view key : {"cct", "color"}) table.expect_not_both("file", key);
    table.expect_not_both("luminance", "dimming");
    const auto up = table.find("up"), rotation = table.find("rotation"), dimming = table.find("dimming");
    EnvironmentLight light;
    light.axes =
        lights::panorama_axes(up ? up->direction() : Vec3{0, 0, 1}, rotation ? rotation->number(kAngle) : 0);
    if (source.key == "luminance") {
        light.luminance_cd_m2 = source.item.number(kLightQuantity) * read_colour(table);
    } else {
        light.panorama = read_panorama(source.item, dimming ? dimming->number(kDimming) : 1, context);
    }
    return light;
}

/// The reader of a type of light.
struct Reader {
    std::string_view type;
    std::string_view place;  ///< the key of its position, which `positions` and `array` replace; empty for
                             ///< types without one
    std::string_view keys;   ///< the others, without those of all types
    lights::LightSource (*read)(TomlTable& table, const Context& context);
};
constexpr std::array kReaders{
    Reader{"point", "position", "flux intensity cct color",
           [](TomlTable& t, const Context&) -> lights::LightSource { return read_point(t); }},
    Reader{"area", "", "object material mesh_group flux luminance cct color",
           [](TomlTable& t, const Context& c) -> lights::LightSource { return read_area(t, c); }},
    Reader{"sphere", "center", "radius flux luminance cct color",
           [](TomlTable& t, const Context& c) -> lights::LightSource { return read_sphere(t, c); }},
    Reader{"photometry", "position", "file opening geometry aim spin dimming flux cct color",
           [](TomlTable& t, const Context& c) -> lights::LightSource { return read_photometry(t, c); }},
    Reader{"environment", "", "luminance file up rotation dimming cct color",
           [](TomlTable& t, const Context& c) -> lights::LightSource { return read_environment(t, c); }},
};

template <typename... Kinds>
constexpr bool all_have_readers(const std::variant<Kinds...>*) {
    const auto has_reader = [](std::string_view type) {
        return std::ranges::any_of(kReaders, [&](const Reader& reader) { return reader.type == type; });
    };
    return (has_reader(Kinds::kType) && ...);
}
static_assert(all_have_readers(static_cast<const lights::LightSource*>(nullptr)));

/// Daylight is not a lamp: it has no maintenance factor, takes no power, and takes no defaults.
bool is_lamp(const Reader& reader) { return reader.type != EnvironmentLight::kType; }

std::vector<std::string_view> keys_of(const Reader& reader) {
    std::vector<std::string_view> keys{"type"};
    if (!reader.place.empty()) keys.insert(keys.end(), {reader.place, "positions", "array"});
    std::string_view others = reader.keys;
    while (!others.empty()) keys.push_back(next_word(others));
    keys.insert(keys.end(), {"group", "on"});
    if (is_lamp(reader)) keys.insert(keys.end(), {"maintenance", "power"});
    return keys;
}

const Reader& reader_of(const TomlTable& table) {
    std::array<std::string_view, kReaders.size()> types;
    std::ranges::transform(kReaders, types.begin(), &Reader::type);
    return *std::ranges::find(kReaders, table.choose("type", types), &Reader::type);
}

/// Lights with the same text are dimmed together in solutions.
std::string read_group(const TomlTable& table, std::string otherwise) {
    const auto group = table.find("group");
    if (!group) return otherwise;
    std::string name(group->text());
    if (name.empty()) group->fail("the name is empty. Allowed: a text with at least one character.");
    return name;
}

/// Of a lamp that is off only the geometry counts.
bool is_on(const TomlTable& table) {
    const auto on = table.find("on"), dimming = table.find("dimming");
    return (!on || on->boolean()) && (!dimming || dimming->number(kDimming) > 0);
}

/// Electric, at full output. That of a luminaire file belongs to the flux of the file.
std::optional<double> read_power(const TomlTable& table, const Light& light, const Scene& scene) {
    if (const auto power = table.find("power")) return power->number(kPower);
    const Luminaire* const luminaire = lights::luminaire_of(light);
    if (!luminaire || table.has("flux")) return std::nullopt;
    return scene.solids[index_of(luminaire->solid)].power_w;
}

}  // namespace

std::vector<TypeKeys> light_types() {
    std::vector<TypeKeys> types;
    for (const Reader& reader : kReaders) types.push_back({reader.type, keys_of(reader)});
    return types;
}

std::vector<TypeKeys> lamp_types() {
    std::vector<TypeKeys> types;
    for (const Reader& reader : kReaders) {
        if (is_lamp(reader)) types.push_back({reader.type, keys_of(reader)});
    }
    return types;
}

void read_lights(const TomlTable& section, LightContext context, SceneFile& file) {
    const auto place = [](const TomlTable& table) { return reader_of(table).place; };
    LampObjects lamp_objects(file.scene);
    for (auto& [name, table, copy_of] : repeated_tables(named_tables(section, context.defaults), place)) {
        const Reader& reader = reader_of(table);
        table.expect_keys(keys_of(reader), fmt::format("type {}", in_quotes(reader.type)));
        const double maintenance = is_lamp(reader) ? read_maintenance(table, context.maintenance) : 1;
        Light light{name, reader.read(table, {name, context.directory, context.parts, lamp_objects, file}),
                    read_group(table, copy_of), maintenance};
        if (!is_on(table)) continue;
        light.power_w = read_power(table, light, file.scene);
        if (maintenance < 1) light.source = lights::scaled(light.source, Rgb::grey(maintenance));
        file.scene.lights.push_back(std::move(light));
    }
}

}  // namespace stilb::io
