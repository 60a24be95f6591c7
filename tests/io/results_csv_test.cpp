#include <gtest/gtest.h>

#include "io/luminance_results.h"
#include "io/results/results_writer.h"
#include "io/text/text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

std::string csv_of(const RunResult& made, const std::string& sensor) {
    const TestFolder folder;
    write_results_csv(made, folder / "csv");
    return read_whole_file(folder / "csv" / (sensor + ".csv"));
}

TEST(ResultsCsv, HasALineForEachLineOfSight) {
    EXPECT_EQ(
        csv_of(luminance_results(), "view"),
        "x_m,y_m,z_m,direction_x,direction_y,direction_z,hit_x_m,hit_y_m,hit_z_m,luminance_cd_m2,"
        "standard_error_cd_m2,interval_low_cd_m2,interval_high_cd_m2,red_cd_m2,green_cd_m2,blue_cd_m2\r\n"
        "2,0,1,0,1,0,2,4,1,100,1,98,102,110,100,90\r\n"
        "2,0,1,0,0,1,,,,200,1,198,202,210,200,190\r\n");
}

TEST(ResultsCsv, HasALineForEachDirectionOfAGoniometer) {
    const std::string csv = csv_of(luminance_results(), "solid");
    EXPECT_TRUE(csv.starts_with(
        "x_m,y_m,z_m,normal_x,normal_y,normal_z,direction_x,direction_y,direction_z,theta_deg,phi_deg,"
        "hit_x_m,hit_y_m,hit_z_m,luminance_cd_m2,standard_error_cd_m2,interval_low_cd_m2,"
        "interval_high_cd_m2,red_cd_m2,green_cd_m2,blue_cd_m2\r\n2,2,0,0,0,1,"))
        << csv;
    EXPECT_NE(csv.find("\r\n2,2,0,0,0,1,0,0,1,0,90,2,2,0,30,1,28,32,40,30,20\r\n"), csv.npos) << csv;
    EXPECT_TRUE(csv.ends_with(",60,90,2,2,0,31,1,29,33,41,31,21\r\n")) << csv;
}

TEST(ResultsCsv, HasALineForEachMeasuringPoint) {
    RunResult made;
    const Sensor eye{"eye", IlluminancePoints{{{{1, 2, 3}, {0, 0, 1}}}}};
    made.sensors = {{eye, {reading(100)}, {}, {}, 0.02}};
    EXPECT_EQ(csv_of(made, "eye"),
              "x_m,y_m,z_m,normal_x,normal_y,normal_z,illuminance_lx,standard_error_lx,interval_low_lx,"
              "interval_high_lx,red_lx,green_lx,blue_lx\r\n"
              "1,2,3,0,0,1,100,1,98,102,110,100,90\r\n");
}

TEST(ResultsCsv, BodiesHaveAnAxisWhereItIsNotTheVertical) {
    RunResult made;
    const Sensor hemisphere{"up", Hemispherical{{{1, 2, 3}}, {0, 0, 1}}};
    const Sensor cylinder{"around", Cylindrical{{{1, 2, 3}}}};
    made.sensors = {{hemisphere, {reading(100)}, {}, {}, 0.02}, {cylinder, {reading(100)}, {}, {}, 0.02}};
    EXPECT_EQ(csv_of(made, "up"),
              "x_m,y_m,z_m,normal_x,normal_y,normal_z,hemispherical_illuminance_lx,standard_error_lx,"
              "interval_low_lx,interval_high_lx,red_lx,green_lx,blue_lx\r\n"
              "1,2,3,0,0,1,100,1,98,102,110,100,90\r\n");
    EXPECT_EQ(csv_of(made, "around"),
              "x_m,y_m,z_m,cylindrical_illuminance_lx,standard_error_lx,interval_low_lx,interval_high_lx,"
              "red_lx,green_lx,blue_lx\r\n"
              "1,2,3,100,1,98,102,110,100,90\r\n");
}

}  // namespace
}  // namespace stilb::io
