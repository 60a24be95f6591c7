// States of runs of the library: steps, parts and files.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "stilb/stilb.h"
#include "support/test_folder.h"

namespace {

const stilb::Scene& lit_box() {
    static const stilb::Scene scene = stilb::Scene::parse(R"(
[materials]
wall = { type = "diffuse", reflectance = 0.6 }
[objects]
room = { shape = "box", min = [0, 0, 0], max = [4, 3, 2.5], material = "wall" }
[lights]
bulb = { type = "point", position = [2, 1.5, 2.3], flux = 800 }
[sensors]
desk = { type = "grid", corner = [1, 1, 0.75], edge_u = [1.6, 0, 0], edge_v = [0, 0.8, 0], count = [4, 2] }
)");
    return scene;
}

stilb::Options limited_to(std::uint64_t paths) {
    stilb::Options options;
    options.method = "path";
    options.paths = paths;
    return options;
}

double mean_of(const stilb::Result& result) { return result["desk"].mean.value; }

TEST(RunStateOfLibrary, StepsEndAtErrorEstimatesAndGiveTheRunInOneGo) {
    stilb::Options options = limited_to(1 << 14);
    stilb::RunState state;
    std::vector<std::string> endings;
    stilb::Result result;
    double elapsed_s = 0;
    do {
        const std::uint64_t next = state.has_begun() ? state.samples_at_next_check() : 0;
        result = stilb::measure_to_next_check(lit_box(), options, {}, {}, state);
        if (next > 0) {
            EXPECT_EQ(result.samples, std::min(next, *options.paths));
        }
        EXPECT_GT(result.elapsed_s, elapsed_s);  // of all steps
        elapsed_s = result.elapsed_s;
        endings.push_back(result.stopped);
    } while (result.stopped == "interrupted" && endings.size() < 100);
    EXPECT_GE(endings.size(), 3U);
    EXPECT_EQ(endings.back(), "paths done");
    EXPECT_EQ(mean_of(result), mean_of(stilb::measure(lit_box(), options)));
}

TEST(RunStateOfLibrary, CopiesAreStatesOfTheirOwn) {
    stilb::RunState state;
    stilb::measure(lit_box(), limited_to(1024), {}, {}, &state);
    const stilb::RunState copy = state;
    stilb::measure(lit_box(), limited_to(2048), {}, {}, &state);
    EXPECT_EQ(copy.samples(), 1024U);
    EXPECT_EQ(state.samples(), 2048U);
}

TEST(RunStateOfLibrary, PartsOfOnePlanAreTheWhole) {
    const stilb::Options options = limited_to(2048);
    stilb::RunState plan;
    stilb::plan_parts(lit_box(), options, plan);
    EXPECT_TRUE(plan.has_begun());
    EXPECT_EQ(plan.samples(), 0U);
    const stilb::RunState sent(plan.bytes());
    EXPECT_EQ(sent.samples_at_next_check(), plan.samples_at_next_check());
    stilb::RunState merged = sent;
    for (const std::size_t part : {2, 0, 1}) {
        stilb::RunState own = sent;
        stilb::measure_part(lit_box(), options, part, 3, own);
        merged.merge(own);
    }
    const stilb::Result result = stilb::result_of(lit_box(), merged, options);
    EXPECT_EQ(mean_of(result), mean_of(stilb::measure(lit_box(), options)));
    EXPECT_EQ(result.stopped, "paths done");
}

TEST(RunStateOfLibrary, FilesNameTheirCommandAndTheirEnding) {
    const stilb::TestFolder folder;
    const std::filesystem::path file = folder.path() / "room.run";
    stilb::RunState state;
    stilb::measure(lit_box(), limited_to(1024), {}, {}, &state);
    state.set_command({"room.toml", "--paths", "1024"}, "..");
    state.save(file);
    EXPECT_TRUE(std::filesystem::exists(file));
    const stilb::RunState read(state.bytes(), "room.run");
    EXPECT_EQ(read.arguments(), state.arguments());
    EXPECT_EQ(read.folder(), "..");
    EXPECT_EQ(read.elapsed_s(), state.elapsed_s());
    const stilb::Result result = stilb::result_of(lit_box(), read, limited_to(1024));
    EXPECT_EQ(result.stopped, "paths done");
    EXPECT_EQ(result.elapsed_s, state.elapsed_s());
}

}  // namespace
