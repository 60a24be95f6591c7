#include "math/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace stilb::math {
namespace {

/// q_l+1 = a z q_l - b q_l-1, for one m: normalised Legendre functions without the factor sin^m(theta).
struct Step {
    double a = 0, b = 0;
};

/// sqrt(2) N_lm and Legendre functions in one, by normalised recurrences: nothing overflows up to degree 128
/// [Holmes and Featherstone 2002, A unified approach to the Clenshaw summation].
struct Recurrences {
    std::vector<double> first;  ///< q_mm, per m
    std::vector<Step> steps;    ///< m by m, from l to l + 1 for l = m, m + 1 ...
    std::vector<std::size_t> first_step;

    Recurrences() {
        double q = std::sqrt(0.25 * std::numbers::inv_pi);
        for (int m = 0; m <= kMostHarmonicDegree; ++m) {
            if (m > 0) q *= std::sqrt((2. * m + 1) / (2. * m)) * (m == 1 ? std::numbers::sqrt2 : 1);
            first.push_back(q);
            first_step.push_back(steps.size());
            for (int l = m; l < kMostHarmonicDegree; ++l) {
                const double n = l + 1., divisor = n * n - m * m, a = std::sqrt((4 * n * n - 1) / divisor);
                const double before = (2 * n + 1) * (l * l - m * m) / ((2 * n - 3) * divisor);
                steps.push_back({a, l == m ? 0 : std::sqrt(before)});
            }
        }
    }
};

const Recurrences& recurrences() {
    static const Recurrences all;
    return all;
}

/// sin^m(theta) cos(m phi) and sin^m(theta) sin(m phi), m = 0, 1 ...
template <typename T>
struct Turns {
    T x, y, cosine = 1, sine = 0;

    void advance() {
        const T turned = cosine * x - sine * y;
        sine = sine * x + cosine * y;
        cosine = turned;
    }
};

int degree_of(std::size_t count) {
    for (int degree = 0; degree <= kMostHarmonicDegree; ++degree) {
        if (harmonic_count(degree) == count) return degree;
    }
    throw std::invalid_argument("the number of coefficients belongs to no degree of spherical harmonics");
}

}  // namespace

void evaluate_harmonics(const Vec3& direction, int degree, std::span<double> values) {
    const Recurrences& all = recurrences();
    Turns<double> turns{direction.x, direction.y};
    for (int m = 0; m <= degree; ++m, turns.advance()) {
        const std::size_t order = static_cast<std::size_t>(m);
        const Step* step = all.steps.data() + all.first_step[order];
        double before = 0, q = all.first[order];
        for (int l = m; l <= degree; ++l) {
            values[harmonic_number(l, -m)] = q * turns.sine;
            values[harmonic_number(l, m)] = q * turns.cosine;  // last: of m = 0 there is no other
            if (l == degree) break;
            const double next = step->a * direction.z * q - step->b * before;
            before = q, q = next, ++step;
        }
    }
}

template <typename T>
HarmonicSeries<T>::HarmonicSeries(std::span<const double> coefficients)
    : degree_(degree_of(coefficients.size())) {
    for (int m = 0; m <= degree_; ++m) {
        for (int l = m; l <= degree_; ++l) {
            const double sine = m == 0 ? 0 : coefficients[harmonic_number(l, -m)];
            pairs_.push_back({static_cast<T>(coefficients[harmonic_number(l, m)]), static_cast<T>(sine)});
        }
    }
}

template <typename T>
HarmonicSeries<T> HarmonicSeries<T>::part(int low, int high) const {
    HarmonicSeries result;
    result.degree_ = high;
    const Pair* pair = pairs_.data();
    for (int m = 0; m <= degree_; ++m) {
        for (int l = m; l <= degree_; ++l, ++pair) {
            if (l <= high) result.pairs_.push_back(l >= low ? *pair : Pair{});
        }
    }
    return result;
}

template <typename T>
template <typename Visit>
void HarmonicSeries<T>::for_each_order(T z, const Visit& visit) const {
    const Recurrences& all = recurrences();
    const Pair* pair = pairs_.data();
    for (int m = 0; m <= degree_; ++m) {
        const std::size_t order = static_cast<std::size_t>(m);
        const Step* step = all.steps.data() + all.first_step[order];
        T before = 0, q = static_cast<T>(all.first[order]);
        Pair sum;
        for (int l = m; l <= degree_; ++l, ++pair) {
            sum.cosine += pair->cosine * q;
            sum.sine += pair->sine * q;
            if (l == degree_) continue;
            const T next = static_cast<T>(step->a) * z * q - static_cast<T>(step->b) * before;
            before = q, q = next, ++step;
        }
        visit(order, sum);
    }
}

template <typename T>
T HarmonicSeries<T>::at(const Vec3& direction) const {
    Turns<T> turns{static_cast<T>(direction.x), static_cast<T>(direction.y)};
    T value = 0;
    for_each_order(static_cast<T>(direction.z), [&](std::size_t, const Pair& sum) {
        value += sum.cosine * turns.cosine + sum.sine * turns.sine;
        turns.advance();
    });
    return value;
}

template <typename T>
std::vector<T> HarmonicSeries<T>::on_parallel(double z, std::size_t count) const {
    std::vector<T> cosines, sines, values(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double phi = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
        cosines.push_back(static_cast<T>(std::cos(phi)));
        sines.push_back(static_cast<T>(std::sin(phi)));
    }
    const T radius = static_cast<T>(std::sqrt(std::max(0.0, 1 - z * z)));
    T power = 1;
    for_each_order(static_cast<T>(z), [&](std::size_t m, const Pair& sum) {
        std::size_t turn = 0;  // m k modulo count
        for (T& value : values) {
            value += power * (sum.cosine * cosines[turn] + sum.sine * sines[turn]);
            turn = (turn + m) % count;
        }
        power *= radius;
    });
    return values;
}

/// The gradient of the polynomial in x, y and z, projected onto the sphere's tangent plane.
template <typename T>
typename HarmonicSeries<T>::Value HarmonicSeries<T>::with_gradient(const Vec3& direction) const {
    const Recurrences& all = recurrences();
    const T z = static_cast<T>(direction.z);
    Turns<T> turns{static_cast<T>(direction.x), static_cast<T>(direction.y)}, before_turns = turns;
    const Pair* pair = pairs_.data();
    T value = 0, along_x = 0, along_y = 0, along_z = 0;
    for (int m = 0; m <= degree_; ++m, before_turns = turns, turns.advance()) {
        const std::size_t order = static_cast<std::size_t>(m);
        const Step* step = all.steps.data() + all.first_step[order];
        T before = 0, q = static_cast<T>(all.first[order]), slope_before = 0, slope = 0;
        Pair own, own_slope;
        for (int l = m; l <= degree_; ++l, ++pair) {
            own.cosine += pair->cosine * q, own.sine += pair->sine * q;
            own_slope.cosine += pair->cosine * slope, own_slope.sine += pair->sine * slope;
            if (l == degree_) continue;
            const T a = static_cast<T>(step->a), b = static_cast<T>(step->b);
            const T next = a * z * q - b * before, next_slope = a * (q + z * slope) - b * slope_before;
            before = q, q = next, slope_before = slope, slope = next_slope, ++step;
        }
        value += own.cosine * turns.cosine + own.sine * turns.sine;
        along_z += own_slope.cosine * turns.cosine + own_slope.sine * turns.sine;
        if (m == 0) continue;
        const T order_t = static_cast<T>(m);
        along_x += order_t * (own.cosine * before_turns.cosine + own.sine * before_turns.sine);
        along_y += order_t * (own.sine * before_turns.cosine - own.cosine * before_turns.sine);
    }
    const Vec3 gradient{double{along_x}, double{along_y}, double{along_z}};
    return {value, gradient - dot(gradient, direction) * direction};
}

template class HarmonicSeries<float>;
template class HarmonicSeries<double>;

/// Along any great circle f'' is at most L^2 max |f| [Bernstein], and f' = 0 where f is largest or least: so
/// a point of a grid that is no farther than e has a value that differs by L^2 e^2 max |f| / 2 at most.
HarmonicRange range_of(const HarmonicSeries<double>& series) {
    constexpr double part = 0.03;
    const double degree = series.degree();
    const double spacing = degree > 0 ? std::sqrt(2 * part) / degree * std::numbers::sqrt2 : 1;
    const auto parallels = static_cast<std::size_t>(std::ceil(std::numbers::pi / spacing)) + 1;
    HarmonicRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t k = 0; k < parallels; ++k) {
        const double theta =
            std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(parallels);
        for (const double value : series.on_parallel(std::cos(theta), 2 * parallels)) {
            range.least = std::min(range.least, value);
            range.greatest = std::max(range.greatest, value);
        }
    }
    const double margin = part / (1 - part) * std::max(std::abs(range.least), std::abs(range.greatest));
    return {range.least - margin, range.greatest + margin};
}

}  // namespace stilb::math
