
#include "plot/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stilb/error.h"

namespace stilb::plot {

namespace {

/// The tolerance for rounding where a tick falls on an end of the scale; a share of the distance between
/// ticks.
constexpr double kSlack = 1e-6;

constexpr std::array<double, 3> kRound{1, 2, 5};

struct NiceStep {
    double mantissa = 1;
    int exponent = 0;

    double value() const { return mantissa * std::pow(10.0, exponent); }
    /// Exact where index * step is a short decimal: division by a power of ten rounds just once.
    double multiple(double index) const {
        return exponent < 0 ? index * mantissa / std::pow(10.0, -exponent) : index * value();
    }
};

/// The smallest of 1, 2, 5 times a power of ten that is not below `least`.
NiceStep nice_step(double least) {
    NiceStep step{1, static_cast<int>(std::floor(std::log10(least)))};
    for (const double mantissa : kRound) {
        step.mantissa = mantissa;
        if (step.value() >= least * (1 - kSlack)) return step;
    }
    return {1, step.exponent + 1};
}

std::string superscript(int number) {
    static constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : fmt::format("{}", number)) {
        text += c == '-' ? "⁻" : kDigits[static_cast<std::size_t>(c - '0')];
    }
    return text;
}

std::string power_text(double mantissa, int decimals, int exponent) {
    std::string power = "10" + superscript(exponent);
    if (decimals == 0 && mantissa == 1) return power;
    return number_text(mantissa, decimals) + "×" + power;
}

bool needs_powers(double smallest, double largest) { return smallest < 0.9e-4 || largest >= 0.9e6; }

std::vector<double> multiples_within(const AxisRange& range, const NiceStep& step) {
    std::vector<double> values;
    const double last = std::floor(range.high / step.value() + kSlack);
    for (double i = std::ceil(range.low / step.value() - kSlack); i <= last; ++i) {
        values.push_back(step.multiple(i) + 0.0);  // + 0.0 makes -0 a 0
    }
    return values;
}

Ticks linear_ticks(const AxisRange& range, int most) {
    const NiceStep step = nice_step((range.high - range.low) / std::max(most - 1, 1));
    Ticks ticks;
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    const bool powers = needs_powers(step.value(), largest);
    const int exponent = powers ? static_cast<int>(std::floor(std::log10(largest) + kSlack)) : 0;
    const int decimals = std::max(exponent - step.exponent, 0);
    for (const double value : multiples_within(range, step)) {
        const double shown = value / std::pow(10.0, exponent);
        const bool plain = !powers || value == 0;
        ticks.major.push_back({value, plain ? number_text(value, value == 0 ? 0 : decimals)
                                            : power_text(shown, decimals, exponent)});
    }
    const NiceStep minor = step.mantissa == 1   ? NiceStep{2, step.exponent - 1}
                           : step.mantissa == 2 ? NiceStep{5, step.exponent - 1}
                                                : NiceStep{1, step.exponent};
    ticks.minor = multiples_within(range, minor);
    return ticks;
}

struct PowerTick {
    double mantissa;
    int exponent;
    double value() const { return NiceStep{mantissa, exponent}.multiple(1); }
};

/// mantissas x 10^(every stride-th power) within the range.
std::vector<PowerTick> powers_within(const AxisRange& range, std::span<const double> mantissas, int stride) {
    std::vector<PowerTick> ticks;
    const int first = static_cast<int>(std::floor(std::log10(range.low))) - 1;
    const int last = static_cast<int>(std::ceil(std::log10(range.high))) + 1;
    for (int exponent = first; exponent <= last; ++exponent) {
        if (exponent % stride != 0) continue;
        for (const double mantissa : mantissas) {
            const PowerTick tick{mantissa, exponent};
            if (tick.value() >= range.low * (1 - kSlack) && tick.value() <= range.high * (1 + kSlack)) {
                ticks.push_back(tick);
            }
        }
    }
    return ticks;
}

Ticks logarithmic_ticks(const AxisRange& range, int most) {
    const std::span<const double> decade(kRound.data(), 1);
    std::vector<PowerTick> chosen = powers_within(range, kRound, 1);
    if (chosen.size() < 3) return linear_ticks(range, most);
    for (int stride = 1; chosen.size() > static_cast<std::size_t>(most); ++stride) {
        chosen = powers_within(range, decade, stride);
    }
    Ticks ticks;
    const bool powers = needs_powers(chosen.front().value(), chosen.back().value());
    for (const PowerTick& tick : chosen) {
        ticks.major.push_back({tick.value(), powers
                                                 ? power_text(tick.mantissa, 0, tick.exponent)
                                                 : number_text(tick.value(), std::max(-tick.exponent, 0))});
    }
    static constexpr std::array<double, 9> kAll{1, 2, 3, 4, 5, 6, 7, 8, 9};
    for (const PowerTick& tick : powers_within(range, kAll, 1)) ticks.minor.push_back(tick.value());
    return ticks;
}

AxisRange nice_linear_range(double low, double high) {
    if (low == high) {
        const double margin = low == 0 ? 1 : std::abs(low) / 10;
        low -= margin;
        high += margin;
    }
    const NiceStep step = nice_step((high - low) / 8);
    return {step.multiple(std::floor(low / step.value() + kSlack)),
            step.multiple(std::ceil(high / step.value() - kSlack))};
}

AxisRange nice_logarithmic_range(double low, double high) {
    const NiceStep top = nice_step(high);
    // The largest round number not above `low` is the inverse of the smallest one not below 1 / low.
    const NiceStep inverse = nice_step(1 / low);
    const double bottom = NiceStep{10 / inverse.mantissa, -inverse.exponent - 1}.multiple(1);
    return {bottom, top.value() > bottom ? top.value() : nice_step(bottom * 1.5).value()};
}

}  // namespace

Scale::Scale(ScaleType type, AxisRange range) : type_(type), range_(range) {
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low < range.high)) {
        throw InputError(fmt::format("a scale from {} to {} is empty. Give a minimum below the maximum.",
                                     range.low, range.high));
    }
    if (type == ScaleType::logarithmic && range.low <= 0) {
        throw InputError(
            fmt::format("a logarithmic scale cannot start at {}, because only numbers above 0 have a "
                        "logarithm. Give a minimum "
                        "above 0 or use a linear scale.",
                        range.low));
    }
}

double Scale::fraction_of(double value) const {
    if (type_ == ScaleType::linear) return (value - range_.low) / (range_.high - range_.low);
    if (value <= 0) return -std::numeric_limits<double>::infinity();
    return std::log(value / range_.low) / std::log(range_.high / range_.low);
}

double Scale::value_at(double fraction) const {
    if (type_ == ScaleType::linear) return range_.low + fraction * (range_.high - range_.low);
    return range_.low * std::pow(range_.high / range_.low, fraction);
}

Ticks nice_ticks(const Scale& scale, int most) {
    return scale.type() == ScaleType::linear ? linear_ticks(scale.range(), most)
                                             : logarithmic_ticks(scale.range(), most);
}

AxisRange nice_range(ScaleType type, std::span<const double> values) {
    const bool logarithmic = type == ScaleType::logarithmic;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values) {
        if (!std::isfinite(value) || (logarithmic && value <= 0)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) return logarithmic ? AxisRange{1, 10} : AxisRange{0, 1};
    return logarithmic ? nice_logarithmic_range(low, high) : nice_linear_range(low, high);
}

std::string number_text(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
    const std::size_t whole = std::min(text.find('.'), text.size());
    if (whole >= 5) {
        for (std::size_t at = whole; at > 3; at -= 3) text.insert(at - 3, "\u202f");
    }
    return std::signbit(value) && text.find_first_of("123456789") != std::string::npos ? "−" + text : text;
}

int three_digit_decimals(double value) {
    if (value == 0 || !std::isfinite(value)) return 0;
    return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 9);
}

namespace {

constexpr double kTickLength = 5;
constexpr double kMinorLength = 2.5;
constexpr double kLabelGap = 4;
Stroke tick_stroke() { return {kInk, 0.8}; }

/// The point `distance` outside the frame.
Point outside(Side side, const PageRectangle& frame, double along, double distance) {
    if (side == Side::left) return {frame.left - distance, along};
    if (side == Side::right) return {frame.right() + distance, along};
    return {along, frame.bottom() + distance};
}

}  // namespace

double position_along(const Scale& scale, Side side, const PageRectangle& frame, double value) {
    const double fraction = scale.fraction_of(value);
    return side == Side::bottom ? frame.left + fraction * frame.width
                                : frame.bottom() - fraction * frame.height;
}

void draw_axis(Canvas& canvas, const Scale& scale, const Ticks& ticks, Side side,
               const PageRectangle& frame) {
    const auto mark = [&](double value, double length) {
        const double along = position_along(scale, side, frame, value);
        canvas.line(outside(side, frame, along, 0), outside(side, frame, along, length), tick_stroke());
        return along;
    };
    TextStyle style{.size = kAxisTextSize, .colour = kInk};
    style.horizontal = side == Side::left    ? HorizontalPart::right
                       : side == Side::right ? HorizontalPart::left
                                             : HorizontalPart::center;
    style.vertical = side == Side::bottom ? VerticalPart::top : VerticalPart::middle;
    for (const double value : ticks.minor) mark(value, kMinorLength);
    for (const Tick& tick : ticks.major) {
        const double along = mark(tick.value, kTickLength);
        canvas.text(outside(side, frame, along, kTickLength + kLabelGap), tick.label, style);
    }
}

double axis_extent(const Ticks& ticks, Side side) {
    double labels = side == Side::bottom ? kAxisTextSize : 0;
    if (side != Side::bottom) {
        for (const Tick& tick : ticks.major) {
            labels = std::max(labels, text_width(tick.label, kAxisTextSize));
        }
    }
    return kTickLength + kLabelGap + labels;
}

}  // namespace stilb::plot
