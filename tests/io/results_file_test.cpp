#include "io/results/results_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/luminance_results.h"
#include "io/results/results_writer.h"
#include "plot/false_colour_picture.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

std::string value(double x, double y, const std::string& number) {
    return "{\"position\":[" + std::to_string(x) + "," + std::to_string(y) +
           ",0.75],\"normal\":[0,0,1],\"value\":" + number +
           ",\"standard_error\":1,\"interval\":[0,1],\"rgb\":[1,1,1]}";
}

/// 3 x 2 cells of 0.5 m x 0.4 m.
std::string grid(const std::string& name, const std::string& unit) {
    std::string values;
    for (int i = 0; i < 6; ++i) {
        values += (i > 0 ? "," : "") +
                  value(0.5 * (i % 3), 0.4 * (i / 3), i == 4 ? "null" : std::to_string(100 + i));
    }
    return "{\"name\":\"" + name + "\",\"type\":\"grid\",\"quantity\":\"illuminance\",\"unit\":\"" + unit +
           "\",\"count\":[3,2],\"values\":[" + values +
           "],\"summary\":{\"mean\":102.5,\"minimum\":100,\"maximum\":105,\"uniformity\":0.976,"
           "\"mean_interval\":[101,104],\"minimum_interval\":[null,null]}}";
}

std::string document(const std::string& sensors) {
    return "{\"stilb\":\"0.1.0\",\n\"scene\":\"office.toml\",\"scene_name\":\"Office\",\n\"sensors\":[" +
           sensors + "]}";
}

TEST(ResultsFile, ReadsGridsAndTheirSize) {
    const ResultsFile results = read_results(
        document("{\"name\":\"eye\",\"type\":\"illuminance\"}," + grid("desk", "lx")), "office.json");
    EXPECT_EQ(results.scene, "office.toml");
    ASSERT_EQ(results.grids.size(), 1u);
    const MeasuredGrid& desk = results.grids[0];
    EXPECT_EQ(desk.name, "desk");
    EXPECT_EQ(desk.unit, "lx");
    EXPECT_EQ(desk.count, (std::array<int, 2>{3, 2}));
    EXPECT_NEAR(desk.width_m, 1.5, 1e-9);
    EXPECT_NEAR(desk.height_m, 0.8, 1e-9);
    ASSERT_EQ(desk.values.size(), 6u);
    EXPECT_EQ(desk.values[5].value, 105);
    EXPECT_EQ(desk.values[5].half_width, 0.5);
    EXPECT_TRUE(std::isnan(desk.values[4].value));
    EXPECT_EQ(desk.summary.uniformity.value, 0.976);
    EXPECT_TRUE(std::isnan(desk.summary.uniformity.half_width));
    EXPECT_EQ(desk.summary.mean.half_width, 1.5);
    EXPECT_TRUE(std::isnan(desk.summary.minimum.half_width));
    EXPECT_EQ(results.scene_name, "Office");
}

TEST(ResultsFile, TakesARowOfCellsForSquares) {
    std::string one_row = grid("row", "lx");
    one_row.replace(one_row.find("[3,2]"), 5, "[6,1]");
    const ResultsFile results = read_results(document(one_row), "office.json");
    // From the first to the last position: (0, 0) to (1, 0.4), six cells.
    EXPECT_NEAR(results.grids[0].width_m, std::hypot(1, 0.4) * 6 / 5, 1e-9);
    EXPECT_NEAR(results.grids[0].height_m, std::hypot(1, 0.4) / 5, 1e-9);
}

std::string message_for(const std::string& content) {
    try {
        read_results(content, "office.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// An L of three cells of 0.5 m x 0.4 m in a raster of 2 x 2 that begins at (0, 0).
constexpr const char* kArea = R"({"stilb":"0.1.0","scene":"office.toml","scene_name":"Office","sensors":[
{"name":"task","type":"area","quantity":"illuminance","unit":"lx",
"raster":{"corner":[0,0,0.75],"edge_u":[1,0,0],"edge_v":[0,0.8,0],"count":[2,2]},
"values":[{"position":[0.25,0.2,0.75],"value":100,"interval":[99,101]},
{"position":[0.75,0.2,0.75],"value":101,"interval":[100,102]},
{"position":[0.25,0.6,0.75],"value":102,"interval":[101,103]}],
"summary":{"mean":101,"minimum":100,"maximum":102,"uniformity":0.99}}]})";

TEST(ResultsFile, ReadsAreasOnTheirRaster) {
    const ResultsFile results = read_results(kArea, "office.json");
    ASSERT_EQ(results.grids.size(), 1u);
    const MeasuredGrid& task = results.grids[0];
    EXPECT_EQ(task.count, (std::array<int, 2>{2, 2}));
    EXPECT_EQ(task.width_m, 1);
    EXPECT_EQ(task.height_m, 0.8);
    ASSERT_EQ(task.values.size(), 4u);
    EXPECT_EQ(task.values[1].value, 101);
    EXPECT_EQ(task.values[2].value, 102);
    EXPECT_TRUE(std::isnan(task.values[3].value));
    const auto expect = [](const std::string& from, const std::string& to, const std::string& part) {
        const std::string message = message_for(with(kArea, from, to));
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect("\"edge_u\":[1,0,0]", "\"edge_u\":[0.5,0,0]", "'sensors[0].values[1].position' is array");
    expect("\"edge_u\":[1,0,0]", "\"edge_u\":[0,0,0]", "'sensors[0].values[0].position'");
    expect("[2,2]", "[100000,100000]", "'sensors[0].raster' is object");
    expect("\"corner\"", "\"korner\"", "'sensors[0].raster.corner' is missing");
}

TEST(ResultsFile, SaysWhatIsWrong) {
    const std::string good = document(grid("desk", "lx"));
    ASSERT_EQ(message_for(good), "no error");
    const auto expect = [](const std::string& content, const std::string& part) {
        EXPECT_NE(message_for(content).find(part), std::string::npos)
            << part << " not in: " << message_for(content);
    };
    expect("", "office.json:1: not JSON");
    expect("[scene]\nname = 1", "not JSON");
    expect("{\"a\":1,\n\n}", "office.json:3: not JSON");
    expect("{}", "there is no 'stilb'");
    expect("[1]", "there is no 'stilb'");
    expect(with(good, "\"scene\":\"office.toml\"", "\"scene\":7"), "'scene' is number");
    expect(with(good, "\"sensors\"", "\"sensor\""), "'sensors' is missing");
    expect(document("7"), "'sensors[0]' is number");
    expect(with(good, "[3,2]", "[3,3]"), "'sensors[0].values' is array");
    expect(with(good, "[3,2]", "[3,0]"), "'sensors[0].count[1]' is number");
    expect(with(good, "[3,2]", "[-3,-2]"), "'sensors[0].count[0]'");
    expect(with(good, "[3,2]", "[3]"), "array of 2 or more");
    expect(with(good, "[3,2]", "[3000000000,2]"), "'sensors[0].count[0]'");
    expect(good.substr(0, good.size() / 2), "office.json:3: not JSON");
    expect(with(good, ":null", ":\"dark\""), "'sensors[0].values[4].value' is string");
    expect(with(good, ":null", ":1e999"), "too large");
    expect(with(good, "\"unit\":\"lx\",", ""), "'sensors[0].unit' is missing");
    expect(with(good, "\"position\":[0", "\"position\":[true,0"), "'sensors[0].values[0].position[0]'");
}

TEST(GridPicture, SumsUpEachGrid) {
    const std::string content = document(grid("desk", "lx") + "," + grid("table", "lx"));
    const plot::FalseColour picture = plot::picture_of(read_results(content, "office.json"), {});
    EXPECT_EQ(picture.title, "Office: illuminance");
    EXPECT_EQ(picture.unit, "lx");
    ASSERT_EQ(picture.panels.size(), 2u);
    EXPECT_EQ(picture.panels[1].name, "table");
    EXPECT_EQ(picture.panels[0].subtitle, "mean 102 lx   minimum 100 lx   uniformity 0.98");
    EXPECT_EQ(picture.panels[0].nu, 3);
    EXPECT_EQ(picture.panels[0].nv, 2);
    EXPECT_TRUE(picture.panels[0].errors.empty());
    // A scene without a name, as in files of older versions, goes by its file.
    const std::string nameless = with(content, ",\"scene_name\":\"Office\"", "");
    EXPECT_EQ(plot::picture_of(read_results(nameless, "x.json"), {}).title, "office.toml: illuminance");
}

TEST(GridPicture, HasErrorsOnDemand) {
    plot::FalseColourOptions options;
    options.errors = true;
    const std::string content = document(grid("desk", "lx"));
    const plot::FalseColour picture = plot::picture_of(read_results(content, "office.json"), options);
    EXPECT_EQ(picture.panels[0].errors, std::vector<double>(6, 0.5));
    EXPECT_EQ(picture.panels[0].subtitle, "mean 102.5 ± 1.5 lx   minimum 100 lx   uniformity 0.98");
    std::string deterministic = content;
    for (int i = 0; i < 6; ++i) deterministic = with(deterministic, "[0,1]", "[null,null]");
    try {
        plot::picture_of(read_results(deterministic, "office.json"), options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("Leave --errors out"), std::string::npos) << error.what();
    }
}

/// Straight from the results of a run: as read back from the file that they make.
TEST(GridPicture, IsTheSameOfResultsAndTheirFile) {
    RunResult result = luminance_results();
    const auto add = [&](const std::string& name, const std::array<int, 2>& count) {
        SensorResult& grid = result.sensors.emplace_back();
        grid.sensor = {name, Grid{{1, 2, 0.75}, {1.7, 0, 0}, {0, 0, 1.1}, count, Vec3{0, 1, 0}}};
        std::vector<double> values;
        for (std::size_t i = 0; i < grid.sensor.size(); ++i) {
            values.push_back(300 + 20. / 7 * static_cast<double>(i));
            grid.readings.push_back(reading(values.back()));
        }
        std::vector<double> replicates = values;
        replicates.insert(replicates.end(), values.begin(), values.end());
        grid.summary = statistics::summarize_grid({replicates, values.size()});
    };
    add("desk", {5, 3}), add("row", {4, 1}), add("column", {1, 4}), add("cell", {1, 1});
    result.scene_name = "Two-desk office";
    plot::FalseColourOptions options;
    options.errors = true;
    const plot::FalseColour straight = plot::picture_of(result, "office.toml", options);
    const plot::FalseColour read =
        plot::picture_of(read_results(to_json(result, "office.toml"), "x.json"), options);
    EXPECT_EQ(straight.title, read.title);
    EXPECT_EQ(straight.unit, read.unit);
    ASSERT_EQ(straight.panels.size(), 4u);
    ASSERT_EQ(read.panels.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const plot::FalseColourPanel &a = straight.panels[i], &b = read.panels[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.subtitle, b.subtitle);
        EXPECT_EQ(a.values, b.values);
        EXPECT_EQ(a.errors, b.errors);
        EXPECT_EQ(std::make_pair(a.nu, a.nv), std::make_pair(b.nu, b.nv));
        EXPECT_NEAR(a.width_m, b.width_m, 1e-12) << a.name;
        EXPECT_NEAR(a.height_m, b.height_m, 1e-12) << a.name;
    }
}

TEST(GridPicture, NeedsGridsOfOneUnit) {
    EXPECT_THROW(plot::picture_of(read_results(document(""), "office.json"), {}), InputError);
    const std::string two_units = document(grid("a", "lx") + "," + grid("b", "cd/m2"));
    EXPECT_THROW(plot::picture_of(read_results(two_units, "office.json"), {}), InputError);
}

}  // namespace
}  // namespace stilb::io
