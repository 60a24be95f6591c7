#include "io/results/results_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "io/text/text.h"

namespace stilb::io {
namespace {

TEST(ResultsText, ShowsIntervalsWithoutAnUpperEnd) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(with_error({21.34, 1.2, 18.96, infinite}), "21.3 (above 19.0)");
    EXPECT_EQ(with_error({none, none, 27.1, infinite}), "above 27.1");
    EXPECT_EQ(with_error({none, none, none, none}), "-");
}

TEST(ResultsText, KeepsTheDigitsOfExactValues) {
    const auto exact = [](double value) { return with_error({value, 0, value, value}); };
    EXPECT_EQ(exact(0), "0.00 ± 0.00");
    EXPECT_EQ(exact(1234.56), "1234.6 ± 0.0");
    EXPECT_EQ(exact(12.345), "12.35 ± 0.00");
    EXPECT_EQ(exact(0.98765), "0.988 ± 0.000");
    EXPECT_EQ(exact(0.00123456), "0.00123 ± 0.00000");
    EXPECT_EQ(exact(1.23456e-7), "1.23e-07 ± 0");
    EXPECT_EQ(with_error({1.23456e-7, 1e-9, 1.22e-7, 1.24e-7}), "1.23e-07 ± 1e-09");
}

TEST(ResultsText, ShowsErrorsThatAreNotZero) {
    const auto text = [](double value, double half) {
        return with_error({value, half / 2, value - half, value + half});
    };
    EXPECT_EQ(text(0.00010134, 2e-7), "0.0001013 ± 0.0000002");
    EXPECT_EQ(text(0.00010134, 2e-9), "0.0001013 ± 2e-09");
    EXPECT_EQ(text(573.7112341, 3.2e-6), "573.711234 ± 0.000003");
    EXPECT_EQ(text(573.7112341, 3e-9), "573.711234 ± 3e-09");
    EXPECT_EQ(text(5, 0.0123), "5.000 ± 0.012");
}

TEST(ResultsText, HasNoMinusBeforeZero) {
    EXPECT_EQ(with_error({-0.001, 0.05, -0.101, 0.099}), "0.00 ± 0.10");
    EXPECT_EQ(with_error({-0.06, 0.05, -0.16, 0.04}), "-0.06 ± 0.10");
    EXPECT_EQ(fixed(-0.4, 0), "0");
    EXPECT_EQ(fixed(-0.6, 0), "-1");
}

TEST(ResultsText, PercentHasTwoDigitsOrAllBeforeThePoint) {
    EXPECT_EQ(percent(0.00654), "0.65 %");
    EXPECT_EQ(percent(0.99), "99 %");
    EXPECT_EQ(percent(0.996), "100 %");
    EXPECT_EQ(percent(3.14), "314 %");
    EXPECT_EQ(percent(std::numeric_limits<double>::infinity()), "inf %");
}

TEST(ResultsText, WordsOfRequirementsAndVerdicts) {
    RunResult result;
    EXPECT_EQ(verdicts_text(result), "");
    SensorResult task;
    task.sensor = {"task", Grid{{}, {1, 0, 0}, {0, 1, 0}}};
    const Requirement mean{&sensors::kCriteria[0], 500}, uniformity{&sensors::kCriteria[3], 0.6};
    task.requirements = {{mean, Verdict::pass}, {uniformity, Verdict::undecided}, {mean, Verdict::pass}};
    result.sensors = {task};
    EXPECT_EQ(verdicts_text(result), "2 pass, 1 not sure yet");
    EXPECT_EQ(requirement_text(mean, task.sensor), "mean at least 500 lx");
    EXPECT_EQ(requirement_text(uniformity, task.sensor), "uniformity at least 0.6");
}

TEST(Text, TakesWordsAndUnitsOfKeys) {
    const auto expect = [](const std::string& key, const std::string& words, const std::string& unit) {
        EXPECT_EQ(words_of_key(key).words, words);
        EXPECT_EQ(words_of_key(key).unit, unit);
    };
    expect("peak_intensity_cd", "peak intensity", "cd");
    expect("luminance_cd_m2", "luminance", "cd/m2");
    expect("opening_m2", "opening", "m2");
    expect("object", "object", "");
}

TEST(Text, EncodesBytesAsBase64) {  // the test vectors of RFC 4648
    const std::pair<std::string, std::string> vectors[] = {
        {"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
        {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace stilb::io
