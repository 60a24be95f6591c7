#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "base/version.h"
#include "estimators/estimator_list.h"
#include "io/results/results_text.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "report/floor_plan.h"
#include "report/luminaires.h"
#include "report/materials.h"
#include "report/measured_plane.h"
#include "report/plane_pictures.h"
#include "report/report.h"
#include "report/results.h"
#include "report/style.h"

namespace stilb::report {
namespace {

/// A section with its heading; nothing where it has no content.
Html section(std::string_view title, const Html& content) {
    if (content.is_empty()) return {};
    return element("section", element("h2", title) + raw("\n") + content) + raw("\n");
}

std::string title_of(const Report& report) {
    const std::string& name = report.file.scene.name;
    return name.empty() ? std::filesystem::path(report.scene).filename().string() : name;
}

/// A text that differs between runs with the same seed, such as a duration.
Html varying(std::string_view plain) { return element("time", plain); }

Html header(const Report& report) {
    Facts facts;
    facts.add("Date", varying(report.date));
    facts.add("Scene", text(report.scene));
    facts.add("Program", text(fmt::format("Stilb {}", program_version())));
    if (report.readings) {
        const auto& maintenance = report.readings->maintenance;
        facts.add("Values",
                  text(maintenance ? fmt::format("maintained, {}", io::maintenance_text(*maintenance))
                                   : "initial, without a maintenance factor"));
        const std::string power = io::installed_power_text(*report.readings);
        if (!power.empty()) facts.add("Installed power", text(power));
    }
    return element("header", element("p", {{"class", "kicker"}}, text("Lighting calculation")) +
                                 element("h1", title_of(report)) + facts.html()) +
           raw("\n");
}

Html view_figure(const View& view) {
    const std::string error =
        view.run.replicates > 1
            ? fmt::format(", mean standard error of a pixel {:.2g} cd/m²", view.mean_standard_error_cd_m2)
            : "";
    const std::string words = fmt::format(
        ": {} × {} pixels, {} passes; mean luminance {:.4g} cd/m²{}. Exposure {:.3g} per cd/m², white {:.0f} "
        "K.",
        view.width, view.height, view.run.samples, view.mean_luminance_cd_m2, error, view.exposure,
        view.white_k);
    return element("figure", {{"class", "view"}},
                   void_element("img", {{"alt", "View of camera " + view.sensor},
                                        {"src", "data:image/png;base64," + io::base64(view.png)}}) +
                       element("figcaption", element("b", view.sensor) + text(words))) +
           raw("\n");
}

Html views(const Report& report) {
    Html html;
    for (const View& view : report.views) html += view_figure(view);
    return html;
}

Html warnings(const Report& report) {
    if (report.warnings.empty()) return element("p", "None.");
    Html items;
    for (const Warning& warning : report.warnings) items += element("li", warning.text) + raw("\n");
    return element("ul", {{"class", "warnings"}}, items);
}

void add_run(const RunSummary& run, std::string_view name, std::string_view samples, Facts& facts) {
    facts.add(name, text(fmt::format("method {}, seed {}, {} {}, {} replicates, ", io::method_text(run),
                                     run.seed, run.samples, samples, run.replicates)) +
                        varying(fmt::format("{:.1f} s", run.elapsed_s)) +
                        text(fmt::format("; {}", io::ending(run.stop_reason, samples))));
    if (run.patches) facts.add("Patches", varying(io::patch_text(*run.patches)));
    if (!run.levels_of_detail.empty())
        facts.add("Series of bodies", text(io::detail_text(run.levels_of_detail)));
}

Html files_table(const io::SceneFile& file) {
    Table table({{"File"}, {"Content hash"}});
    for (const std::filesystem::path& source : file.sources) {
        const std::string hash = io::is_standard_output(source) ? "–" : io::content_hash({&source, 1});
        table.add({text(source.string()), element("code", hash)});
    }
    return table.is_empty() ? Html{} : table.html();
}

Html origin(const Report& report) {
    Facts facts;
    facts.add("Program", text(fmt::format("Stilb {}", program_version())));
    facts.add("Command", element("code", report.command));
    if (report.readings) {
        const RunResult& run = *report.readings;
        const estimators::EstimatorEntry& technique = estimators::find_estimator(run.technique);
        add_run(run, "Readings", technique.samples, facts);
        facts.add("A sample", text(std::string(technique.sample)));
        facts.add("Rays", text(fmt::format("{}", run.rays)));
        facts.add("Reflections",
                  text(report.options.bounces ? fmt::format("{} at most", *report.options.bounces)
                                              : "without a limit"));
    }
    for (const View& view : report.views)
        add_run(view.run, fmt::format("View {}", view.sensor), "passes", facts);
    if (!report.file.overrides.empty())
        facts.add("Values set", element("code", fmt::format("{}", fmt::join(report.file.overrides, " "))));
    return facts.html() + files_table(report.file);
}

Html body(const Report& report) {
    const Scene& scene = report.file.scene;
    Html html = header(report);
    std::vector<SensorResult> none;
    const std::vector<SensorResult>& results = report.readings ? report.readings->sensors : none;
    const std::vector<MeasuredPlane> planes = measured_planes(results);
    if (report.readings)
        html +=
            section("Summary", requirements(*report.readings) + certainty(*report.readings, report.options));
    html += section("Views", views(report));
    const rays::RayCaster caster(scene);
    html += section("Floor plan", floor_plans(scene, caster, results, planes));
    html += section("Illuminance of areas", plane_pictures(planes));
    if (report.readings) {
        html += section("Measured values", measured_values(*report.readings));
        html += section("Glare", glare(*report.readings));
        html += section(report.options.by == "bounce" ? "By number of reflections" : "By light",
                        shares(*report.readings));
        for (const RunResult& lit : report.readings->light_scenes)
            html += section(fmt::format("Light scene {}", lit.scene_name), light_scene(lit));
    }
    html += section("Luminaires", luminaires_section(scene));
    html += section("Materials", materials_table(scene));
    html += section("Warnings", warnings(report));
    html += section("Origin of the numbers", origin(report));
    if (report.readings && report.lists_readings)
        html += section("All readings", all_readings(*report.readings));
    return html;
}

}  // namespace

std::string to_html(const Report& report) {
    const Html head =
        void_element("meta", {{"charset", "utf-8"}}) + raw(std::string(io::kReportMark)) +
        void_element("meta", {{"name", "viewport"}, {"content", "width=device-width"}}) +
        void_element("meta", {{"http-equiv", "Content-Security-Policy"},
                              {"content", "default-src 'none'; style-src 'unsafe-inline'; img-src data:"}}) +
        element("title", title_of(report)) + element("style", raw(std::string(kStyle)));
    return "<!DOCTYPE html>\n" +
           element("html", {{"lang", "en"}},
                   element("head", head) + raw("\n") + element("body", element("main", body(report))))
               .markup() +
           "\n";
}

}  // namespace stilb::report
