#include "plot/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stilb/error.h"

namespace stilb::plot {
namespace {

constexpr auto kLinear = ScaleType::linear;
constexpr auto kLogarithmic = ScaleType::logarithmic;

std::vector<std::string> labels(ScaleType type, double low, double high, int most) {
    std::vector<std::string> texts;
    for (const Tick& tick : nice_ticks(Scale(type, {low, high}), most).major) texts.push_back(tick.label);
    return texts;
}

using Texts = std::vector<std::string>;

TEST(Axis, LabelsLinearTicks) {
    EXPECT_EQ(labels(kLinear, 0, 1, 6), (Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    EXPECT_EQ(labels(kLinear, -30, 30, 5), (Texts{"−20", "0", "20"}));
    EXPECT_EQ(labels(kLinear, 103, 487, 6), (Texts{"200", "300", "400"}));
    EXPECT_EQ(labels(kLinear, 0, 20000, 3), (Texts{"0", "10\u202f000", "20\u202f000"}));
    EXPECT_EQ(labels(kLinear, 0, 4e-6, 5), (Texts{"0", "10⁻⁶", "2×10⁻⁶", "3×10⁻⁶", "4×10⁻⁶"}));
    EXPECT_EQ(labels(kLinear, 0, 3e7, 3), (Texts{"0", "2×10⁷"}));
}

TEST(Axis, LabelsLogarithmicTicks) {
    EXPECT_EQ(labels(kLogarithmic, 1, 1000, 8), (Texts{"1", "10", "100", "1000"}));
    EXPECT_EQ(labels(kLogarithmic, 90, 1100, 8), (Texts{"100", "200", "500", "1000"}));
    EXPECT_EQ(labels(kLogarithmic, 1e-8, 1, 5), (Texts{"10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"}));
    EXPECT_EQ(labels(kLogarithmic, 0.01, 1, 3), (Texts{"0.01", "0.1", "1"}));
    // Too little for 1, 2, 5: linear steps.
    EXPECT_EQ(labels(kLogarithmic, 480, 520, 5), (Texts{"480", "490", "500", "510", "520"}));
}

TEST(Axis, LinearTicksAreRoundEquallySpacedAndFew) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-12, 12), unit(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const double size = std::pow(10, exponent(random));
        const double low = size * unit(random);
        const double high = low + size * (0.05 + std::abs(unit(random)));
        const std::vector<Tick> ticks = nice_ticks(Scale(kLinear, {low, high}), 8).major;
        ASSERT_GE(ticks.size(), 2u) << low << " " << high;
        ASSERT_LE(ticks.size(), 8u) << low << " " << high;
        const double step = ticks[1].value - ticks[0].value;
        const double mantissa = step / std::pow(10, std::floor(std::log10(step * 1.000001)));
        EXPECT_TRUE(std::abs(mantissa - 1) < 1e-4 || std::abs(mantissa - 2) < 1e-4 ||
                    std::abs(mantissa - 5) < 1e-4)
            << step;
        const double slack = 1e-5 * step;
        EXPECT_GE(ticks.front().value, low - slack);
        EXPECT_LT(ticks.front().value, low + step + slack);
        EXPECT_LE(ticks.back().value, high + slack);
        EXPECT_GT(ticks.back().value, high - step - slack);
        for (std::size_t k = 1; k < ticks.size(); ++k) {
            EXPECT_NEAR(ticks[k].value - ticks[k - 1].value, step, slack);
            EXPECT_NE(ticks[k].label, ticks[k - 1].label);
        }
    }
}

TEST(Axis, LogarithmicTicksStayWithinAndAreFew) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> exponent(-9, 9), decades(0.1, 12);
    for (int i = 0; i < 2000; ++i) {
        const double low = std::pow(10, exponent(random));
        const double high = low * std::pow(10, decades(random));
        const std::vector<Tick> ticks = nice_ticks(Scale(kLogarithmic, {low, high}), 8).major;
        ASSERT_GE(ticks.size(), 2u) << low << " " << high;
        ASSERT_LE(ticks.size(), 8u) << low << " " << high;
        EXPECT_GE(ticks.front().value, low * (1 - 1e-5));
        EXPECT_LE(ticks.back().value, high * (1 + 1e-5));
        for (std::size_t k = 1; k < ticks.size(); ++k) EXPECT_GT(ticks[k].value, ticks[k - 1].value);
    }
}

TEST(Axis, ScalesAndTheirInversesAgree) {
    for (const Scale& scale : {Scale(kLinear, {-2, 3}), Scale(kLogarithmic, {0.5, 4000})}) {
        EXPECT_DOUBLE_EQ(scale.fraction_of(scale.range().low), 0);
        EXPECT_DOUBLE_EQ(scale.fraction_of(scale.range().high), 1);
        for (const double fraction : {-0.3, 0.0, 0.25, 0.7, 1.4}) {
            EXPECT_NEAR(scale.fraction_of(scale.value_at(fraction)), fraction, 1e-12);
        }
    }
    EXPECT_DOUBLE_EQ(Scale(kLogarithmic, {1, 10000}).fraction_of(100), 0.5);
    EXPECT_EQ(Scale(kLogarithmic, {1, 10}).fraction_of(0), -INFINITY);
    EXPECT_TRUE(std::isnan(Scale(kLogarithmic, {1, 10}).fraction_of(NAN)));
}

TEST(Axis, RefusesEmptyScales) {
    EXPECT_THROW(Scale(kLinear, {3, 3}), InputError);
    EXPECT_THROW(Scale(kLinear, {3, 2}), InputError);
    EXPECT_THROW(Scale(kLinear, {0, INFINITY}), InputError);
    EXPECT_THROW(Scale(kLinear, {NAN, 1}), InputError);
    EXPECT_THROW(Scale(kLogarithmic, {0, 1}), InputError);
}

AxisRange range_of(ScaleType type, std::vector<double> values) { return nice_range(type, values); }

TEST(Axis, RangesHoldTheDataAndEndRound) {
    const AxisRange linear = range_of(kLinear, {103, NAN, 487, 250});
    EXPECT_EQ(linear.low, 100);
    EXPECT_EQ(linear.high, 500);
    const AxisRange logarithmic = range_of(kLogarithmic, {0, -1, 0.03, 700, INFINITY});
    EXPECT_DOUBLE_EQ(logarithmic.low, 0.02);
    EXPECT_DOUBLE_EQ(logarithmic.high, 1000);
    const AxisRange exact = range_of(kLogarithmic, {0.001, 1000});
    EXPECT_DOUBLE_EQ(exact.low, 0.001);
    EXPECT_DOUBLE_EQ(exact.high, 1000);
}

TEST(Axis, RangesAreNeverEmpty) {
    for (const ScaleType type : {kLinear, kLogarithmic}) {
        for (const std::vector<double>& values :
             {std::vector<double>{}, {NAN}, {0}, {7}, {100}, {-5}, {1e-30}, {1e20, 1e20}, {5, 5.0000001}}) {
            const AxisRange range = nice_range(type, values);
            EXPECT_NO_THROW(Scale(type, range)) << range.low << " " << range.high;
            for (const double value : values) {
                if (!std::isfinite(value) || (type == kLogarithmic && value <= 0)) continue;
                EXPECT_LE(range.low, value * (1 + 1e-6 * (value < 0 ? -1 : 1)));
                EXPECT_GE(range.high, value * (1 - 1e-6 * (value < 0 ? -1 : 1)));
            }
        }
    }
}

TEST(Axis, WritesNumbers) {
    EXPECT_EQ(number_text(-0.0004, 2), "0.00");
    EXPECT_EQ(number_text(-12.345, 1), "−12.3");
    EXPECT_EQ(number_text(9999, 0), "9999");
    EXPECT_EQ(number_text(1234567.5, 1), "1\u202f234\u202f567.5");
    EXPECT_EQ(three_digit_decimals(498.2), 0);
    EXPECT_EQ(three_digit_decimals(49.8), 1);
    EXPECT_EQ(three_digit_decimals(-0.0498), 4);
    EXPECT_EQ(three_digit_decimals(0), 0);
}

}  // namespace
}  // namespace stilb::plot
