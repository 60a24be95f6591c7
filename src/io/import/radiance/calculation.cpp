#include "io/import/radiance/calculation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::radiance {

/// A definition. Its body is read whenever it is called: formulas are short, and called a few hundred times.
struct Calculation::Function {
    std::vector<std::string> parameters;
    std::string body;
};

namespace {

constexpr int kDeepestFormula = 60;
constexpr std::size_t kMostSteps = 1'000'000;

using Values = std::vector<double>;

struct Builtin {
    std::string_view name;
    std::size_t arguments;
    double (*value)(const Values& v);
};

double hermite(const Values& v) {
    const double t = v[4];
    return v[0] * ((2 * t - 3) * t * t + 1) + v[1] * (-2 * t + 3) * t * t + v[2] * ((t - 2) * t + 1) * t +
           v[3] * (t - 1) * t * t;
}
double bezier(const Values& v) {
    const double t = v[4], s = 1 - t;
    return v[0] * s * s * s + 3 * v[1] * s * s * t + 3 * v[2] * s * t * t + v[3] * t * t * t;
}
double bspline(const Values& v) {
    const double t = v[4], s = 1 - t;
    return (v[0] * s * s * s + v[1] * (4 + t * t * (3 * t - 6)) + v[2] * (1 + t * (3 + t * (3 - 3 * t))) +
            v[3] * t * t * t) /
           6;
}

constexpr std::array kBuiltins{
    Builtin{"sin", 1, [](const Values& v) { return std::sin(v[0]); }},
    Builtin{"cos", 1, [](const Values& v) { return std::cos(v[0]); }},
    Builtin{"tan", 1, [](const Values& v) { return std::tan(v[0]); }},
    Builtin{"asin", 1, [](const Values& v) { return std::asin(v[0]); }},
    Builtin{"acos", 1, [](const Values& v) { return std::acos(v[0]); }},
    Builtin{"atan", 1, [](const Values& v) { return std::atan(v[0]); }},
    Builtin{"atan2", 2, [](const Values& v) { return std::atan2(v[0], v[1]); }},
    Builtin{"exp", 1, [](const Values& v) { return std::exp(v[0]); }},
    Builtin{"log", 1, [](const Values& v) { return std::log(v[0]); }},
    Builtin{"log10", 1, [](const Values& v) { return std::log10(v[0]); }},
    Builtin{"sqrt", 1, [](const Values& v) { return std::sqrt(v[0]); }},
    Builtin{"abs", 1, [](const Values& v) { return std::abs(v[0]); }},
    Builtin{"floor", 1, [](const Values& v) { return std::floor(v[0]); }},
    Builtin{"ceil", 1, [](const Values& v) { return std::ceil(v[0]); }},
    Builtin{"if", 3, [](const Values& v) { return v[0] > 0 ? v[1] : v[2]; }},
    Builtin{"min", 2, [](const Values& v) { return std::min(v[0], v[1]); }},
    Builtin{"max", 2, [](const Values& v) { return std::max(v[0], v[1]); }},
    Builtin{"mod", 2, [](const Values& v) { return v[0] - std::floor(v[0] / v[1]) * v[1]; }},
    Builtin{"hermite", 5, hermite},
    Builtin{"bezier", 5, bezier},
    Builtin{"bspline", 5, bspline}};

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '`';
}

}  // namespace

/// Recursive descent; computes while it reads.
class Calculation::Parser {
  public:
    Parser(Calculation& calculation, std::string_view text, const std::map<std::string, double>& locals)
        : calculation_(calculation), all_(text), rest_(text), locals_(locals) {}

    double whole() {
        const double result = sum();
        if (!peek().empty()) fail(fmt::format("found {} where an operator is needed", in_quotes(rest_)));
        return result;
    }

  private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError(fmt::format("formula {}: {}.", in_quotes(all_), problem));
    }
    std::string_view peek() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
        return rest_.substr(0, 1);
    }
    bool take(std::string_view symbol) {
        if (peek() != symbol) return false;
        rest_.remove_prefix(1);
        return true;
    }

    double sum() {
        double result = product();
        while (true) {
            if (take("+")) {
                result += product();
            } else if (take("-")) {
                result -= product();
            } else {
                return result;
            }
        }
    }
    double product() {
        double result = power();
        while (true) {
            if (take("*")) {
                result *= power();
            } else if (take("/")) {
                result /= power();
            } else {
                return result;
            }
        }
    }
    double power() {
        // The sign belongs to the base, as in Radiance: -2^2 is 4.
        const Nesting nesting(*this);
        const bool is_negative = take("-");
        if (!is_negative) take("+");
        const double base = is_negative ? -primary() : primary();
        return take("^") ? std::pow(base, power()) : base;
    }
    double primary() {
        if (take("(")) {
            const double result = sum();
            if (!take(")")) fail("a parenthesis is not closed");
            return result;
        }
        const std::string_view first = peek();
        if (first.empty()) fail("it ends where a value is needed");
        if ((first[0] >= '0' && first[0] <= '9') || first[0] == '.') return number();
        if (is_letter(first[0])) return named();
        fail(fmt::format("found {} where a value is needed", in_quotes(first)));
    }
    double number() {
        std::size_t end = 0;
        const auto is_digit = [&](std::size_t i) {
            return i < rest_.size() && ((rest_[i] >= '0' && rest_[i] <= '9') || rest_[i] == '.');
        };
        while (is_digit(end)) ++end;
        if (end < rest_.size() && (rest_[end] == 'e' || rest_[end] == 'E')) {
            const bool has_sign = end + 1 < rest_.size() && (rest_[end + 1] == '-' || rest_[end + 1] == '+');
            if (is_digit(end + 1 + has_sign)) {
                end += 1 + has_sign;
                while (is_digit(end)) ++end;
            }
        }
        const auto value = parse_number(rest_.substr(0, end));
        if (!value) fail(fmt::format("{} is no number", in_quotes(rest_.substr(0, end))));
        rest_.remove_prefix(end);
        return *value;
    }
    double named() {
        std::size_t end = 0;
        while (end < rest_.size() && is_letter(rest_[end])) ++end;
        const std::string name(rest_.substr(0, end));
        rest_.remove_prefix(end);
        return call(name, take("(") ? arguments() : Values{});
    }
    Values arguments() {
        Values values{sum()};
        while (take(",")) values.push_back(sum());
        if (!take(")")) fail("the arguments of a function are not closed");
        return values;
    }
    double call(const std::string& name, const Values& arguments) {
        if (++calculation_.steps_ > kMostSteps) fail("it needs more than a million steps");
        if (const auto local = locals_.find(name); local != locals_.end() && arguments.empty())
            return local->second;
        if (const auto own = calculation_.functions_.find(name); own != calculation_.functions_.end())
            return call_defined(name, *own->second, arguments);
        if (name == "PI" && arguments.empty()) return kPi;
        const auto builtin = std::ranges::find(kBuiltins, std::string_view(name), &Builtin::name);
        if (builtin == kBuiltins.end()) fail(fmt::format("there is no {}", in_quotes(name)));
        require_count(name, builtin->arguments, arguments.size());
        return builtin->value(arguments);
    }
    double call_defined(const std::string& name, const Function& function, const Values& arguments) {
        require_count(name, function.parameters.size(), arguments.size());
        const Nesting nesting(*this);
        std::map<std::string, double> locals;
        for (std::size_t i = 0; i < arguments.size(); ++i) locals[function.parameters[i]] = arguments[i];
        return Parser(calculation_, function.body, locals).whole();
    }
    void require_count(const std::string& name, std::size_t needed, std::size_t found) const {
        if (needed != found)
            fail(fmt::format("{} needs {} arguments, but has {}", in_quotes(name), needed, found));
    }

    /// Counts how deep the formula is nested.
    struct Nesting {
        explicit Nesting(Parser& parser) : depth(parser.calculation_.depth_) {
            if (++depth > kDeepestFormula) {
                --depth;
                parser.fail("it is nested too deeply, or refers to itself");
            }
        }
        ~Nesting() { --depth; }
        Nesting(const Nesting&) = delete;
        Nesting& operator=(const Nesting&) = delete;
        int& depth;
    };

    Calculation& calculation_;
    std::string_view all_, rest_;
    const std::map<std::string, double>& locals_;
};

Calculation::Calculation() = default;
Calculation::~Calculation() = default;

void Calculation::define(std::string_view text) {
    while (!trimmed(text).empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        const std::string_view definition = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (definition.empty()) continue;
        // "=" and ":" (a constant) both define.
        const std::size_t equals = definition.find_first_of("=:");
        if (equals == definition.npos) {
            throw InputError(
                fmt::format("{} is no definition. Allowed: NAME = FORMULA, NAME(X, Y) = FORMULA.",
                            in_quotes(definition)));
        }
        std::string_view head = trimmed(definition.substr(0, equals));
        auto function = std::make_unique<Function>();
        function->body = definition.substr(equals + 1);
        if (const std::size_t open = head.find('('); open != head.npos) {
            std::string_view list = head.substr(open + 1);
            if (!list.ends_with(')'))
                throw InputError(fmt::format("the parameters of {} are not closed.", in_quotes(head)));
            list.remove_suffix(1);
            while (!list.empty()) {
                const std::size_t comma = std::min(list.find(','), list.size());
                function->parameters.emplace_back(trimmed(list.substr(0, comma)));
                list.remove_prefix(std::min(comma + 1, list.size()));
            }
            head = trimmed(head.substr(0, open));
        }
        functions_.insert_or_assign(std::string(head), std::move(function));
    }
}

double Calculation::value(std::string_view formula, double t) {
    steps_ = 0;
    const std::map<std::string, double> locals{{"t", t}};
    const double result = Parser(*this, formula, locals).whole();
    if (!std::isfinite(result))
        throw InputError(fmt::format("formula {}: its value at t = {} is no number.", in_quotes(formula), t));
    return result;
}

}  // namespace stilb::io::radiance
