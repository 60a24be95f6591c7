#include "sensors/expression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stilb/error.h"

namespace stilb::sensors {
namespace {

double value_of(const std::string& text, std::vector<double> values) {
    return Expression(text).at(values).value;
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
    EXPECT_EQ(value_of("a + b * c", {2, 3, 4}), 14);
    EXPECT_EQ(value_of("(a + b) * c", {2, 3, 4}), 20);
    EXPECT_EQ(value_of("a - b - c", {2, 3, 4}), -5);
    EXPECT_EQ(value_of("a / b / c", {24, 3, 4}), 2);
    EXPECT_EQ(value_of("-a + -(-b)", {2, 3}), 1);
    EXPECT_EQ(value_of("2.5e1*a-.5", {2}), 49.5);
    EXPECT_EQ(value_of("a*a - a", {3}), 6);
}

TEST(Expression, NamesSensorsReadingsAndStatistics) {
    const Expression formula(
        "desk.mean / task.surround.minimum - wall[3] + eye + 'a b'.maximum + \"x-1\"[0] + Ä");
    ASSERT_EQ(formula.operands().size(), 7U);
    EXPECT_EQ(formula.operands()[0], (Operand{"desk", Statistic::mean, {}}));
    EXPECT_EQ(formula.operands()[1], (Operand{"task.surround", Statistic::minimum, {}}));
    EXPECT_EQ(formula.operands()[2], (Operand{"wall", {}, 3}));
    EXPECT_EQ(formula.operands()[3], (Operand{"eye", {}, {}}));
    EXPECT_EQ(formula.operands()[4], (Operand{"a b", Statistic::maximum, {}}));
    EXPECT_EQ(formula.operands()[5], (Operand{"x-1", {}, 0}));
    EXPECT_EQ(text_of(formula.operands()[1]), "task.surround.minimum");
    EXPECT_EQ(text_of(formula.operands()[4]), "\"a b\".maximum");
    EXPECT_EQ(text_of(formula.operands()[2]), "wall[3]");
}

/// Against differences of values.
TEST(Expression, HasTheRightSlopes) {
    const Expression formula("(a - 2 * b) / (c * c + a * b) - -b / 3");
    const std::vector<double> at{1.3, 0.7, 2.1};
    const Expression::Value value = formula.at(at);
    constexpr double step = 1e-6;
    for (std::size_t i = 0; i < at.size(); ++i) {
        std::vector<double> above = at, below = at;
        above[i] += step, below[i] -= step;
        const double difference = (formula.at(above).value - formula.at(below).value) / (2 * step);
        EXPECT_NEAR(value.slopes[i], difference, 1e-9) << i;
    }
}

TEST(Expression, HasAUnit) {
    const Dimension lux = std::map<std::string, int>{{"lx", 1}};
    const Dimension luminance = std::map<std::string, int>{{"cd/m2", 1}};
    const auto unit = [&](const std::string& text) {
        return text_of(Expression(text).dimension(std::vector{lux, luminance}));
    };
    EXPECT_EQ(unit("a + 0 * b / b * a"), "lx");
    EXPECT_EQ(unit("a / a + 0 * b / b"), "");
    EXPECT_EQ(unit("a - 500 + 0 * b / b * a"), "lx");
    EXPECT_EQ(unit("1 / a * b"), "cd/m2 lx^-1");
    EXPECT_EQ(unit("a * a / b"), "(cd/m2)^-1 lx^2");
    EXPECT_EQ(unit("3 * (2 + 1) / a * b * a / b"), "");
}

std::string message_of(const std::string& text) {
    try {
        const Expression formula(text);
        const Dimension lux = std::map<std::string, int>{{"lx", 1}};
        const Dimension ratio = std::map<std::string, int>{};
        formula.dimension(std::vector{lux, ratio});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Expression, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(message_of("desk.mean / / 2"),
              "expected a number, a sensor or \"(\" at character 13, found \"/\".");
    EXPECT_EQ(message_of("(a + b"), "expected \")\" at character 7, found the end.");
    EXPECT_EQ(message_of("a b"), "expected an operator (+, -, *, /) at character 3, found \"b\".");
    EXPECT_EQ(message_of("a[x]"), "expected the number of a reading, from 0 at character 3, found \"x\".");
    EXPECT_EQ(message_of("a[1"), "expected \"]\" at character 4, found the end.");
    EXPECT_EQ(message_of(""), "expected a number, a sensor or \"(\" at character 1, found the end.");
    EXPECT_EQ(message_of("a.mean.x"), "expected an operator (+, -, *, /) at character 7, found \".\".");
    EXPECT_EQ(message_of("'a"), "expected a name in quotation marks at character 1, found \"'\".");
    EXPECT_EQ(message_of("1e999 * a"), "expected a number at character 1, found \"1\".");
    EXPECT_EQ(message_of("2 + 3"), "has no sensor. Expected: a formula such as \"desk.mean / wall.mean\".");
    EXPECT_EQ(message_of("a + b"),
              "adds or subtracts a value in lx and a ratio. Expected: values of one unit.");
    EXPECT_EQ(message_of(std::string(200, '(') + "a"), "is nested more than 100 deep.");
    EXPECT_EQ(message_of(std::string(200, '-') + "a"), "is nested more than 100 deep.");
}

}  // namespace
}  // namespace stilb::sensors
