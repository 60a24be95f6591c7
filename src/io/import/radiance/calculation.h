// Formulas of the functions that genrev revolves, in Radiance's language of functions.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::io::radiance {

/// Numbers, the variables and functions that were defined, + - * / ^, parentheses, and: sin cos tan asin acos
/// atan atan2 exp log log10 sqrt abs floor ceil if min max mod, hermite bezier bspline (each of four values
/// and t). PI is defined.
class Calculation {
  public:
    Calculation();
    ~Calculation();
    Calculation(const Calculation&) = delete;
    Calculation& operator=(const Calculation&) = delete;

    /// Definitions "a = 2; f(x) = a * x^2;" of -e. Throws InputError without a place.
    void define(std::string_view text);
    /// The value of a formula with the variable t. Throws InputError without a place.
    double value(std::string_view formula, double t);

  private:
    struct Function;
    class Parser;
    std::map<std::string, std::unique_ptr<Function>, std::less<>> functions_;
    int depth_ = 0;
    std::size_t steps_ = 0;
};

}  // namespace stilb::io::radiance
