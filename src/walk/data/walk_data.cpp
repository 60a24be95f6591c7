#include "walk/data/walk_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "base/half.h"
#include "base/version.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "estimators/patch_light/solution/light_vertices.h"
#include "estimators/patch_light/solution/reflection_table.h"
#include "io/image/colour_map.h"
#include "io/text/compression.h"
#include "io/text/text.h"
#include "materials/model_list.h"
#include "run/solution_errors.h"
#include "scene/light_groups.h"
#include "walk/data/container.h"
#include "walk/data/highlight_points.h"
#include "walk/data/scene_header.h"
#include "walk/display/coarse_triangles.h"
#include "walk/display/display_mesh.h"

namespace stilb::walk {
namespace {

using estimators::LightVertices;
using estimators::PatchSolution;
using WalkJson = nlohmann::ordered_json;

/// The largest number in half precision.
constexpr float kMostHalf = 65504;
/// Pictures that move have about so many triangles. Only scenes with large meshes have more (DisplayOptions).
constexpr std::size_t kMostCoarseTriangles = 100'000;

Half half_of(double value) { return to_half(static_cast<float>(value)); }

/// In half precision, or in single precision where the values are too large for that (the sun's).
ContainerArray illuminance_array(const std::string& name, const std::vector<float>& values) {
    if (std::ranges::any_of(values, [](float value) { return value > kMostHalf; }))
        return make_array(name, 1, std::span<const float>(values));
    std::vector<std::uint16_t> halves(values.size());
    std::ranges::transform(values, halves.begin(), to_half);
    return make_half_array(name, 1, halves);
}

/// Gathers numbers of elements of several components.
template <typename Number>
class Rows {
  public:
    explicit Rows(std::size_t count, std::size_t components) { numbers_.reserve(count * components); }
    void add(std::initializer_list<Number> row) { numbers_.insert(numbers_.end(), row); }
    operator std::span<const Number>() const { return numbers_; }

  private:
    std::vector<Number> numbers_;
};

void add_position(Rows<float>& rows, const Vec3& v) {
    rows.add({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

void add_unit(Rows<std::int16_t>& rows, const Vec3& v) {
    const auto rounded = [](double x) { return static_cast<std::int16_t>(std::lround(32767 * x)); };
    rows.add({rounded(v.x), rounded(v.y), rounded(v.z)});
}

/// The light vertices of a display vertex, and their weights: those of its patch's corners that carry light.
struct LightShares {
    std::array<std::uint32_t, 3> vertices{LightVertices::kDark, LightVertices::kDark, LightVertices::kDark};
    std::array<double, 3> weights{};
};

LightShares light_shares(const patches::Patches& patches, const LightVertices& light,
                         const DisplayVertex& vertex) {
    const auto& [b0, b1, b2] = vertex.barycentric;
    const std::array<double, 3> barycentric{b0, b1, b2};
    const Triangle& corners = patches.corners[patches.patch_of(vertex.side)];
    LightShares shares;
    double sum = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t number = light.number_of(corners[i], vertex.side);
        if (number == LightVertices::kDark) continue;
        ++lit;
        shares.vertices[i] = number;
        sum += shares.weights[i] = barycentric[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (shares.vertices[i] == LightVertices::kDark) continue;
        // A vertex in a dark corner takes the mean of the others.
        shares.weights[i] = sum > 0 ? shares.weights[i] / sum : 1 / static_cast<double>(lit);
    }
    return shares;
}

std::vector<bool> sides_with_light(const patches::Patches& patches, const LightVertices& light) {
    std::vector<bool> carries(2 * patches.count());
    for (std::uint32_t side = 0; side < carries.size(); ++side) {
        carries[side] = std::ranges::any_of(patches.corners[patches.patch_of(side)], [&](auto corner) {
            return light.number_of(corner, side) != LightVertices::kDark;
        });
    }
    return carries;
}

/// sRGB at even steps of the scale, from the least to the most.
WalkJson false_colours_json() {
    const io::ColourMap map;
    WalkJson list = WalkJson::array();
    for (std::size_t i = 0; i < io::ColourMap::kSamples; ++i)
        list.push_back(io::bytes_of(map.at(static_cast<double>(i) / (io::ColourMap::kSamples - 1))));
    return list;
}

/// Arrays and header of a scene.
class SceneContainer {
  public:
    SceneContainer(const Scene& scene, const PatchSolution& solution, const WalkScene& walk)
        : scene_(scene),
          solution_(solution),
          walk_(walk),
          light_(scene, solution.patches, solution.degree, solution.lit_vertices) {}

    const LightVertices& light() const { return light_; }

    std::string bytes(const DisplayMesh& mesh) {
        const CoarseTriangles coarse = coarse_triangles(mesh, kMostCoarseTriangles);
        add_vertices(mesh);
        if (!coarse.triangles.empty()) add_triangles("coarse_triangles", coarse.triangles);
        add_light_vertices();
        WalkJson header{{"name", walk_.name},
                        {"stilb", program_version()},
                        {"file", walk_.file},
                        {"degree", solution_.degree},
                        {"bounds", bounds_json(mesh)}};
        header["false_colours"] = false_colours_json();
        header["materials"] = materials_json();
        header["objects"] = names_json(scene_.objects, [](const Object& object) { return object.name; });
        header["groups"] = names_json(solution_.groups, [](const std::string& name) { return name; });
        header["lights"] = lights_json();
        header["cameras"] = json_of_cameras(walk_.sensors);
        header["sensors"] = json_of_other_sensors(walk_.sensors);
        header["meshes"] = json_of_meshes(scene_, mesh.parts, coarse);
        return container_bytes(std::move(header), arrays_);
    }

  private:
    void add_vertices(const DisplayMesh& mesh) {
        const std::size_t count = mesh.vertices.size();
        Rows<float> positions(count, 3);
        Rows<std::int16_t> normals(count, 3);
        Rows<std::uint32_t> light_of(count, 3);
        Rows<std::uint16_t> weights(count, 3);
        for (const DisplayVertex& vertex : mesh.vertices) {
            add_position(positions, vertex.position);
            add_unit(normals, vertex.normal);
            const LightShares shares = light_shares(solution_.patches, light_, vertex);
            light_of.add({shares.vertices[0], shares.vertices[1], shares.vertices[2]});
            weights.add({half_of(shares.weights[0]), half_of(shares.weights[1]), half_of(shares.weights[2])});
        }
        arrays_.push_back(make_array("positions", 3, positions));
        arrays_.push_back(make_array("normals", 3, normals));
        add_triangles("triangles", mesh.triangles);
        arrays_.push_back(illuminance_array("direct", mesh.direct_lx));
        arrays_.push_back(illuminance_array("direct_error", mesh.direct_error_lx));
        arrays_.push_back(make_array("light_of", 3, light_of));
        arrays_.push_back(make_half_array("light_weights", 3, weights));
    }

    void add_triangles(const std::string& name, const std::vector<Triangle>& triangles) {
        Rows<std::uint32_t> rows(triangles.size(), 3);
        for (const auto& [a, b, c] : triangles) rows.add({a, b, c});
        arrays_.push_back(make_array(name, 3, rows));
    }

    void add_light_vertices() {
        const auto count = static_cast<std::uint32_t>(light_.count());
        Rows<float> positions(count, 3);
        Rows<std::int16_t> normals(count, 3), axes(count, 3);
        Rows<std::uint16_t> materials(count, 1);
        Rows<std::uint32_t> terms(count + 1, 1);
        for (std::uint32_t number = 0; number < count; ++number) {
            add_position(positions, light_.position(number));
            const Frame frame = light_.frame(number);
            add_unit(normals, frame.w);
            add_unit(axes, frame.u);
            materials.add({static_cast<std::uint16_t>(index_of(light_.material(number)))});
            terms.add({light_.first_term(number)});
        }
        terms.add({light_.first_term(count)});
        arrays_.push_back(make_array("light_positions", 3, positions));
        arrays_.push_back(make_array("light_normals", 3, normals));
        arrays_.push_back(make_array("light_axes", 3, axes));
        arrays_.push_back(make_array("light_materials", 1, std::span<const std::uint16_t>(materials)));
        arrays_.push_back(make_array("light_terms", 1, terms));
    }

    WalkJson materials_json() {
        WalkJson list = WalkJson::array();
        for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
            const Material& material = scene_.materials[i].material;
            WalkJson json = json_of(scene_.materials[i]);
            json["reflection"] = nullptr;
            if (!estimators::reflects_alike(material))
                add_table(material, fmt::format("reflection_{}", i), json);
            add_facets(material, json);
            list.push_back(std::move(json));
        }
        return list;
    }

    void add_table(const Material& material, const std::string& name, WalkJson& json) {
        const estimators::ReflectionTable table =
            estimators::make_reflection_table(material, solution_.degree);
        Rows<float> factors(table.factors.size(), 3);
        for (const auto& [red, green, blue] : table.factors) factors.add({red, green, blue});
        arrays_.push_back(make_array(name, 3, factors));
        json["reflection"] = name;
        json["thetas"] = table.thetas;
        json["phis"] = table.phis;
    }

    /// Materials that differ in their colours alone share a table.
    void add_facets(const Material& material, WalkJson& json) {
        const auto add = [&]<typename M>(const M& model) {
            if constexpr (requires { model.facet_table(); }) {
                const materials::AlbedoTable& table = model.facet_table();
                const std::vector<float> values(table.values().begin(), table.values().end());
                const auto [entry, is_new] =
                    facet_arrays_.try_emplace(values, fmt::format("facets_{}", facet_arrays_.size()));
                if (is_new) arrays_.push_back(make_array(entry->second, 1, std::span<const float>(values)));
                json["facets"] = {{"array", entry->second},
                                  {"cells_per_log", table.cells_per_log()},
                                  {"average", table.average()}};
            }
        };
        materials::visit_model(add, material);
    }

    WalkJson lights_json() {
        const scene::LightGroups groups = scene::light_groups(scene_);
        WalkJson list = WalkJson::array();
        Rows<float> rows(0, 8);
        std::size_t first = 0;
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const std::vector<lights::EmitterPoint> points = highlight_points(scene_, scene_.lights[i]);
            list.push_back(json_of(scene_, scene_.lights[i], groups.of_light[i], first, points.size()));
            first += points.size();
            for (const lights::EmitterPoint& point : points) {
                add_position(rows, point.position);
                add_position(rows, point.normal);
                rows.add({static_cast<float>(point.weight), 0});
            }
        }
        arrays_.push_back(make_array("light_points", 8, rows));
        return list;
    }

    template <typename Things, typename NameOf>
    static WalkJson names_json(const Things& things, const NameOf& name_of) {
        WalkJson list = WalkJson::array();
        for (const auto& thing : things) list.push_back({{"name", name_of(thing)}});
        return list;
    }

    static WalkJson bounds_json(const DisplayMesh& mesh) {
        Bounds bounds;
        for (const DisplayVertex& vertex : mesh.vertices) bounds.include(vertex.position);
        if (bounds.is_empty()) bounds.include({});
        return {{"min", json_of(bounds.min)}, {"max", json_of(bounds.max)}};
    }

    const Scene& scene_;
    const PatchSolution& solution_;
    const WalkScene& walk_;
    LightVertices light_;
    std::vector<ContainerArray> arrays_;
    std::map<std::vector<float>, std::string> facet_arrays_;
};

// The page.

std::string with_replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// Puts `text` in the place of a part that the page must have.
void substitute(std::string& page, std::string_view part, const std::string& text) {
    const std::size_t at = page.find(part);
    if (at == std::string::npos) throw std::runtime_error(fmt::format("the page lacks {}", part));
    page.replace(at, part.size(), text);
}

std::string data_tag(std::string_view id, std::string_view container) {
    return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                       io::base64(io::gzip(container)));
}

}  // namespace

std::string scene_data(const Scene& scene, const rays::RayCaster& caster, const PatchSolution& solution,
                       const WalkScene& walk, const Monitor& monitor) {
    SceneContainer container(scene, solution, walk);
    const DisplayMesh mesh = make_display_mesh(
        scene, caster, solution.patches, sides_with_light(solution.patches, container.light()), {}, monitor);
    return container.bytes(mesh);
}

std::string light_data(const PatchSolution& solution, const LightState& state) {
    const std::vector<float> relative = run::relative_errors(solution);
    Rows<Half> terms(0, 3);
    std::vector<ContainerArray> arrays;
    for (const auto& group : solution.terms) {
        for (const auto& [red, green, blue] : group) terms.add({red, green, blue});
    }
    std::vector<std::uint16_t> errors(relative.size());
    std::ranges::transform(relative, errors.begin(), to_half);
    arrays.push_back(make_half_array("terms", 3, terms));
    arrays.push_back(make_half_array("terms_error", 1, errors));
    WalkJson header{{"version", state.version},
                    {"steps", state.steps},
                    {"error", state.error},
                    {"elapsed_s", state.elapsed_s},
                    {"done", state.done}};
    return container_bytes(std::move(header), arrays);
}

std::string self_contained_page(std::string_view scene, std::string_view light, const PageFiles& files) {
    // Inline text must not contain what would end it; in strings of JavaScript and CSS a backslash before
    // the slash changes nothing.
    const std::string script =
        with_replaced(with_replaced(std::string(files.script), "</script", "<\\/script"), "<!--", "<\\!--");
    const std::string style = with_replaced(std::string(files.style), "</style", "<\\/style");
    std::string page(files.html);
    substitute(page, R"(<link rel="stylesheet" href="./page.css">)", "<style>\n" + style + "\n</style>");
    substitute(page, R"(<script type="module" src="./page.js"></script>)",
               "<script type=\"module\">\n" + script + "\n</script>");
    const std::size_t end = page.rfind("</body>");
    if (end == std::string::npos) throw std::runtime_error("the page lacks </body>");
    page.insert(end, data_tag("stilb-scene", scene) + data_tag("stilb-light", light));
    return page;
}

}  // namespace stilb::walk
