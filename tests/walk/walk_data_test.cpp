// The data of a walk, read as the page reads it.
#include "walk/data/walk_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimators/patch_light/solution/light_vertices.h"
#include "io/image/colour_map.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/ward.h"
#include "scene/light_groups.h"
#include "stilb/error.h"
#include "walk/container_reader.h"
#include "walk/walk_rooms.h"

namespace stilb::walk {
namespace {

using nlohmann::json;

/// A floor of boards, a wall, a pane, a mirror and a lamp.
Scene small_scene() {
    Scene scene;
    const auto phong =
        materials::make<materials::Phong>({Rgb{{0.3, 0.2, 0.1}}, Rgb::grey(0.2), 12}, "boards");
    const auto ward =
        materials::make<materials::Ward>({Rgb::grey(0.1), Rgb::grey(0.3), {0.1, 0.3}, 30}, "steel");
    add_object(scene, Rectangle{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, phong);
    add_object(scene, Rectangle{{0, 3, 0}, {3, 0, 0}, {0, 0, 2}}, diffuse(0.6));
    add_object(scene, Rectangle{{0, 0, 0}, {0, 3, 0}, {0, 0, 2}}, ward);
    add_object(scene, Rectangle{{3, 0, 0}, {0, 0, 2}, {0, 3, 0}}, Mirror{Rgb::grey(0.9)});
    add_area_light(scene, Rectangle{{1, 1, 2}, {0, 0.5, 0}, {0.5, 0, 0}}, Rgb{{2000, 1000, 500}},
                   diffuse(0.2));
    add_point_light(scene, {1, 2, 1.5}, Rgb::grey(80));
    for (const Rgb& base : {Rgb{}, Rgb::grey(0.5)})
        scene.materials.push_back({"lacquer", Plastic(Plastic::Parameters{base, 1.5, 0.2})});
    return scene;
}

/// As the core prepares it: all vertices of surfaces that scatter, seen from their fronts.
estimators::PatchSolution prepared(const Scene& scene) {
    estimators::PatchSolution solution;
    solution.patches = patches::make_patches(scene, 0.5);
    solution.groups = scene::light_groups(scene).names;
    solution.degree = 3;
    std::vector<bool> is_lit(solution.patches.vertices.size());
    for (std::uint32_t p = 0; p < solution.patches.count(); ++p) {
        if (is_specular(scene.material(solution.patches.materials[p]))) continue;
        for (const std::uint32_t corner : solution.patches.corners[p]) is_lit[corner] = true;
    }
    is_lit[0] = false;  // a dark corner
    for (std::uint32_t v = 0; v < is_lit.size(); ++v) {
        if (is_lit[v]) solution.lit_vertices.push_back(v);
    }
    return solution;
}

WalkScene walk_scene() {
    const Camera camera{{1, 0.2, 1.6}, {1, 3, 1}, {0, 0, 1}, 75, {100, 80}};
    return {"A small scene",
            "small.toml",
            {{"view", camera},
             {"grid", Grid{{0, 0, 0.8}, {2, 0, 0}, {0, 1, 0}, {4, 2}, std::nullopt}},
             {"eye", Luminance{{LineOfSight{{1, 1, 1.2}, {0, 1, 0}}}}}}};
}

struct SceneRead : ContainerReader {
    Scene scene = small_scene();
    estimators::PatchSolution solution = prepared(scene);

    SceneRead() : ContainerReader(bytes_of()) {}
    static std::string bytes_of() {
        const Scene scene = small_scene();
        return scene_data(scene, rays::RayCaster(scene), prepared(scene), walk_scene());
    }
};

TEST(SceneData, ListsMaterialsByTheNamesOfSceneFiles) {
    const SceneRead read;
    const json& materials = read.header.at("materials");
    ASSERT_EQ(materials.size(), read.scene.materials.size());
    EXPECT_EQ(materials[0].at("type"), "phong");
    EXPECT_EQ(materials[0].at("diffuse"), (json{0.3, 0.2, 0.1}));
    EXPECT_EQ(materials[0].at("exponent"), 12);
    EXPECT_EQ(materials[0].at("reflection"), "reflection_0");
    EXPECT_EQ(materials[0].at("phis"), 1);
    EXPECT_EQ(materials[1].at("reflectance"), (json{0.6, 0.6, 0.6}));
    EXPECT_TRUE(materials[1].at("reflection").is_null());
    EXPECT_EQ(materials[2].at("roughness"), (json{0.1, 0.3}));
    EXPECT_EQ(materials[2].at("rotation"), 30);
    EXPECT_EQ(materials[2].at("phis"), 32);
    EXPECT_EQ(materials[3].at("type"), "mirror");
    EXPECT_TRUE(materials[3].at("reflection").is_null());
    EXPECT_EQ(read.count("reflection_0"), 33U * 10U);
    EXPECT_EQ(read.count("reflection_2"), 33U * 32U * 10U);
}

TEST(SceneData, HasTheTablesOfFacets) {
    const SceneRead read;
    const json& materials = read.header.at("materials");
    const std::size_t black = materials.size() - 2;
    EXPECT_FALSE(materials[0].contains("facets"));
    const json& facets = materials[black].at("facets");
    EXPECT_EQ(facets, materials[black + 1].at("facets"));
    // What the coat of a black base lets pass is lost.
    EXPECT_NEAR(facets.at("average"),
                1 - read.scene.materials[black].material.get_if<Plastic>()->mean_reflectance()[0], 1e-12);
    const std::vector<double> table = read.numbers(facets.at("array"));
    ASSERT_EQ(table.size(), 129U);
    const auto cosine = [&](double i) {
        return 0.2 * std::expm1(i / facets.at("cells_per_log").get<double>());
    };
    EXPECT_NEAR(cosine(128), 1, 1e-12);
    double average = 0;
    for (std::size_t i = 0; i < 128; ++i) {
        const double low = cosine(static_cast<double>(i)), high = cosine(static_cast<double>(i) + 1);
        average += (table[i] + table[i + 1]) / 2 * (high * high - low * low);
    }
    EXPECT_NEAR(facets.at("average"), average, 1e-4);
}

TEST(SceneData, HasTheFalseColours) {
    const json colours = SceneRead().header.at("false_colours");
    ASSERT_EQ(colours.size(), 257U);
    EXPECT_EQ(colours.front(), json(io::bytes_of(io::ColourMap().at(0))));
    EXPECT_EQ(colours.back(), json(io::bytes_of(io::ColourMap().at(1))));
}

TEST(SceneData, ListsLightsWithPointsForHighlights) {
    const SceneRead read;
    const json& lights = read.header.at("lights");
    const std::vector<double> points = read.numbers("light_points");
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_EQ(lights[0].at("type"), "area");
    EXPECT_EQ(lights[0].at("points"), (json{0, 16}));
    EXPECT_EQ(lights[1].at("points"), (json{16, 1}));
    EXPECT_EQ(lights[1].at("group"), 1);
    const Rgb colour{{lights[0].at("colour")[0], lights[0].at("colour")[1], lights[0].at("colour")[2]}};
    EXPECT_NEAR(colour.luminance(), 1, 1e-9);
    EXPECT_NEAR(colour[0] / colour[1], 2, 1e-9);
    ASSERT_EQ(points.size(), 17U * 8U);
    double weights = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(points[8 * i + 2], 2);
        EXPECT_EQ(points[8 * i + 5], -1);
        weights += points[8 * i + 6];
    }
    EXPECT_NEAR(weights, 1, 1e-6);
    EXPECT_EQ(points[16 * 8 + 6], 1);
    EXPECT_EQ(points[16 * 8 + 5], 0);
}

TEST(SceneData, ListsPlacesToJumpTo) {
    const SceneRead read;
    const json& camera = read.header.at("cameras").at(0);
    EXPECT_EQ(camera.at("name"), "view");
    EXPECT_EQ(camera.at("fov"), 75);
    const json& sensors = read.header.at("sensors");
    ASSERT_EQ(sensors.size(), 2U);
    EXPECT_EQ(sensors[0].at("position"), (json{1, 0.5, 0.8}));
    EXPECT_EQ(sensors[0].at("normal"), (json{0, 0, 1}));
    EXPECT_EQ(sensors[1].at("direction"), (json{0, 1, 0}));
}

TEST(SceneData, DividesTrianglesIntoMeshes) {
    const SceneRead read;
    std::size_t next = 0, shining = 0;
    for (const json& mesh : read.header.at("meshes")) {
        EXPECT_EQ(mesh.at("first"), next);
        next += mesh.at("count").get<std::size_t>();
        if (mesh.at("light") != -1) {
            ++shining;
            EXPECT_EQ(mesh.at("luminance_cd_m2"), (json{2000, 1000, 500}));
        }
    }
    EXPECT_EQ(shining, 1U);
    EXPECT_EQ(next, read.count("triangles"));
    const auto triangles = read.numbers("triangles");
    EXPECT_LT(*std::ranges::max_element(triangles), read.count("positions"));
    EXPECT_EQ(read.count("direct"), 2 * read.count("positions"));
}

/// A display vertex lies at the weighted mean of its light vertices, where none of these is dark.
TEST(SceneData, InterpolatesBetweenLightVertices) {
    const SceneRead read;
    const auto positions = read.numbers("positions"), of = read.numbers("light_of"),
               weights = read.numbers("light_weights"), light = read.numbers("light_positions");
    std::size_t complete = 0, partial = 0, none = 0;
    for (std::size_t v = 0; v < read.count("positions"); ++v) {
        Vec3 mean;
        double sum = 0;
        std::size_t dark = 0;
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
            sum += weights[i];
            if (of[i] == 4294967295.0) {
                ++dark;
                EXPECT_EQ(weights[i], 0);
                continue;
            }
            const auto n = 3 * static_cast<std::size_t>(of[i]);
            mean += weights[i] * Vec3{light[n], light[n + 1], light[n + 2]};
        }
        (dark == 0 ? complete : dark == 3 ? none : partial) += 1;
        EXPECT_NEAR(sum, dark < 3 ? 1 : 0, 2e-3);
        if (dark > 0) continue;
        const Vec3 position{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
        EXPECT_LT(length(mean - position), 5e-3);
    }
    EXPECT_GT(complete, 0U);
    EXPECT_GT(partial, 0U);
    EXPECT_GT(none, 0U);  // the mirror
}

TEST(SceneData, NumbersTheTermsOfLightVertices) {
    const SceneRead read;
    const auto first = read.numbers("light_terms"), materials = read.numbers("light_materials");
    ASSERT_EQ(first.size(), materials.size() + 1);
    for (std::size_t n = 0; n < materials.size(); ++n) {
        const bool is_diffuse =
            read.header.at("materials")[static_cast<std::size_t>(materials[n])].at("type") == "diffuse";
        EXPECT_EQ(first[n + 1] - first[n], is_diffuse ? 1 : 10);
    }
}

/// The sun is beyond the range of half precision.
TEST(SceneData, TakesSinglePrecisionWhereHalfDoesNotSuffice) {
    Scene scene = small_scene();
    add_point_light(scene, {1, 1, 30}, Rgb::grey(1e8));
    const ContainerReader read(scene_data(scene, rays::RayCaster(scene), prepared(scene), walk_scene()));
    EXPECT_EQ(read.info("direct").at("type"), "f32");
    EXPECT_GT(std::ranges::max(read.numbers("direct")), 1e5);
}

/// Light that is the same at all vertices but for a relative error, with terms of all sizes.
estimators::PatchSolution with_light(estimators::PatchSolution solution, const Scene& scene, float error) {
    const estimators::LightVertices light(scene, solution.patches, solution.degree, solution.lit_vertices);
    for (std::size_t g = 0; g < solution.groups.size(); ++g) {
        auto& terms = solution.terms.emplace_back();
        for (std::uint32_t n = 0; n < light.count(); ++n) {
            for (std::uint32_t k = 0; k < light.terms_of(n); ++k) {
                const double size = 100 * std::cos(1.3 * k + 0.01 * n) / (k + 1);
                terms.push_back(to_half_rgb(Rgb{{size + 7, size, size / 3}}));
            }
        }
    }
    solution.replicates.assign(2, std::vector<Half>(light.count(), to_half(1)));
    solution.bias.assign(light.count(), to_half(error));
    return solution;
}

ContainerReader light_of(const estimators::PatchSolution& solution) {
    return ContainerReader(light_data(solution, {3, 512, 0.021, 2.4, true}));
}

std::vector<double> numbers_of(const estimators::PatchSolution& solution) {
    std::vector<double> numbers;
    for (const auto& group : solution.terms) {
        for (const HalfRgb& term : group) {
            for (const Half band : term) numbers.push_back(to_float(band));
        }
    }
    return numbers;
}

TEST(LightData, HoldsTheTermsOfAllGroups) {
    const Scene scene = small_scene();
    const estimators::PatchSolution solution = with_light(prepared(scene), scene, 0);
    const ContainerReader read = light_of(solution);
    EXPECT_EQ(read.numbers("terms"), numbers_of(solution));
    EXPECT_EQ(read.numbers("terms_error"), std::vector<double>(solution.bias.size()));
    EXPECT_EQ(read.header.at("version"), 3);
    EXPECT_EQ(read.header.at("steps"), 512);
    EXPECT_EQ(read.header.at("done"), true);
}

constexpr PageFiles kPage{
    "<!doctype html>\n<html><head>\n<link rel=\"stylesheet\" href=\"./page.css\">\n"
    "<script type=\"module\" src=\"./page.js\"></script>\n</head><body></body></html>\n",
    "const end = \"</script>\", comment = \"<!--\";", "a { color: red }"};

TEST(SelfContainedPage, HoldsEverything) {
    const std::string page = self_contained_page("abcde", "l", kPage);
    EXPECT_NE(page.find("<style>\na { color: red }\n</style>"), std::string::npos);
    EXPECT_NE(page.find(R"(const end = "<\/script>", comment = "<\!--";)"), std::string::npos);
    // Base64 of gzip's first bytes.
    EXPECT_NE(page.find(R"(id="stilb-scene">H4sI)"), std::string::npos);
    EXPECT_NE(page.find(R"(id="stilb-light">H4sI)"), std::string::npos);
    EXPECT_EQ(page.find("page.js"), std::string::npos);
    EXPECT_EQ(page.find("page.css"), std::string::npos);
}

TEST(SelfContainedPage, NeedsThePagesTags) {
    EXPECT_THROW(self_contained_page("", "", {"<html></html>", "", ""}), std::runtime_error);
}

}  // namespace
}  // namespace stilb::walk
