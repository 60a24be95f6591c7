// Formulas of readings and their statistics, such as "desk.mean / surround.mean".
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/statistic.h"

namespace stilb::sensors {

/// What a formula takes from a sensor: a statistic, the reading with this index, or else its only reading.
struct Operand {
    std::string sensor;
    std::optional<Statistic> statistic;
    std::optional<std::size_t> reading;

    bool operator==(const Operand&) const = default;
};

/// As it is written in formulas: "desk.mean", "wall[3]", "eye".
std::string text_of(const Operand& operand);

/// The exponents of the units that a value is a product of; empty for a ratio. Plain numbers in a formula
/// have any unit: nothing.
using Dimension = std::optional<std::map<std::string, int>>;
/// "lx", "cd/m2", "lx^2 (cd/m2)^-1"; empty for a ratio or a number.
std::string text_of(const Dimension& dimension);

/// Sums, differences, products and quotients of numbers and operands, with parentheses. Immutable.
class Expression {
  public:
    Expression() = default;
    /// Throws InputError with the character where the text is wrong; a formula has one operand at least.
    explicit Expression(std::string text);

    const std::string& text() const { return text_; }
    const std::vector<Operand>& operands() const { return operands_; }

    struct Value {
        double value = 0;
        std::vector<double> slopes;  ///< the derivatives by each operand
    };
    /// At these values of the operands.
    Value at(std::span<const double> values) const;
    /// From the operands' dimensions; throws InputError where values of different units are added.
    Dimension dimension(std::span<const Dimension> of_operands) const;

  private:
    friend class ExpressionParser;

    /// In reverse Polish notation: each operation takes the last values.
    struct Step {
        enum class Kind { number, operand, negate, add, subtract, multiply, divide } kind = Kind::number;
        double number = 0;
        std::size_t operand = 0;
    };
    template <typename Algebra>
    auto evaluate(const Algebra& algebra) const;

    std::string text_;
    std::vector<Operand> operands_;
    std::vector<Step> steps_;
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Expression;
using sensors::Operand;
}  // namespace stilb
