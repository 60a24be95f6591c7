#include "report/luminaires.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <variant>

#include "io/text/text.h"

namespace stilb::report {
namespace {

/// The lights of a luminaire file.
std::vector<const Light*> lights_of(const Scene& scene, std::size_t solid) {
    std::vector<const Light*> lights;
    for (const Light& light : scene.lights) {
        const Luminaire* luminaire = luminaire_of(light);
        if (luminaire && index_of(luminaire->solid) == solid) lights.push_back(&light);
    }
    return lights;
}

/// "3300", or "2800 to 3300" where they differ.
std::string range_text(std::vector<double> values, int digits) {
    const auto [least, most] = std::ranges::minmax_element(values);
    const std::string low = fmt::format("{:.{}g}", *least, digits),
                      high = fmt::format("{:.{}g}", *most, digits);
    return low == high ? low : fmt::format("{} to {}", low, high);
}

std::string extent_text(const lights::Opening& opening) {
    using Form = lights::Opening::Form;
    const Vec3& size = opening.extent_m;
    if (opening.is_point()) return "not stated";
    const std::string sizes = size.z > 0 ? fmt::format("{:g} m × {:g} m × {:g} m", size.x, size.y, size.z)
                                         : fmt::format("{:g} m × {:g} m", size.x, size.y);
    switch (opening.form) {
        case Form::box:
            return (size.z > 0 ? "box, " : "rectangle, ") + sizes;
        case Form::vertical_cylinder:
            return (size.z > 0 ? "upright cylinder, " : "ellipse, ") + sizes;
        case Form::cylinder_along_c0:
            return "cylinder along C0–C180, " + sizes;
        case Form::cylinder_along_c90:
            return "cylinder along C90–C270, " + sizes;
        case Form::ball:
            break;
    }
    return "ellipsoid, " + sizes;
}

/// The openings that the lights have in the scene, by their areas; "point" where they have none.
std::string openings_text(const Scene& scene, std::span<const Light* const> lights) {
    std::set<std::string> texts;
    for (const Light* light : lights) {
        const auto object = emitting_object(*light);
        texts.insert(object ? fmt::format("{:.4g} m²", area_m2(scene.object(*object).shape)) : "point");
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// The names, those beyond a few by their number.
std::string names_text(std::span<const Light* const> lights) {
    constexpr std::size_t kMost = 12;
    std::vector<std::string_view> names;
    for (const Light* light : lights.first(std::min(lights.size(), kMost))) names.push_back(light->name);
    std::string text = fmt::format("{}", fmt::join(names, ", "));
    if (lights.size() > kMost) text += fmt::format(" and {} more", lights.size() - kMost);
    return text;
}

Html sheet(const Scene& scene, std::size_t index) {
    const NamedSolid& solid = scene.solids[index];
    const std::vector<const Light*> lights = lights_of(scene, index);
    Facts facts;
    const auto add = [&](std::string_view name, std::string_view value) {
        if (!value.empty()) facts.add(name, text(value));
    };
    add("File", std::filesystem::path(solid.file).filename().string());
    add("Format", solid.format);
    add("Flux of the file", fmt::format("{:.5g} lm", solid.solid.flux_lm()));
    add("Check of the flux", solid.flux_statement);
    add("Largest intensity", fmt::format("{:.4g} cd", solid.solid.peak_cd()));
    add("Opening of the file", extent_text(solid.opening));
    if (solid.power_w) add("Power of the file", fmt::format("{:.4g} W", *solid.power_w));
    add("Count", fmt::format("{}", lights.size()));
    if (!lights.empty()) {
        std::vector<double> fluxes_lm, maintenance;
        double total_lm = 0;
        for (const Light* light : lights) {
            fluxes_lm.push_back(flux_lm(scene, *light).luminance());
            maintenance.push_back(light->maintenance);
            total_lm += fluxes_lm.back();
        }
        add("Flux of each", range_text(fluxes_lm, 5) + " lm");
        add("Flux of all", fmt::format("{:.5g} lm", total_lm));
        const std::string factors = range_text(maintenance, 3);
        add("Maintenance factor", factors == "1" ? "none" : factors + " (within these fluxes)");
        add("Area of the opening", openings_text(scene, lights));
        add("Names", names_text(lights));
    }
    const std::string file = std::filesystem::path(solid.file).filename().string();
    return element("div", {{"class", "sheet"}},
                   element("h3", solid.luminaire.empty() ? file : solid.luminaire) +
                       element("div", {{"class", "columns"}}, polar_curve(solid.solid) + facts.html())) +
           raw("\n");
}

/// "luminance 3183.1 cd/m²", "object panel".
std::string detail_text(const lights::LightDetail& detail) {
    auto [text, unit] = io::words_of_key(std::string(detail.key));
    if (const auto* words = std::get_if<std::string>(&detail.value)) return text + " " + *words;
    text += fmt::format(" {:.5g} ", std::get<double>(detail.value));
    return unit.ends_with("m2") ? text.append(unit.substr(0, unit.size() - 1)) + "²" : text.append(unit);
}

std::string details_text(const Scene& scene, const Light& light) {
    std::string text;
    for (const lights::LightDetail& detail : details_of(light, scene::LightSurroundings(scene))) {
        if (detail.key == "file" || detail.key == "peak_intensity_cd") continue;  // on the sheet
        text += (text.empty() ? "" : ", ") + detail_text(detail);
    }
    return text;
}

std::string light_place_text(const Scene& scene, const Light& light) {
    const auto place = place_of(scene, light);
    return place ? fmt::format("({:.4g}, {:.4g}, {:.4g})", place->x, place->y, place->z) : "all around";
}

std::string aim_text(const Light& light) {
    const Luminaire* luminaire = luminaire_of(light);
    if (!luminaire) return "";
    const Vec3& aim = luminaire->nadir;
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", aim.x, aim.y, aim.z);
}

Html table_of_lights(const Scene& scene) {
    using enum Table::Column;
    Table table({{"Light"},
                 {"Type"},
                 {"Place [m]"},
                 {"Aim"},
                 {"Flux [lm]", numbers},
                 {"Maintenance", numbers},
                 {"Details"}});
    double total_lm = 0;
    for (const Light& light : scene.lights) {
        const bool is_lamp = location_of(light) != LightLocation::infinity;
        const double flux = is_lamp ? flux_lm(scene, light).luminance() : 0;
        total_lm += flux;
        table.add({name_text(light.name), text(type_of(light)), text(light_place_text(scene, light)),
                   text(aim_text(light)), text(is_lamp ? fmt::format("{:.5g}", flux) : "–"),
                   text(is_lamp ? fmt::format("{:g}", light.maintenance) : "–"),
                   text(details_text(scene, light))});
    }
    return element("h3", "All lights") + table.html() +
           element("p", fmt::format("Luminous flux of all lamps: {:.5g} lm, with their maintenance factors.",
                                    total_lm));
}

}  // namespace

Html luminaires_section(const Scene& scene) {
    if (scene.lights.empty()) return {};
    Html html;
    for (std::size_t i = 0; i < scene.solids.size(); ++i) html += sheet(scene, i);
    return html + table_of_lights(scene);
}

}  // namespace stilb::report
