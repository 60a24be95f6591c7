// What a page reads from both containers together is the light of the room.
#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"
#include "run/run.h"
#include "run/solve.h"
#include "support/coarser.h"
#include "walk/container_reader.h"
#include "walk/walk_rooms.h"

namespace stilb::walk {
namespace {

class PreparedScene final : public SolutionSink {
  public:
    explicit PreparedScene(const Scene& scene) : scene_(scene) {}
    void prepare(const rays::RayCaster& caster, const estimators::PatchSolution& dark) override {
        bytes = scene_data(scene_, caster, dark, {"room", "room.toml", {}});
    }
    bool wants_solution() override { return false; }
    void show(const estimators::PatchSolution&, const RunSummary&) override {}

    std::string bytes;

  private:
    const Scene& scene_;
};

/// The numbers of a page.
struct Page {
    ContainerReader scene, light;
    std::vector<double> positions = scene.numbers("positions"), normals = scene.numbers("normals"),
                        triangles = scene.numbers("triangles"), direct = scene.numbers("direct"),
                        direct_error = scene.numbers("direct_error"), light_of = scene.numbers("light_of"),
                        weights = scene.numbers("light_weights"), first_term = scene.numbers("light_terms"),
                        terms = light.numbers("terms"), terms_error = light.numbers("terms_error");

    static Vec3 at(const std::vector<double>& numbers, std::size_t i) {
        return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    Vec3 corner(std::size_t i) const { return at(positions, static_cast<std::size_t>(triangles[i])); }
    /// Of the triangle with the corners `first` and following.
    double area_m2(std::size_t first) const {
        return length(cross(corner(first + 1) - corner(first), corner(first + 2) - corner(first))) / 2;
    }
    double direct_lx(std::size_t vertex) const {
        double sum = 0;
        for (std::size_t i = vertex; i < direct.size(); i += positions.size() / 3) sum += direct[i];
        return sum;
    }
    struct Reflected {
        double lx = 0, error_lx = 0;
    };
    Reflected reflected_lx(std::size_t vertex) const {
        Reflected sum;
        const auto groups = scene.header.at("groups").size();
        const auto in_group = static_cast<std::size_t>(first_term.back());
        for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
            if (weights[i] == 0) continue;
            const auto number = static_cast<std::size_t>(light_of[i]);
            for (std::size_t g = 0; g < groups; ++g) {
                const Vec3 a = at(terms, g * in_group + static_cast<std::size_t>(first_term[number]));
                const double lx = std::sqrt(kPi) * Rgb{{a.x, a.y, a.z}}.luminance();
                sum.lx += weights[i] * lx;
                sum.error_lx += weights[i] * lx * terms_error[number];
            }
        }
        return sum;
    }
};

TEST(Page, ShowsTheLightOfTheRoomWithinItsError) {
    const Scene scene = furnished_room();
    PreparedScene prepared(scene);
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = 512;
    const SolveResult solved = run::solve(scene, options, 4, nullptr, nullptr, &prepared);
    const Page page{ContainerReader(prepared.bytes), ContainerReader(light_data(solved.solution, {}))};
    std::vector<MeasuringPoint> points;
    std::vector<double> shown_lx, error_lx;
    std::vector<double> areas;
    for (std::size_t t = 0; t < page.triangles.size(); t += 3) areas.push_back(page.area_m2(t));
    const math::DiscreteDistribution by_area(areas);
    for (std::size_t i = 0; i < 500; ++i) {
        math::SampleStream stream(math::RandomKey{7}, i);
        const std::size_t t = by_area.choose(stream.next()).index;
        const auto [u, v] = stream.next_two();
        const auto [b0, b1, b2] = math::sample_triangle(u, v);
        MeasuringPoint point{};
        double lx = 0, error = 0;
        for (const auto& [corner, weight] : {std::pair{3 * t, b0}, {3 * t + 1, b1}, {3 * t + 2, b2}}) {
            const auto vertex = static_cast<std::size_t>(page.triangles[corner]);
            const auto reflected = page.reflected_lx(vertex);
            point.position += weight * Page::at(page.positions, vertex);
            point.normal += weight * Page::at(page.normals, vertex);
            lx += weight * (page.direct_lx(vertex) + reflected.lx);
            error += weight * (page.direct_error[vertex] + reflected.error_lx);
        }
        const Vec3& p = point.position;
        if (p.z < 1e-3 && p.x > kBox.min.x && p.x < kBox.max.x && p.y > kBox.min.y && p.y < kBox.max.y)
            continue;
        point.normal = normalized(point.normal);
        if (length(p - kBall.center) < 1.001 * kBall.radius)  // triangles are chords of the ball
            point.position = kBall.center + kBall.radius * point.normal;
        points.push_back(point);
        shown_lx.push_back(lx);
        error_lx.push_back(error);
    }
    RunOptions truth;
    truth.paths = fewer(32'768, 2);
    const std::vector<Sensor> sensors{point_sensor(points)};
    const RunResult measured = run::measure(scene, sensors, truth);
    std::size_t covered = 0, close = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const statistics::Estimate& estimate = measured.sensors[0].readings[i].estimate;
        const double noise_lx = (estimate.upper - estimate.lower) / 2;
        const double off_lx = std::abs(shown_lx[i] - estimate.value);
        covered += off_lx <= error_lx[i] + noise_lx ? 1 : 0;
        close += off_lx <= 0.05 * estimate.value + noise_lx ? 1 : 0;
    }
    EXPECT_GE(static_cast<double>(covered), 0.95 * static_cast<double>(points.size()));
    EXPECT_GE(static_cast<double>(close), 0.95 * static_cast<double>(points.size()));
}

}  // namespace
}  // namespace stilb::walk
