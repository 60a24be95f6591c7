#include "io/import/radiance/radiance_scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/mesh_part.h"
#include "geometry/mesh_topology.h"
#include "geometry/repeated_faces.h"
#include "io/import/imported_scene.h"
#include "io/import/radiance/distribution.h"
#include "io/import/radiance/optics.h"
#include "io/import/radiance/shapes.h"
#include "io/text/radiance_units.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "lights/sky/sky_discs.h"
#include "materials/black.h"

namespace stilb::io::radiance {
namespace {

/// The surfaces of one material.
struct Body {
    MeshBuilder flat, smooth;
};

/// The surfaces of one lamp: of one definition of its material.
struct LampSurfaces {
    const Optics* optics = nullptr;
    MeshBuilder mesh;
    std::vector<std::pair<std::string, Shape>> shapes;
};

/// Puts the surfaces of a description into a scene.
class Assembly {
  public:
    Assembly(const Description& description, ImportedScene& scene)
        : description_(description), scene_(scene), optics_(description, scene.warnings) {}

    void assemble() {
        for (const Surface& surface : description_.surfaces) add(surface);
        for (auto& [id, body] : bodies_) add_body(id, body);
        for (auto& [definition, lamp] : lamps_) add_lamp(lamp);
        if (auto light = lights::environment_of(sky_)) scene_.add_light("sky", std::move(*light));
    }

  private:
    std::span<const double> numbers_of(const Surface& surface) const {
        return std::span(description_.numbers).subspan(surface.first, surface.count);
    }

    void add(const Surface& surface) {
        if (!surface.modifier) {
            scene_.warnings.add("surface", surface.name,
                                "its modifier is void: it is invisible, and left out.");
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
        return material_of_definition_[optics.definition] = material(content, optics.name, optics.material);
    }
    MaterialId material(const std::string& content, const std::string& name, const Material& material) {
        const auto known = materials_.find(content);
        if (known != materials_.end()) return known->second;
        return materials_[content] = scene_.add_material(name, material);
    }

    void add_to_body(const Surface& surface, const Optics& optics) {
        const MaterialId material = material_of(optics);
        // Both sides of a sheet are alike.
        const bool is_sphere = surface.kind == SurfaceKind::bubble && !optics.is_solid;
        if (auto shape = simple_shape(is_sphere ? SurfaceKind::sphere : surface.kind, numbers_of(surface))) {
            scene_.add_object(surface.name, std::move(*shape), {material});
            return;
        }
        Body& body = bodies_[material];
        is_flat(surface.kind) ? add_flat(surface.kind, numbers_of(surface), body.flat)
                              : add_smooth(surface.kind, numbers_of(surface), body.smooth);
    }
    void add_body(MaterialId id, Body& body) {
        const std::string name = scene_.file.scene.materials[index_of(id)].name;
        const std::string of_smooth = body.flat.vertex_count() > 0 ? name + " (curved)" : name;
        if (auto mesh = finished(name, body.flat)) scene_.add_object(name, std::move(mesh->mesh), {id});
        if (auto mesh = finished(of_smooth, body.smooth))
            scene_.add_object(of_smooth, std::move(mesh->mesh), {id});
    }
    /// Nothing where there are no surfaces, or they have no area.
    std::optional<MeshFile> finished(const std::string& name, MeshBuilder& builder) {
        if (builder.vertex_count() == 0) return std::nullopt;
        if (builder.triangle_count() == 0) {
            scene_.warnings.add("surface", name, "it has no area, and is left out.");
            return std::nullopt;
        }
        MeshFile mesh = std::move(builder).finish(name, "");
        for (const std::string& warning : mesh_warnings(mesh)) scene_.warnings.add("surface", name, warning);
        return mesh;
    }

    // Lamps

    void add_source(const Surface& surface, const Optics& optics) {
        if (optics.kind != Optics::Kind::lamp) {
            scene_.warnings.add("source", surface.name, "its material emits no light; it is left out.");
            return;
        }
        for (const std::size_t pattern : optics.lamp.patterns) {
            scene_.warnings.add(
                "source", surface.name,
                fmt::format("the pattern {} is left out.", description_.modifiers[pattern].name));
        }
        const auto numbers = numbers_of(surface);
        const Modifier& material = description_.modifiers[optics.definition];
        const bool gives_way = material.type == "glow" && !(material.numbers[3] > 0);
        lights::SkyDisc& disc = sky_.emplace_back(lights::SkyDisc{{numbers[0], numbers[1], numbers[2]},
                                                                  numbers[3],
                                                                  photometric(optics.lamp.radiance_w_sr_m2),
                                                                  gives_way});
        if (optics.lamp.skies.empty()) return;
        disc.factor = [skies = optics.lamp.skies](const Vec3& towards) {
            double product = 1;
            for (const SkyPattern& sky : skies) product *= sky.factor(towards);
            return product;
        };
    }

    void add_to_lamp(const Surface& surface, const Optics& optics) {
        LampSurfaces& lamp = lamps_[optics.definition];
        lamp.optics = &optics;
        if (!optics.lamp.skies.empty())
            scene_.warnings.add("lamp", surface.name,
                                "the brightness of a sky by direction is left out; it is for sources.");
        if (surface.kind == SurfaceKind::sphere ||
            (surface.kind == SurfaceKind::ring && !is_one_body(optics))) {
            if (auto shape = simple_shape(surface.kind, numbers_of(surface))) {
                lamp.shapes.emplace_back(surface.name, std::move(*shape));
                return;
            }
        }
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
        if (auto mesh = finished(lamp.optics->name, lamp.mesh)) add_parts(*mesh, lamp);
        const bool is_dark = !(lamp.optics->lamp.radiance_w_sr_m2.max() > 0);
        std::vector<Pattern> patterns;
        for (const std::size_t pattern : lamp.optics->lamp.patterns) {
            if (is_dark) break;
            if (auto read = Pattern::read(description_.modifiers[pattern], description_, scene_.warnings,
                                          scene_.file.sources))
                patterns.push_back(std::move(*read));
        }
        for (auto& [name, shape] : lamp.shapes) {
            const MaterialId black = material("", "(lamps)", Black{});  // lamps reflect nothing
            const ObjectId object = scene_.add_object(name, std::move(shape), {black});
            if (!is_dark) add_light(object, *lamp.optics, patterns);
        }
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
            scene_.warnings.add(
                "lamp", file.group_names[copy],
                fmt::format("it lies where {} does; each place shines once. Remove one of them.",
                            in_quotes(file.group_names[first])));
        }
    }

    void add_light(ObjectId object, const Optics& optics, const std::vector<Pattern>& patterns) {
        Scene& scene = scene_.file.scene;
        const auto& [name, shape, materials, cut_from] = scene.object(object);
        const Rgb luminance = photometric(optics.lamp.radiance_w_sr_m2);
        if (patterns.empty() && !optics.lamp.cone)
            return scene_.add_light(name, AreaLight{object, luminance}, optics.name);
        auto emission = emission_of(shape, patterns, optics.lamp.cone);
        if (!emission) {
            scene_.warnings.add("lamp", name, "its distribution is 0 in all directions; it is dark.");
            return;
        }
        for (double& intensity : emission->grid.intensity_cd) intensity *= luminance.luminance();
        const SolidId solid{static_cast<std::uint32_t>(scene.solids.size())};
        scene.solids.push_back({.file = description_.files[0],
                                .luminaire = name,
                                .solid = PhotometricSolid(emission->grid),
                                .format = "Radiance",
                                .flux_statement = "the integral of its distribution"});
        const auto& [c0, c90, nadir] = emission->frame;
        const Luminaire luminaire{
            bounds_of(shape).middle(), solid, c0, c90, nadir, luminance * (1 / luminance.luminance())};
        scene_.add_light(name, LuminousOpening{object, luminaire}, optics.name);
    }

    const Description& description_;
    ImportedScene& scene_;
    OpticsReader optics_;
    std::map<std::string, MaterialId> materials_;
    std::map<std::size_t, MaterialId> material_of_definition_;
    std::map<MaterialId, Body> bodies_;
    std::map<std::size_t, LampSurfaces> lamps_;
    std::vector<lights::SkyDisc> sky_;
};

}  // namespace
}  // namespace stilb::io::radiance

namespace stilb::io {

SceneFile read_radiance_scene(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, std::span<const std::string> overrides,
                              const radiance::Limits& limits) {
    const ImportSettings settings(overrides, name);
    if (settings.options().textures)
        throw InputError("patterns of Radiance scenes are not read: import.textures does not go with them.",
                         {name});
    const radiance::Description description =
        radiance::read_description(text, name, folder, settings.options(), limits);
    if (description.surfaces.empty())
        throw InputError("there is no surface. Needed: polygons, spheres or other surfaces.", {name});
    ImportedScene scene(name);
    scene.file.sources.assign(description.files.begin(), description.files.end());
    scene.file.notes.push_back(
        fmt::format("Radiance: lengths in m; luminances are {:g} lm/W times {:g} R + {:g} G + {:g} B "
                    "(docs/radiance.md)",
                    kRadianceEfficacy_lm_w, kRadianceWeights[0], kRadianceWeights[1], kRadianceWeights[2]));
    radiance::Assembly(description, scene).assemble();
    return std::move(scene).finish(settings);
}

SceneFile read_radiance_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
    return read_radiance_scene(read_text_file(path), path.string(), path.parent_path(), overrides);
}

}  // namespace stilb::io
