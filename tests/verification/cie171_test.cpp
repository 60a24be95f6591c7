#include "verification/cie171.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace stilb::verification {
namespace {

RunOptions cie_options() {
    RunOptions options;
    options.error = 0.01;
    return options;
}

const Cie171Case& case_of(const std::vector<Cie171Case>& cases, const std::string& number) {
    return *std::ranges::find(cases, number, &Cie171Case::number);
}

TEST(Cie171, AllCasesAgree) {
    std::set<std::string> numbers;
    for (const Cie171Case& c : cie171_cases()) {
        numbers.insert(c.number);
        const std::vector<CheckedReading> readings = verify(c, cie_options());
        ASSERT_EQ(readings.size(), c.rows.size());
        for (std::size_t i = 0; i < readings.size(); ++i) {
            EXPECT_FALSE(readings[i].contradicts())
                << c.number << ", " << c.variant << ", " << c.rows[i].point << ": z = " << readings[i].z;
        }
    }
    EXPECT_EQ(numbers, (std::set<std::string>{"5.2", "5.3", "5.4", "5.5", "5.6", "5.7", "5.8"}));
}

TEST(Cie171, FindsAWrongReference) {
    const std::vector<Cie171Case> cases = cie171_cases();
    for (const char* number : {"5.3", "5.4", "5.7"}) {
        Cie171Case c = case_of(cases, number);
        c.rows.front().exact *= 1.05;
        EXPECT_TRUE(verify(c, cie_options()).front().contradicts()) << number;
    }
}

/// Values by formulas outside of this program, and, of 5.6 and 5.7 (corrected), published ones.
TEST(Cie171, HasTheKnownReferences) {
    const std::map<std::string, std::map<std::string, double>> known{
        {"5.2", {{"A", 111.11}, {"B", 105.19}, {"E", 99.72}, {"G", 68.05}, {"J", 49.38}}},
        {"5.3", {{"A", 32.68}, {"B", 75.19}, {"F", 40.00}, {"G", 61.42}, {"J", 105.78}, {"N", 61.42}}},
        {"5.6", {{"B", 35.901}, {"F", 12.967}, {"G", 26.80}, {"J", 35.57}, {"K", 35.57}}},
        {"5.7", {{"A", 16.07}, {"D", 13.32}, {"F", 7.08}, {"G", 3.38}, {"I", 3.01}, {"J", 0}, {"K", 0}}}};
    const std::vector<Cie171Case> cases = cie171_cases();
    for (const auto& [number, values] : known) {
        for (const auto& [point, value] : values) {
            const auto& rows = case_of(cases, number).rows;
            const auto row = std::ranges::find(rows, point, &Cie171Row::point);
            ASSERT_NE(row, rows.end()) << number << point;
            EXPECT_NEAR(row->exact, value, 0.0051) << number << point;
        }
    }
}

}  // namespace
}  // namespace stilb::verification
