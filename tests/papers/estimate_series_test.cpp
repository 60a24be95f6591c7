#include "papers/estimate_series.h"

#include <gtest/gtest.h>

namespace stilb::papers {
namespace {

const std::vector<statistics::Estimate> kEstimates{{2, 0.5, 1, 3}, {4, 0.25, 3.5, 4.5}};

TEST(EstimateSeries, IsACurveWithItsBand) {
    const Series series = series_of("a curve", {10, 20}, kEstimates);
    EXPECT_EQ(series.name, "a curve");
    EXPECT_EQ(series.x, (std::vector<double>{10, 20}));
    EXPECT_EQ(series.y, (std::vector<double>{2, 4}));
    EXPECT_EQ(series.y_low, (std::vector<double>{1, 3.5}));
    EXPECT_EQ(series.y_high, (std::vector<double>{3, 4.5}));
}

TEST(EstimateSeries, IsFourColumns) {
    std::vector<io::Column> columns{{"x", std::vector<double>{10, 20}}};
    add_columns(columns, "auto", "lx", kEstimates);
    EXPECT_EQ(to_csv(columns),
              "x,auto_lx,auto_standard_error_lx,auto_lower_lx,auto_upper_lx\r\n"
              "10,2,0.5,1,3\r\n"
              "20,4,0.25,3.5,4.5\r\n");
}

TEST(EstimateSeries, ScalesAllOfAnEstimate) {
    EXPECT_EQ(scaled(kEstimates[0], 2), (statistics::Estimate{4, 1, 2, 6}));
}

}  // namespace
}  // namespace stilb::papers
