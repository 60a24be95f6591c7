#include "cli/commands/results_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/luminance_results.h"

namespace stilb::cli {
namespace {

std::string table_of(const RunResult& made) { return to_table(made); }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ResultsTable, ShowsLinesOfSightAndDirections) {
    EXPECT_EQ(table_of(io::luminance_results()),
              "Luminance, with 95 % intervals\n"
              "\n"
              "view          2 lines of sight; 95 % of the readings within 2 %\n"
              "    mean 150.0 ± 2.0 cd/m²   minimum 100.0 ± 2.0 cd/m²   maximum 200.0 ± 2.0 cd/m²\n"
              "    100.0 ± 2.0 cd/m²   from (2, 0, 1) along (0, 1, 0), meets (2, 4, 1)\n"
              "    200.0 ± 2.0 cd/m²   from (2, 0, 1) along (0, 0, 1), leaves the scene\n"
              "solid         3 directions from (2, 2, 0) facing (0, 0, 1); 95 % of the readings within 7 %\n"
              "    mean 150.0 ± 2.0 cd/m²   minimum 100.0 ± 2.0 cd/m²   maximum 200.0 ± 2.0 cd/m²\n"
              "    theta   -60°  phi    90°   29.0 ± 2.0 cd/m²\n"
              "    theta     0°  phi    90°   30.0 ± 2.0 cd/m²\n"
              "    theta    60°  phi    90°   31.0 ± 2.0 cd/m²\n"
              "\n"
              "auto (light-paths), 0 light paths in 0.00 s: all light paths done; error 0 %\n");
}

TEST(ResultsTable, OneLineOfSightIsOneLine) {
    RunResult made = io::luminance_results();
    made.sensors.resize(1);
    std::get<Luminance>(made.sensors[0].sensor.kind).sights.resize(1);
    made.sensors[0].sub_points.clear();
    EXPECT_TRUE(has(table_of(made), "\nview          100.0 ± 2.0 cd/m²   from (2, 0, 1) along (0, 1, 0)\n"))
        << table_of(made);
}

TEST(ResultsTable, SaysWhatPatchesStandFor) {
    RunResult made = io::luminance_results();
    made.patches = io::patch_report();
    EXPECT_TRUE(table_of(made).ends_with(
        "\nauto (light-paths), 0 light paths in 0.00 s: all light paths done; error 0 %\n"
        "1000 patches of 0.25 m; first shot (incoming, resolution 256) for 1 of 2 lights, 0.12 s, "
        "72 bytes per patch\n"
        "lights not replaced: panel (large)\n"))
        << table_of(made);
}

TEST(ResultsTable, NamesFewOfManyLights) {
    RunResult made = io::luminance_results();
    made.patches = io::patch_report();
    for (int i = 2; i < 6; ++i) {
        made.patches->lights.push_back({fmt::format("panel {}", i), false, "large", 0, {}});
    }
    EXPECT_TRUE(table_of(made).ends_with(
        "\nlights not replaced: panel (large), panel 2 (large), panel 3 (large) and 2 more\n"))
        << table_of(made);
}

TEST(ResultsTable, LightsNeedNoWordsWithoutFirstShot) {
    RunResult made = io::luminance_results();
    made.patches = io::patch_report();
    made.patches->first_shot = estimators::FirstShotVariant::none;
    EXPECT_TRUE(table_of(made).ends_with("\n1000 patches of 0.25 m; no first shot\n")) << table_of(made);
}

TEST(ResultsTable, ShowsBodies) {
    RunResult made = io::luminance_results();
    const Sensor face{"face", Semicylindrical{{{1, 2, 3}}, {0, 1, 0}}};
    const Sensor people{"people", Cylindrical{{{1, 2, 3}, {2, 2, 3}}}};
    made.sensors = {{face, {io::reading(500)}, {}, {}, 0.01},
                    {people, {io::reading(100), io::reading(90)}, {}, {}, 0.01}};
    EXPECT_TRUE(has(table_of(made), "\nface          500.0 ± 2.0 lx   at (1, 2, 3) facing (0, 1, 0)\n"))
        << table_of(made);
    EXPECT_TRUE(has(table_of(made), "\npeople        2 points; 95 % of")) << table_of(made);
    EXPECT_TRUE(has(table_of(made), "\n    90.0 ± 2.0 lx   at (2, 2, 3)\n")) << table_of(made);
}

TEST(ResultsTable, NamesTheQuantities) {
    RunResult made = io::luminance_results();
    const Sensor eye{"eye", IlluminancePoints{{{{1, 2, 3}, {0, 0, 1}}}}};
    made.sensors.push_back({eye, {io::reading(500)}, {}, {}, 0.01});
    EXPECT_TRUE(table_of(made).starts_with("Illuminance and luminance, with 95 % intervals\n"));
    EXPECT_TRUE(has(table_of(made), "\neye           500.0 ± 2.0 lx   at (1, 2, 3) facing (0, 0, 1)\n"));
    made.sensors.erase(made.sensors.begin(), made.sensors.begin() + 2);
    EXPECT_TRUE(table_of(made).starts_with("Illuminance, with 95 % intervals\n"));
    const Sensor rating{"rating", Ugr{{{{1, 2, 3}, {0, 1, 0}}}}};
    made.sensors.push_back({rating, {io::reading(19)}, {}, {}, 0.01});
    EXPECT_TRUE(table_of(made).starts_with("Illuminance and glare ratings, with 95 % intervals\n"));
    std::swap(made.sensors.front(), made.sensors.back());
    EXPECT_TRUE(table_of(made).starts_with("Illuminance and glare ratings, with 95 % intervals\n"));
    made.sensors.erase(made.sensors.begin() + 1);
    EXPECT_TRUE(table_of(made).starts_with("Glare ratings, with 95 % intervals\n"));
    made.sensors = {{eye, {io::reading(500)}, {}, {}, 0.01}};
    made.maintenance = {0.8, 0.8};
    EXPECT_TRUE(
        table_of(made).starts_with("Maintained illuminance (maintenance factor 0.8), with 95 % intervals\n"));
    made.maintenance = {0.7, 1};
    EXPECT_TRUE(table_of(made).starts_with(
        "Maintained illuminance (maintenance factors 0.7 to 1), with 95 % intervals\n"));
}

TEST(ResultsTable, NamesTheSamplesOfTheMethod) {
    RunResult made = io::luminance_results();
    made.method = made.technique = "particles";
    made.samples = 7;
    EXPECT_TRUE(has(table_of(made), "\nparticles, 7 particles in 0.00 s: all particles done; error 0 %\n"))
        << table_of(made);
}

TEST(ResultsTable, SaysWhichErrorIsNotReached) {
    run::RunSummary summary;
    summary.attained_error = 0.031;
    summary.requested_error = 0.01;
    EXPECT_EQ(shortfall_text(summary, "x.exr"), "");
    summary.converged = false;
    EXPECT_EQ(
        shortfall_text(summary, "x.exr"),
        "The requested error of 1 % is not reached: the error is 3.1 %. x.exr has the result so far.\n");
    EXPECT_EQ(shortfall_text(summary, ""),
              "The requested error of 1 % is not reached: the error is 3.1 %.\n");
    summary.requested_error.reset();
    EXPECT_EQ(shortfall_text(summary, "x.exr"), "x.exr has the result so far.\n");
    EXPECT_EQ(shortfall_text(summary, ""), "");
}

}  // namespace
}  // namespace stilb::cli
