// A furnished room against Radiance's rtrace: docs/radiance.md has the settings and the table.
#include <array>

#include "io/import/rtrace.h"
#include "io/text/radiance_units.h"
#include "radiance_text.h"
#include "run/run.h"

namespace stilb::io {
namespace {

/// Irradiances and their standard errors by rtrace of pyradiance 1.3 [W/m2], ROOM_RUNS.
struct Reference {
    std::array<double, 3> irradiance, standard_error;
};
constexpr std::array<Reference, 10> kByRtrace{{
ROOM_NUMBERS
}};

TEST(RadianceRoom, HasTheIlluminancesOfRtrace) {
    const SceneFile file = read_radiance_scene(kRadianceData / "room.rad");
    const Sensor points = read_points(kRadianceData / "grid.pts");
    RunOptions options;
    options.paths = 1 << 15;
    const RunResult result = run::measure(file.scene, std::span(&points, 1), options);
    const auto& readings = result.sensors.at(0).readings;
    ASSERT_EQ(readings.size(), kByRtrace.size());
    constexpr double models = 0.003;  // share by which the programs may differ besides their errors
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const auto& [irradiance, standard_error] = kByRtrace[i];
        const double expected = photometric({irradiance}).luminance();
        const double error = std::hypot(photometric({standard_error}).luminance(),
                                        readings[i].estimate.standard_error);
        EXPECT_LT(error, 0.01 * expected) << i;
        EXPECT_NEAR(readings[i].estimate.value, expected, 3 * error + models * expected) << i;
        const Rgb own = radiometric(readings[i].rgb);
        for (std::size_t b = 0; b < kBands; ++b)
            EXPECT_NEAR(own[b], irradiance[b], 0.02 * irradiance[b]) << i << " " << b;
    }
}

}  // namespace
}  // namespace stilb::io
