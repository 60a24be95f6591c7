// A furnished room against Radiance's rtrace: docs/radiance.md has the settings and the table.
#include <array>

#include "io/import/rtrace.h"
#include "io/text/radiance_units.h"
#include "radiance_text.h"
#include "run/run.h"

namespace stilb::io {
namespace {

/// Irradiances and their standard errors by rtrace of pyradiance 1.3 [W/m2], 133 batches of 20 runs.
struct Reference {
    std::array<double, 3> irradiance, standard_error;
};
constexpr std::array<Reference, 10> kByRtrace{
    {Reference{{2.76052, 2.41315, 1.88652}, {0.00755, 0.00626, 0.00440}},
     Reference{{5.28893, 5.15606, 4.57158}, {0.00068, 0.00052, 0.00037}},
     Reference{{3.02311, 2.89302, 2.64827}, {0.00055, 0.00045, 0.00034}},
     Reference{{2.42751, 2.28981, 2.04142}, {0.00089, 0.00061, 0.00037}},
     Reference{{0.19469, 0.11746, 0.08118}, {0.00058, 0.00047, 0.00034}},
     Reference{{1.91951, 1.76047, 1.50821}, {0.00072, 0.00050, 0.00035}},
     Reference{{1.46772, 1.30959, 1.09779}, {0.00089, 0.00063, 0.00040}},
     Reference{{1.18428, 1.05410, 0.86891}, {0.00050, 0.00038, 0.00026}},
     Reference{{0.29234, 0.20572, 0.15422}, {0.00043, 0.00032, 0.00023}},
     Reference{{1.31792, 1.18144, 0.97814}, {0.00065, 0.00046, 0.00029}}}};

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
        const double error =
            std::hypot(photometric({standard_error}).luminance(), readings[i].estimate.standard_error);
        EXPECT_LT(error, 0.01 * expected) << i;
        EXPECT_NEAR(readings[i].estimate.value, expected, 3 * error + models * expected) << i;
        const Rgb own = radiometric(readings[i].rgb);
        for (std::size_t b = 0; b < kBands; ++b)
            EXPECT_NEAR(own[b], irradiance[b], 0.02 * irradiance[b]) << i << " " << b;
    }
}

}  // namespace
}  // namespace stilb::io
