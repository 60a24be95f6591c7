#include "papers/head_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/vec.h"
#include "papers/head_in_room.h"
#include "papers/head_report.h"
#include "papers/head_shape.h"

namespace stilb::papers {
namespace {

HeadStudyOptions small(std::vector<int> degrees) { return {std::move(degrees), {24, 24}, {12, 9}, 4, 2}; }

/// The head's points moved onto a sphere.
Mesh sphere_mesh() {
    Mesh mesh = head_mesh();
    for (Vec3& vertex : mesh.vertices) vertex = normalized(vertex);
    return mesh;
}

std::vector<double> cells(const HeadStudy& study, const std::string& name) {
    for (const io::Column& column : columns_of(study)) {
        if (column.name == name) return std::get<std::vector<double>>(column.cells);
    }
    ADD_FAILURE() << "no column " << name;
    return {0, 0};
}

TEST(HeadInRoom, StandsUprightAndLooksAtTheCamera) {
    const Mesh spike{{{0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {0, 0, 3}},
                     {{0, 1, 2}, {0, 2, 3}}};  // 5 up, 3 to the front
    const Mesh placed = placed_in_room(spike);
    EXPECT_NEAR(2 * bounds_of(placed).half_extent(), 1.2, 1e-12);
    const Vec3 up = placed.vertices[2] - placed.vertices[0], front = placed.vertices[3] - placed.vertices[0];
    EXPECT_NEAR(length(up - Vec3{0, 0, 1.2}), 0, 1e-12);
    EXPECT_NEAR(length(front - Vec3{0, -0.72, 0}), 0, 1e-12);
}

TEST(HeadInRoom, ShowsItFromTheFront) {
    const Scene scene = room_with(placed_in_room(sphere_mesh()));
    const auto points = visible_points(scene, *view_of_head({24, 24}).camera());
    ASSERT_GT(points.size(), 150U);
    for (const HeadPoint& point : points) {
        EXPECT_LT(point.position.y, 4.5);
        const Vec3 outwards = normalized(point.position - Vec3{2, 4.2, 1.35});
        EXPECT_GT(dot(point.smooth_normal, outwards), std::cos(1e-3));
    }
}

TEST(HeadStudy, ASphereIsASeriesOfDegree0) {
    const HeadStudy study = study_head(sphere_mesh(), "sphere", small({0, 4}));
    for (const HeadSeries& series : study.series) {
        EXPECT_LT(study.report.largest_error(series.degree), 5e-4);
        EXPECT_LT(series.normal_error_rad, 2e-3);
        EXPECT_LT(series.luminance_difference, 0.03);  // the mesh has facets
    }
    EXPECT_EQ(study.room_degree, 4);
}

TEST(HeadStudy, MoreHarmonicsAreNearer) {
    HeadStudyOptions options = small({2, 16});
    options.passes = 16;  // so that noise counts little
    const HeadStudy study = study_head(head_mesh(), "head", options);
    for (const char* column : {"rms_error", "largest_error", "luminance_difference", "normal_error_deg"})
        EXPECT_LT(cells(study, column)[1], 0.7 * cells(study, column)[0]) << column;
    EXPECT_LT(cells(study, "noise")[0], 0.5 * cells(study, "luminance_difference")[0]);
}

TEST(HeadStudy, BytesAreThoseOfBareNumbers) {
    const HeadStudy study = study_head(head_mesh(), "head", small({2, 8}));
    const double mesh = 12 * (16326 + 32648);
    EXPECT_EQ(cells(study, "degree"), (std::vector<double>{2, 8}));
    EXPECT_EQ(cells(study, "bytes"), (std::vector<double>{36, 324}));
    EXPECT_EQ(cells(study, "mesh_bytes"), (std::vector<double>{mesh, mesh}));
    EXPECT_EQ(cells(study, "storage_ratio"), (std::vector<double>{mesh / 36, mesh / 324}));
    for (const char* column : {"time_s", "mesh_time_s", "time_ratio"}) EXPECT_GT(cells(study, column)[0], 0);
}

TEST(HeadStudy, TheSizeOfTheFileDoesNotMatter) {
    Mesh large = head_mesh();
    for (Vec3& vertex : large.vertices) vertex = 1000 * vertex + Vec3{7, 8, 9};
    const HeadStudy one = study_head(head_mesh(), "head", small({4}));
    const HeadStudy other = study_head(large, "head", small({4}));
    EXPECT_NEAR(one.report.rms_error(4), other.report.rms_error(4), 1e-6);
    EXPECT_NEAR(one.series[0].normal_error_rad, other.series[0].normal_error_rad, 1e-4);
}

}  // namespace
}  // namespace stilb::papers
