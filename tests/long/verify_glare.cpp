// How often the intervals of Daylight Glare Probabilities hold: verify_glare [SEEDS]. A lamp in an
// environment, of exactly known rating, and a room whose lit walls are above the threshold of glare, with the
// mean of all runs as the truth. Fails where the intervals hold in less than 91 % or more than 99.5 % of the
// runs (95 % within three standard errors of 200 seeds).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "run/run.h"
#include "support/lamp_in_environment.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

/// The lamp is behind the eye: all glare comes from noisy pixels.
Scene lit_room() {
    Scene scene;
    add_object(scene, Box{{-2, -2, 0}, {2, 3, 3}}, diffuse(0.6));
    add_object(scene, Box{{0.5, 1.5, 0}, {1.2, 2.2, 1.4}}, diffuse(0.8));
    add_area_light(scene, Rectangle{{-0.5, -1.8, 2.9}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(20000));
    return scene;
}

std::vector<statistics::Estimate> ratings(const Scene& scene, const Dgp& sensor, int seeds) {
    std::vector<statistics::Estimate> all;
    const std::vector<Sensor> sensors{{"eye", sensor}};
    for (int seed = 1; seed <= seeds; ++seed) {
        RunOptions options;
        options.method = "path";
        options.paths = 1 << 12;
        options.seed = static_cast<std::uint64_t>(seed);
        all.push_back(run::measure(scene, sensors, options).sensors[0].readings[0].estimate);
    }
    return all;
}

bool cover(std::string_view name, const std::vector<statistics::Estimate>& all, double truth) {
    const auto held = std::ranges::count_if(all, [&](const statistics::Estimate& estimate) {
        return estimate.lower <= truth && truth <= estimate.upper;
    });
    const double percent = 100 * static_cast<double>(held) / static_cast<double>(all.size());
    const bool is_right = percent >= 91 && percent <= 99.5;
    fmt::print("| {} | {:.5f} | {:.1f} % |{}\n", name, truth, percent, is_right ? "" : " WRONG");
    std::fflush(stdout);
    return is_right;
}

int verify(int seeds) {
    const bool of_lamp = cover("lamp", ratings(lamp_in_an_environment(), Dgp{{kEye}}, seeds), lamp_dgp());
    const auto of_room = ratings(lit_room(), Dgp{{kEye}, 1000.0}, seeds);
    double mean = 0;
    for (const statistics::Estimate& estimate : of_room) mean += estimate.value / static_cast<double>(seeds);
    const bool of_walls = cover("lit walls", of_room, mean);
    return of_lamp && of_walls ? 0 : 1;
}

}  // namespace
}  // namespace stilb

int main(int argument_count, char** arguments) {
    return stilb::verify(std::max(argument_count > 1 ? std::atoi(arguments[1]) : 200, 2));
}
