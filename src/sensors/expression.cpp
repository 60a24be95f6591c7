#include "sensors/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "stilb/error.h"

namespace stilb::sensors {

// A parser by recursive descent:
//
//     sum     = product { ("+" | "-") product }
//     product = factor { ("*" | "/") factor }
//     factor  = "-" factor | "(" sum ")" | number | operand
//     operand = name { "." name } [ "[" index "]" ]
//
// The last name of an operand may be that of a statistic. Names with other characters than letters, digits
// and "_" stand in quotation marks.
class ExpressionParser {
  public:
    explicit ExpressionParser(Expression& expression) : expression_(expression), text_(expression.text_) {}

    void parse() {
        sum();
        if (at_ < text_.size()) fail("an operator (+, -, *, /)");
        if (expression_.operands_.empty())
            throw InputError("has no sensor. Expected: a formula such as \"desk.mean / wall.mean\".");
    }

  private:
    using Kind = Expression::Step::Kind;

    void sum() {
        product();
        for (;;) {
            if (take('+')) {
                product();
                add(Kind::add);
            } else if (take('-')) {
                product();
                add(Kind::subtract);
            } else {
                return;
            }
        }
    }

    void product() {
        factor();
        for (;;) {
            if (take('*')) {
                factor();
                add(Kind::multiply);
            } else if (take('/')) {
                factor();
                add(Kind::divide);
            } else {
                return;
            }
        }
    }

    void factor() {
        constexpr int deepest = 100;
        if (++depth_ > deepest) throw InputError(fmt::format("is nested more than {} deep.", deepest));
        if (take('-')) {
            factor();
            add(Kind::negate);
        } else if (take('(')) {
            sum();
            if (!take(')')) fail("\")\"");
        } else if (is_digit(next()) || next() == '.') {
            number();
        } else {
            operand();
        }
        --depth_;
    }

    void number() {
        double value = 0;
        const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (failure != std::errc() || !std::isfinite(value)) fail("a number");
        at_ = static_cast<std::size_t>(end - text_.data());
        expression_.steps_.push_back({Kind::number, value, 0});
    }

    void operand() {
        Operand found{name(), std::nullopt, std::nullopt};
        while (!found.statistic && take('.')) {
            const std::string part = name();
            const auto statistic = std::ranges::find(kStatisticNames, part);
            if (statistic != kStatisticNames.end()) {
                found.statistic = static_cast<Statistic>(statistic - kStatisticNames.begin());
            } else {
                found.sensor += '.' + part;
            }
        }
        if (!found.statistic && take('[')) found.reading = index();
        auto& all = expression_.operands_;
        const auto known = std::ranges::find(all, found);
        expression_.steps_.push_back({Kind::operand, 0, static_cast<std::size_t>(known - all.begin())});
        if (known == all.end()) all.push_back(std::move(found));
    }

    std::size_t index() {
        std::size_t value = 0;
        next();
        const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (failure != std::errc()) fail("the number of a reading, from 0");
        at_ = static_cast<std::size_t>(end - text_.data());
        if (!take(']')) fail("\"]\"");
        return value;
    }

    std::string name() {
        const char quote = next();
        if (quote == '"' || quote == '\'') {
            const std::size_t end = text_.find(quote, at_ + 1);
            if (end == std::string_view::npos) fail("a name in quotation marks");
            std::string quoted(text_.substr(at_ + 1, end - at_ - 1));
            at_ = end + 1;
            return quoted;
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_part_of_name(text_[at_])) ++at_;
        if (at_ == begin) fail("a number, a sensor or \"(\"");
        return std::string(text_.substr(begin, at_ - begin));
    }

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    /// Letters of other alphabets are bytes above 127.
    static bool is_part_of_name(char c) {
        return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
               static_cast<unsigned char>(c) > 127;
    }

    /// The next character that is not a space; 0 at the end.
    char next() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (next() != c) return false;
        ++at_;
        return true;
    }
    void add(Kind kind) { expression_.steps_.push_back({kind, 0, 0}); }

    [[noreturn]] void fail(std::string_view expected) {
        const char found = next();
        throw InputError(fmt::format("expected {} at character {}, found {}.", expected, at_ + 1,
                                     found ? fmt::format("\"{}\"", text_.substr(at_, 1)) : "the end"));
    }

    Expression& expression_;
    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

namespace {

std::string quoted_if_needed(const std::string& name) {
    const bool is_plain = std::ranges::all_of(
        name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.' || c > 127; });
    return is_plain ? name : fmt::format("\"{}\"", name);
}

/// Values with their derivatives.
struct Derivatives {
    using Value = Expression::Value;
    std::span<const double> values;

    Value number(double value) const { return {value, std::vector<double>(values.size())}; }
    Value operand(std::size_t i) const {
        Value value = number(values[i]);
        value.slopes[i] = 1;
        return value;
    }
    Value negate(const Value& a) const { return combine(a, -1, number(0), 0, -a.value); }
    Value add(const Value& a, const Value& b) const { return combine(a, 1, b, 1, a.value + b.value); }
    Value subtract(const Value& a, const Value& b) const { return combine(a, 1, b, -1, a.value - b.value); }
    Value multiply(const Value& a, const Value& b) const {
        return combine(a, b.value, b, a.value, a.value * b.value);
    }
    Value divide(const Value& a, const Value& b) const {
        return combine(a, 1 / b.value, b, -a.value / (b.value * b.value), a.value / b.value);
    }

    /// With the slopes a.slopes by_a + b.slopes by_b.
    Value combine(const Value& a, double by_a, const Value& b, double by_b, double value) const {
        Value result = number(value);
        for (std::size_t i = 0; i < values.size(); ++i)
            result.slopes[i] = by_a * a.slopes[i] + by_b * b.slopes[i];
        return result;
    }
};

struct Dimensions {
    using Value = Dimension;
    std::span<const Dimension> of_operands;

    Value number(double) const { return std::nullopt; }
    Value operand(std::size_t i) const { return of_operands[i]; }
    Value negate(const Value& a) const { return a; }
    Value add(const Value& a, const Value& b) const {
        if (!a || !b) return a ? a : b;
        if (*a != *b) {
            const auto described = [](const Value& unit) {
                return unit->empty() ? "a ratio" : "a value in " + text_of(unit);
            };
            throw InputError(fmt::format("adds or subtracts {} and {}. Expected: values of one unit.",
                                         described(a), described(b)));
        }
        return a;
    }
    Value subtract(const Value& a, const Value& b) const { return add(a, b); }
    Value multiply(const Value& a, const Value& b) const { return with_exponents(a, b, 1); }
    Value divide(const Value& a, const Value& b) const { return with_exponents(a, b, -1); }

    static Value with_exponents(const Value& a, const Value& b, int sign) {
        if (!a && !b) return std::nullopt;
        auto result = a.value_or(std::map<std::string, int>{});
        for (const auto& [unit, exponent] : b.value_or(std::map<std::string, int>{}))
            result[unit] += sign * exponent;
        std::erase_if(result, [](const auto& power) { return power.second == 0; });
        return result;
    }
};

}  // namespace

std::string text_of(const Operand& operand) {
    std::string text = quoted_if_needed(operand.sensor);
    if (operand.statistic) text.append(".").append(name_of(*operand.statistic));
    if (operand.reading) text += fmt::format("[{}]", *operand.reading);
    return text;
}

std::string text_of(const Dimension& dimension) {
    std::string text;
    for (const auto& [unit, exponent] : dimension.value_or(std::map<std::string, int>{})) {
        if (!text.empty()) text += ' ';
        const bool is_compound = unit.find('/') != std::string::npos;
        const std::string base = is_compound ? "(" + unit + ")" : unit;
        text += exponent == 1 ? unit : fmt::format("{}^{}", base, exponent);
    }
    return text;
}

Expression::Expression(std::string text) : text_(std::move(text)) { ExpressionParser(*this).parse(); }

template <typename Algebra>
auto Expression::evaluate(const Algebra& algebra) const {
    using Operated = typename Algebra::Value;
    std::vector<Operated> stack;
    const auto taken = [&] {
        Operated value = std::move(stack.back());
        stack.pop_back();
        return value;
    };
    const auto binary = [&](auto operation) {
        const Operated b = taken(), a = taken();
        stack.push_back((algebra.*operation)(a, b));
    };
    for (const Step& step : steps_) {
        switch (step.kind) {
            case Step::Kind::number:
                stack.push_back(algebra.number(step.number));
                break;
            case Step::Kind::operand:
                stack.push_back(algebra.operand(step.operand));
                break;
            case Step::Kind::negate:
                stack.push_back(algebra.negate(taken()));
                break;
            case Step::Kind::add:
                binary(&Algebra::add);
                break;
            case Step::Kind::subtract:
                binary(&Algebra::subtract);
                break;
            case Step::Kind::multiply:
                binary(&Algebra::multiply);
                break;
            case Step::Kind::divide:
                binary(&Algebra::divide);
        }
    }
    return taken();
}

Expression::Value Expression::at(std::span<const double> values) const {
    return evaluate(Derivatives{values});
}

Dimension Expression::dimension(std::span<const Dimension> of_operands) const {
    return evaluate(Dimensions{of_operands});
}

}  // namespace stilb::sensors
