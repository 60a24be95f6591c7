#include "io/import/radiance/radiance_scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "geometry/mesh_part.h"
#include "geometry/mesh_topology.h"
#include "geometry/repeated_faces.h"
#include "io/import/import_settings.h"
#include "io/import/radiance/distribution.h"
#include "io/import/radiance/optics.h"
#include "io/import/radiance/shapes.h"
#include "io/import/radiance/sky.h"
#include "io/text/radiance_units.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "materials/black.h"
#include "scene/overlaps.h"

namespace stilb::io::radiance {
namespace {

/// Names of objects and lights: all different, and fit for file names.
class UniqueNames {
  public:
    std::string make(std::string_view wanted) {
        std::string name;
        for (const char c : wanted)
            name += static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/' || c == '\\' ? '_' : c;
        if (name.empty()) name = "unnamed";
        const std::string first = name;
        for (std::size_t& i = last_[first]; !used_.insert(name).second;)
            name = fmt::format("{}_{}", first, ++i + 1);
        return name;
    }

  private:
    std::set<std::string> used_;
    std::map<std::string, std::size_t> last_;
};

/// The surfaces of one material.
struct Body {
    MeshBuilder flat, smooth;
    bool has_flat = false, has_smooth = false;
};

/// The surfaces of one lamp: of one definition of its material.
struct LampSurfaces {
    const Optics* optics = nullptr;
    MeshBuilder mesh;
    bool has_mesh = false;
    std::vector<std::pair<std::string, Shape>> shapes;
};

class Assembly {
  public:
    explicit Assembly(const Description& description)
        : description_(description), optics_(description, warnings_) {}

    SceneFile assemble() && {
        for (const Surface& surface : description_.surfaces) add(surface);
        for (auto& [id, body] : bodies_) add_body(id, body);
        for (auto& [definition, lamp] : lamps_) add_lamp(lamp);
        add_sky();
        for (const std::string& file : description_.files) file_.sources.emplace_back(file);
        file_.sources.insert(file_.sources.end(), tables_.begin(), tables_.end());
        for (std::string& warning : warnings_.list()) file_.warnings.push_back(std::move(warning));
        if (file_.scene.lights.empty())
            file_.warnings.emplace_back(WarningKind::no_light,
                                        InputError(std::string(kNoLight), {description_.files[0]}).what());
        file_.notes.push_back(fmt::format(
            "Radiance: lengths in m; luminances are {:g} lm/W times {:g} R + {:g} G + {:g} B "
            "(docs/radiance.md)",
            kRadianceEfficacy_lm_w, kRadianceWeights[0], kRadianceWeights[1], kRadianceWeights[2]));
        scene::put_lamps_in_front(file_.scene);
        return std::move(file_);
    }

  private:
    std::span<const double> numbers_of(const Surface& surface) const {
        return std::span(description_.numbers).subspan(surface.first, surface.count);
    }

    void add(const Surface& surface) {
        if (!surface.modifier) {
            warnings_.add("surface", surface.name, "its modifier is void: it is invisible, and left out.");
            return;
        }
        const Optics& optics = optics_.of(*surface.modifier);
        if (optics.kind == Optics::Kind::invisible) return;
        if (surface.kind == SurfaceKind::source) return add_source(surface, optics);
        optics.kind == Optics::Kind::lamp ? add_to_lamp(surface, optics) : add_to_body(surface, optics);
    }

    // Surfaces that reflect

    /// Materials of equal content share one.
    MaterialId material_of(const Optics& optics) {
        const auto known = material_of_definition_.find(optics.definition);
        if (known != material_of_definition_.end()) return known->second;
        const Modifier& modifier = description_.modifiers[optics.definition];
        std::string content = fmt::format("{}\n{}", modifier.name, modifier.type);
        for (const double number : modifier.numbers) content += fmt::format(" {:.17g}", number);
        const auto [entry, is_new] = materials_.try_emplace(
            content, MaterialId{static_cast<std::uint32_t>(file_.scene.materials.size())});
        if (is_new) file_.scene.materials.push_back({material_names_.make(optics.name), optics.material});
        return material_of_definition_[optics.definition] = entry->second;
    }

    void add_to_body(const Surface& surface, const Optics& optics) {
        const MaterialId material = material_of(optics);
        // Of a sheet both sides are alike.
        const bool is_sphere = surface.kind == SurfaceKind::bubble && !optics.is_solid;
        if (auto shape = simple_shape(is_sphere ? SurfaceKind::sphere : surface.kind, numbers_of(surface))) {
            add_object(surface.name, std::move(*shape), material);
            return;
        }
        Body& body = bodies_[material];
        if (is_flat(surface.kind)) {
            add_flat(surface.kind, numbers_of(surface), body.flat);
            body.has_flat = true;
        } else {
            add_smooth(surface.kind, numbers_of(surface), body.smooth);
            body.has_smooth = true;
        }
    }
    ObjectId add_object(std::string_view name, Shape shape, MaterialId material) {
        file_.scene.objects.push_back({object_names_.make(name), std::move(shape), {material}});
        return ObjectId{static_cast<std::uint32_t>(file_.scene.objects.size() - 1)};
    }
    void add_body(MaterialId id, Body& body) {
        const std::string name = file_.scene.materials[index_of(id)].name;
        if (body.has_flat) add_mesh(name, body.flat, id);
        if (body.has_smooth) add_mesh(body.has_flat ? name + " (curved)" : name, body.smooth, id);
    }
    void add_mesh(const std::string& name, MeshBuilder& builder, MaterialId id) {
        if (auto mesh = finished(name, builder)) add_object(name, std::move(mesh->mesh), id);
    }
    /// Nothing where the surfaces have no area.
    std::optional<MeshFile> finished(const std::string& name, MeshBuilder& builder) {
        if (builder.triangle_count() == 0) {
            warnings_.add("surface", name, "it has no area, and is left out.");
            return std::nullopt;
        }
        MeshFile mesh = std::move(builder).finish(name, "");
        for (const std::string& warning : mesh_warnings(mesh)) warnings_.add("surface", name, warning);
        return mesh;
    }

    // Lamps

    void add_source(const Surface& surface, const Optics& optics) {
        if (optics.kind != Optics::Kind::lamp) {
            warnings_.add("source", surface.name, "its material emits no light; it is left out.");
            return;
        }
        for (const std::size_t pattern : optics.lamp.patterns) {
            warnings_.add("source", surface.name,
                          fmt::format("the pattern {} is left out.", description_.modifiers[pattern].name));
        }
        const auto numbers = numbers_of(surface);
        const Modifier& material = description_.modifiers[optics.definition];
        const bool gives_way = material.type == "glow" && !(material.numbers[3] > 0);
        sky_.push_back({{numbers[0], numbers[1], numbers[2]},
                        numbers[3],
                        optics.lamp.radiance_w_sr_m2,
                        gives_way,
                        optics.lamp.skies});
    }

    void add_to_lamp(const Surface& surface, const Optics& optics) {
        LampSurfaces& lamp = lamps_[optics.definition];
        lamp.optics = &optics;
        if (!optics.lamp.skies.empty())
            warnings_.add("lamp", surface.name,
                          "the brightness of a sky by direction is left out; it is for sources.");
        if (surface.kind == SurfaceKind::sphere ||
            (surface.kind == SurfaceKind::ring && !is_one_body(optics))) {
            if (auto shape = simple_shape(surface.kind, numbers_of(surface))) {
                lamp.shapes.emplace_back(surface.name, std::move(*shape));
                return;
            }
        }
        lamp.has_mesh = true;
        lamp.mesh.use_group(surface.name);
        is_flat(surface.kind) ? add_flat(surface.kind, numbers_of(surface), lamp.mesh)
                              : add_smooth(surface.kind, numbers_of(surface), lamp.mesh);
    }
    /// Whether a pattern is made for the box or the cylinder that all surfaces of the lamp are together.
    bool is_one_body(const Optics& optics) {
        return std::ranges::any_of(optics.lamp.patterns, [&](std::size_t pattern) {
            const std::vector<std::string>& texts = description_.modifiers[pattern].texts;
            return !texts.empty() && (texts[0].ends_with("boxcorr") || texts[0] == "cylcorr");
        });
    }

    void add_lamp(LampSurfaces& lamp) {
        if (lamp.has_mesh) {
            if (auto mesh = finished(lamp.optics->name, lamp.mesh)) add_parts(*mesh, lamp);
        }
        if (!(lamp.optics->lamp.radiance_w_sr_m2.max() > 0)) {
            for (auto& [name, shape] : lamp.shapes) add_object(name, std::move(shape), black());
            return;
        }
        std::vector<Pattern> patterns;
        for (const std::size_t pattern : lamp.optics->lamp.patterns) {
            if (auto read = Pattern::read(description_.modifiers[pattern], description_, warnings_, tables_))
                patterns.push_back(std::move(*read));
        }
        for (auto& [name, shape] : lamp.shapes) add_light(name, std::move(shape), *lamp.optics, patterns);
    }
    /// Each connected part is a lamp of its own, unless a pattern is made for all of them.
    void add_parts(MeshFile& file, LampSurfaces& lamp) {
        Mesh& mesh = file.mesh;
        mesh.normals.clear(), mesh.corner_normals.clear();  // light leaves the triangles themselves
        const bool is_whole = is_one_body(*lamp.optics);
        const geometry::ConnectedComponents parts = geometry::find_components(mesh);
        std::vector<std::vector<std::uint32_t>> triangles(is_whole ? 1 : parts.count());
        const std::vector<geometry::RepeatedFace> repeated = geometry::repeated_faces(mesh);
        warn_of_repeated(repeated, file);
        auto next = repeated.begin();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            if (next != repeated.end() && next->triangle == t) {
                ++next;
                continue;
            }
            triangles[is_whole ? 0 : parts.of_triangle[t]].push_back(t);
        }
        for (const std::vector<std::uint32_t>& own : triangles) {
            const std::uint32_t group = file.group_of_triangle[own.front()];
            const bool is_single =
                std::ranges::all_of(own, [&](std::uint32_t t) { return file.group_of_triangle[t] == group; });
            Mesh part = geometry::part_of(mesh, own);
            const std::string name = is_single ? file.group_names[group] : lamp.optics->name;
            const auto rectangle = parallelogram_of(part);
            lamp.shapes.emplace_back(name, rectangle ? Shape(*rectangle) : Shape(std::move(part)));
        }
    }

    /// One warning for each surface that lies on another one.
    void warn_of_repeated(const std::vector<geometry::RepeatedFace>& repeated, const MeshFile& file) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> named;
        for (const auto& [triangle, original] : repeated) {
            const std::uint32_t copy = file.group_of_triangle[triangle],
                                first = file.group_of_triangle[original];
            if (!named.emplace(copy, first).second) continue;
            warnings_.add("lamp", file.group_names[copy],
                          fmt::format("it lies where {} does; each place shines once. Remove one of them.",
                                      in_quotes(file.group_names[first])));
        }
    }

    void add_light(const std::string& wanted, Shape shape, const Optics& optics,
                   const std::vector<Pattern>& patterns) {
        const Lamp& lamp = optics.lamp;
        const Rgb luminance = photometric(lamp.radiance_w_sr_m2);
        const std::string group(optics.name);
        if (patterns.empty() && !lamp.cone) {
            const ObjectId object = add_object(wanted, std::move(shape), black());
            add_source_of_light({name_of(object), AreaLight{object, luminance}, group});
            return;
        }
        auto emission = emission_of(shape, patterns, lamp.cone);
        const ObjectId object = add_object(wanted, std::move(shape), black());
        if (!emission) {
            warnings_.add("lamp", name_of(object), "its distribution is 0 in all directions; it is dark.");
            return;
        }
        for (double& intensity : emission->grid.intensity_cd) intensity *= luminance.luminance();
        const SolidId solid{static_cast<std::uint32_t>(file_.scene.solids.size())};
        file_.scene.solids.push_back({.file = description_.files[0],
                                      .luminaire = name_of(object),
                                      .solid = PhotometricSolid(emission->grid),
                                      .format = "Radiance",
                                      .flux_statement = "the integral of its distribution"});
        const auto& [c0, c90, nadir] = emission->frame;
        const Vec3 middle = bounds_of(file_.scene.object(object).shape).middle();
        const Luminaire luminaire{middle, solid, c0, c90, nadir, luminance * (1 / luminance.luminance())};
        add_source_of_light({name_of(object), LuminousOpening{object, luminaire}, group});
    }
    const std::string& name_of(ObjectId object) const { return file_.scene.object(object).name; }
    void add_source_of_light(Light light) {
        light.name = light_names_.make(light.name);
        file_.scene.lights.push_back(std::move(light));
    }
    /// The surfaces of lamps reflect nothing.
    MaterialId black() {
        if (!black_) {
            black_ = MaterialId{static_cast<std::uint32_t>(file_.scene.materials.size())};
            file_.scene.materials.push_back({material_names_.make("(lamps)"), Black{}});
        }
        return *black_;
    }
    void add_sky() {
        if (auto light = environment_of(sky_)) add_source_of_light({"sky", std::move(*light)});
    }

    const Description& description_;
    GroupedWarnings warnings_;
    OpticsReader optics_;
    SceneFile file_;
    UniqueNames material_names_, object_names_, light_names_;
    std::map<std::string, MaterialId> materials_;
    std::map<std::size_t, MaterialId> material_of_definition_;
    std::map<MaterialId, Body> bodies_;
    std::map<std::size_t, LampSurfaces> lamps_;
    std::vector<DistantSource> sky_;
    std::vector<std::filesystem::path> tables_;
    std::optional<MaterialId> black_;
};

}  // namespace
}  // namespace stilb::io::radiance

namespace stilb::io {

SceneFile read_radiance_scene(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, const radiance::Limits& limits,
                              const radiance::Placement& placement) {
    const radiance::Description description =
        radiance::read_description(text, name, folder, limits, placement);
    if (description.surfaces.empty())
        throw InputError("there is no surface. Needed: polygons, spheres or other surfaces.", {name});
    return radiance::Assembly(description).assemble();
}

SceneFile read_radiance_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
    const ImportSettings settings(overrides, path.string());
    if (settings.options().textures)
        throw InputError("patterns of Radiance scenes are not read: import.textures does not go with them.",
                         {path.string()});
    SceneFile file = read_radiance_scene(read_text_file(path), path.string(), path.parent_path(), {},
                                         radiance::placement_of(settings.options()));
    settings.scale_lights(file);
    settings.apply_to(file);
    return file;
}

}  // namespace stilb::io
