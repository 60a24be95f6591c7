
#include "geometry/harmonics/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "math/first_root.h"
#include "math/gauss_legendre.h"

namespace stilb::geometry {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNarrowest = 1e-9;
/// Cells reach a little beyond their edges in s and t, so that rounding leaves no gaps.
constexpr double kOverlap = 1e-9;
/// Safety margins of bounds, for rounding and the overlap: relative, and as a share of W.
constexpr double kSlack = 1e-4, kLeastSlack = 1e-12;
constexpr double kMargin = 1e-5;  ///< of boxes
/// The points of largest differences from the surface: between nodes, and in the middle of the cell.
constexpr std::array kChecked{-0.7, 0.26, 0.7};

/// The interval of a ray where linear functions of the distance are not negative. Its ends are fractions with
/// positive denominators, because most are replaced before their values are needed.
class Stretch {
  public:
    Stretch(double low, double high) : low_{low, 1}, high_{high, 1} {}

    void keep(double at_0, double slope) {
        if (slope > 0) {
            if (-at_0 * low_.divisor > low_.dividend * slope) low_ = {-at_0, slope};
        } else if (slope < 0) {
            if (at_0 * high_.divisor < -high_.dividend * slope) high_ = {at_0, -slope};
        } else if (at_0 < 0) {
            high_ = {-kInfinity, 1};
        }
    }
    bool is_empty() const { return !(low_.dividend * high_.divisor < high_.dividend * low_.divisor); }
    double low() const { return low_.dividend / low_.divisor; }
    double high() const { return high_.dividend / high_.divisor; }

  private:
    struct Fraction {
        double dividend, divisor;
    };
    Fraction low_, high_;
};

/// first + slope x + bend x^2, x from 0 to 1.
struct Parabola {
    double first, slope, bend;

    double last() const { return first + slope + bend; }
    double last_slope() const { return slope + 2 * bend; }
    /// Its extremum, or its first value where there is none.
    double turning() const { return slope * last_slope() < 0 ? first - slope * slope / (4 * bend) : first; }
    double least() const { return std::min({first, last(), turning()}); }
    double greatest() const { return std::max({first, last(), turning()}); }
    /// The least magnitude of its slope; 0 where it has an extremum.
    double least_slope() const {
        return slope * last_slope() > 0 ? std::min(std::abs(slope), std::abs(last_slope())) : 0;
    }
    /// The value of a monotone one.
    double root() const {
        const double squared = slope * slope - 4 * bend * first;
        return -2 * first / (slope + std::copysign(std::sqrt(std::max(0.0, squared)), slope));
    }
};

/// W at all (s, t), row by row, each with the same t.
std::vector<double> inverse_heights(const MeridianSeries& series, double sign, std::span<const double> at) {
    std::vector<double> w(at.size() * at.size());
    for (std::size_t row = 0; row < at.size(); ++row) {
        const std::span values(w.data() + row * at.size(), at.size());
        series.evaluate(at, at[row], sign, values);
        for (std::size_t n = 0; n < at.size(); ++n) {
            values[n] = std::sqrt(1 + at[n] * at[n] + at[row] * at[row]) / values[n];
        }
    }
    return w;
}

template <std::size_t N>
Matrix<N> bernstein_form(const Matrix<N>& powers) {
    static const auto matrix = bernstein_matrix<N>();
    return transformed(matrix, powers);
}

/// Bounds by Bernstein's coefficients b.
template <std::size_t N>
struct Largest {
    double value = 0, along_a = 0, along_b = 0, aa = 0, ab = 0, bb = 0;

    explicit Largest(const Matrix<N>& b) {
        constexpr double n = N - 1;
        const auto include = [](double& largest, double x) { largest = std::max(largest, std::abs(x)); };
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < N; ++j) {
                const bool is_in_i = i + 1 < N, is_in_j = j + 1 < N;
                include(value, b[i][j]);
                if (is_in_i) include(along_a, n / 2 * (b[i + 1][j] - b[i][j]));
                if (is_in_j) include(along_b, n / 2 * (b[i][j + 1] - b[i][j]));
                if (is_in_i && is_in_j) {
                    include(ab, n * n / 4 * (b[i + 1][j + 1] - b[i + 1][j] - b[i][j + 1] + b[i][j]));
                }
                const double second = n * (n - 1) / 4;
                if (i + 2 < N) include(aa, second * (b[i + 2][j] - 2 * b[i + 1][j] + b[i][j]));
                if (j + 2 < N) include(bb, second * (b[i][j + 2] - 2 * b[i][j + 1] + b[i][j]));
            }
        }
    }
};

}  // namespace

HarmonicCells::HarmonicCells(const HarmonicSurface& surface, double tolerance) {
    if (!(tolerance >= 1e-11))
        throw std::invalid_argument("the tolerance of cells is not above rounding errors");
    const math::HarmonicSeries<double>& radius = surface.radius();
    const std::array series{MeridianSeries(radius, 0), MeridianSeries(radius, 1), MeridianSeries(radius, 2)};
    double on_edge = 2 + 0.15 * radius.degree();
    while (!divide(series, static_cast<std::size_t>(on_edge), tolerance)) {
        // The error falls with the power kNodes of a cell's size, once cells are small.
        const double missing = 1.03 * std::pow(error_ / tolerance, 1. / kNodes);
        on_edge = std::ceil(on_edge * std::clamp(missing, 1.0, 2.0)) + 1;
    }
    outlines_.reserve(polynomials_.size());
    for (std::size_t cell = 0; cell < polynomials_.size(); ++cell) outlines_.push_back(outline_of(cell));
}

/// Returns false where a polynomial is not accurate enough.
bool HarmonicCells::divide(const std::array<MeridianSeries, 3>& series, std::size_t on_edge,
                           double tolerance) {
    const auto edge = [&](std::size_t n) {
        const double turn = 2 * static_cast<double>(n) / static_cast<double>(on_edge) - 1;
        return std::abs(turn) == 1 ? turn : std::tan(std::numbers::pi / 4 * turn);
    };
    spans_.clear();
    for (std::size_t n = 0; n < on_edge; ++n) {
        spans_.push_back({0.5 * (edge(n) + edge(n + 1)), 0.5 * (edge(n + 1) - edge(n))});
    }
    polynomials_.clear();
    polynomials_.reserve(6 * on_edge * on_edge);
    error_ = 0;
    for (std::size_t number = 0; number < 6; ++number) {
        const CubeFace face(number);
        const std::size_t first_cell = polynomials_.size();
        fill_face(series[face.i], face.sign);
        error_ = std::max(error_, error_of_face(series[face.i], face.sign, first_cell));
        if (error_ > tolerance) return false;
    }
    return true;
}

/// Cells row by row.
void HarmonicCells::fill_face(const MeridianSeries& series, double sign) {
    static const auto nodes = lobatto_nodes<kNodes>();
    static const auto powers = power_matrix(nodes);
    constexpr std::size_t steps = kNodes - 1;
    std::vector<double> at;
    for (const Span& span : spans_) {
        for (std::size_t n = 0; n < steps; ++n) at.push_back(span.middle + span.half * nodes[n]);
    }
    at.push_back(1);
    const std::vector<double> w = inverse_heights(series, sign, at);
    for (std::size_t row = 0; row < spans_.size(); ++row) {
        for (std::size_t column = 0; column < spans_.size(); ++column) {
            const double* first = w.data() + row * steps * at.size() + column * steps;
            Polynomial values;
            for (std::size_t m = 0; m < kNodes; ++m) {
                for (std::size_t n = 0; n < kNodes; ++n) values[m][n] = first[n * at.size() + m];
            }
            polynomials_.push_back(transformed(powers, values));
        }
    }
}

double HarmonicCells::error_of_face(const MeridianSeries& series, double sign, std::size_t first_cell) const {
    std::vector<double> at;
    for (const Span& span : spans_) {
        for (const double x : kChecked) at.push_back(span.middle + span.half * x);
    }
    const std::vector<double> w = inverse_heights(series, sign, at);
    double worst = 0;
    for (std::size_t n = 0; n < w.size(); ++n) {
        const std::size_t row = n / at.size(), column = n % at.size(), parts = kChecked.size();
        const std::size_t cell = first_cell + row / parts * spans_.size() + column / parts;
        const double found =
            evaluate(polynomials_[cell], kChecked[column % parts], kChecked[row % parts]).value;
        worst = std::max(worst, found > 0 ? std::abs(w[n] / found - 1) : 1);
    }
    return worst;
}

HarmonicCells::Outline HarmonicCells::outline_of(std::size_t cell) const {
    const Polynomial& whole = polynomials_[cell];
    const std::size_t on_edge = spans_.size(), on_face = cell % (on_edge * on_edge);
    Outline outline;
    outline.face = static_cast<std::uint16_t>(cell / (on_edge * on_edge));
    outline.row = static_cast<std::uint16_t>(on_face / on_edge);
    outline.column = static_cast<std::uint16_t>(on_face % on_edge);

    const Polynomial b = bernstein_form(whole);
    double least = b[0][0], greatest = b[0][0];
    for (const auto& row : b) {
        least = std::min(least, std::ranges::min(row));
        greatest = std::max(greatest, std::ranges::max(row));
    }
    outline.low = static_cast<float>((1 - kSlack) / greatest);
    outline.high = static_cast<float>((1 + kSlack) / least);

    const Quadratic q = outline.quadratic = quadratic_part(whole);
    Polynomial rest = whole;
    rest[0][0] -= double{q[0]}, rest[1][0] -= double{q[1]}, rest[0][1] -= double{q[2]};
    rest[2][0] -= double{q[3]}, rest[1][1] -= double{q[4]}, rest[0][2] -= double{q[5]};
    const Largest<kNodes> largest(bernstein_form(rest));
    const auto bound = [&](double x) {
        return static_cast<float>((1 + kSlack) * x + kLeastSlack * greatest);
    };
    outline.rest = bound(largest.value);
    outline.rest_a = bound(largest.along_a), outline.rest_b = bound(largest.along_b);
    outline.rest_aa = bound(largest.aa), outline.rest_ab = bound(largest.ab);
    outline.rest_bb = bound(largest.bb);
    return outline;
}

/// A patch with weights b and control points (s_i, t_j, 1) / b_ij, which enclose it; enlarged by a share
/// above the overlap.
Bounds HarmonicCells::bounds_of(std::size_t number) const {
    const Outline& cell = outlines_[number];
    const Polynomial b = bernstein_form(polynomials_[number]);
    const CubeFace face(cell.face);
    const auto at = [](const Span& span, std::size_t n) {
        return span.middle + span.half * (2 * static_cast<double>(n) / (kNodes - 1) - 1);
    };
    Bounds bounds;
    for (std::size_t m = 0; m < kNodes; ++m) {
        for (std::size_t n = 0; n < kNodes; ++n) {
            const Vec3 control{at(spans_[cell.column], m), at(spans_[cell.row], n), 1};
            bounds.include(face.to_world(control / b[m][n]));
        }
    }
    const Vec3 extent = bounds.max - bounds.min;
    bounds.include(bounds.min - kMargin * extent);
    bounds.include(bounds.max + kMargin * extent);
    return bounds;
}

/// The part of a ray over a cell: a, b and w are linear in x from 0 to 1.
struct HarmonicCells::Line {
    double a, b, w;
    double da, db, dw;

    Parabola excess_of(const Quadratic& quadratic) const {
        std::array<double, 6> c{};
        std::ranges::copy(quadratic, c.begin());
        return {c[0] + (c[1] + c[3] * a + c[4] * b) * a + (c[2] + c[5] * b) * b - w,
                (c[1] + 2 * c[3] * a + c[4] * b) * da + (c[2] + c[4] * a + 2 * c[5] * b) * db - dw,
                c[3] * da * da + c[4] * da * db + c[5] * db * db};
    }
    /// The value and slope of W - w at x.
    std::pair<double, double> excess_of(const Polynomial& polynomial, double x) const {
        const ValueAndSlopes at = evaluate(polynomial, a + x * da, b + x * db);
        return {at.value - (w + x * dw), at.along_a * da + at.along_b * db - dw};
    }
};

/// x of the first root of W - w; infinite where there is none.
double HarmonicCells::root_on(const Line& line, std::size_t number) const {
    const Outline& cell = outlines_[number];
    const Parabola parabola = line.excess_of(cell.quadratic);
    const double rest = double{cell.rest}, da = std::abs(line.da), db = std::abs(line.db);
    if (parabola.least() > rest || parabola.greatest() < -rest) return kInfinity;
    const auto excess = [&](double x) { return line.excess_of(polynomials_[number], x); };
    const auto sign_at = [&](double x, double about) {
        return math::sign_of(std::abs(about) > rest ? about : excess(x).first);
    };
    const math::Sign at_start = sign_at(0, parabola.first);
    const double curvature = 2 * std::abs(parabola.bend) + double{cell.rest_aa} * da * da +
                             2 * double{cell.rest_ab} * da * db + double{cell.rest_bb} * db * db;
    if (parabola.least_slope() > double{cell.rest_a} * da + double{cell.rest_b} * db) {
        if (at_start == sign_at(1, parabola.last())) return kInfinity;
        return math::root_between(excess, curvature, 0, 1, at_start, std::clamp(parabola.root(), 0.0, 1.0));
    }
    return math::first_root(excess, curvature, kNarrowest, 0, 1, at_start).value_or(kInfinity);
}

double HarmonicCells::crossing(std::size_t number, const Vec3& origin, const Vec3& direction, double start,
                               double end) const {
    const Outline& cell = outlines_[number];
    const CubeFace face(cell.face);
    const Span s = spans_[cell.column], t = spans_[cell.row];
    const Vec3 o = face.to_local(origin), d = face.to_local(direction);
    Stretch stretch(start, end);
    const auto keep = [&](const Vec3& plane, double offset) {
        stretch.keep(dot(plane, o) + offset, dot(plane, d));
    };
    keep({0, 0, 1}, -double{cell.low});
    keep({0, 0, -1}, double{cell.high});
    keep({1, 0, s.half + kOverlap - s.middle}, 0);
    keep({-1, 0, s.half + kOverlap + s.middle}, 0);
    keep({0, 1, t.half + kOverlap - t.middle}, 0);
    keep({0, -1, t.half + kOverlap + t.middle}, 0);
    if (stretch.is_empty()) return kInfinity;
    const double low = stretch.low(), high = stretch.high();
    const Vec3 from = o + low * d, to = o + high * d;
    const double w = 1 / from.z, last_w = 1 / to.z;
    const double a = (from.x * w - s.middle) / s.half, b = (from.y * w - t.middle) / t.half;
    const double last_a = (to.x * last_w - s.middle) / s.half, last_b = (to.y * last_w - t.middle) / t.half;
    const double root = root_on({a, b, w, last_a - a, last_b - b, last_w - w}, number);
    if (root == kInfinity) return kInfinity;
    const double share = root * last_w, rest = (1 - root) * w;  // affine in 1 / x_k
    return (rest * low + share * high) / (rest + share);
}

HarmonicCells::Point HarmonicCells::point_at(std::size_t number, const Vec3& near_by) const {
    const Outline& cell = outlines_[number];
    const Span s = spans_[cell.column], t = spans_[cell.row];
    const Vec3 x = CubeFace(cell.face).to_local(near_by);
    return element_at(number, (x.x / x.z - s.middle) / s.half, (x.y / x.z - t.middle) / t.half);
}

/// z W(x / z, y / z) is 1 on the surface and more outside; its gradient g is (W_s, W_t, W - s W_s - t W_t),
/// and the area |g| / W^3 by s and t.
HarmonicCells::Element HarmonicCells::element_at(std::size_t number, double a, double b) const {
    const Outline& cell = outlines_[number];
    const CubeFace face(cell.face);
    const Span column = spans_[cell.column], row = spans_[cell.row];
    const double s = column.middle + a * column.half, t = row.middle + b * row.half;
    const ValueAndSlopes w = evaluate(polynomials_[number], a, b);
    const double along_s = w.along_a / column.half, along_t = w.along_b / row.half;
    const Vec3 outwards{along_s, along_t, w.value - s * along_s - t * along_t};
    const double size = length(outwards);
    return {{face.to_world(Vec3{s, t, 1} / w.value), face.to_world(outwards / size)},
            size / (w.value * w.value * w.value) * column.half * row.half};
}

namespace {

double area_of_cell(const HarmonicCells& cells, std::size_t cell) {
    static const math::GaussLegendre rule = math::gauss_legendre(7);
    double area = 0;
    for (std::size_t m = 0; m < rule.nodes.size(); ++m) {
        for (std::size_t n = 0; n < rule.nodes.size(); ++n) {
            area +=
                rule.weights[m] * rule.weights[n] * cells.element_at(cell, rule.nodes[m], rule.nodes[n]).area;
        }
    }
    return area;
}

}  // namespace

HarmonicArea::HarmonicArea(std::shared_ptr<const HarmonicCells> cells) : cells_(std::move(cells)) {
    std::vector<double> areas;
    for (std::size_t cell = 0; cell < cells_->count(); ++cell) areas.push_back(area_of_cell(*cells_, cell));
    by_area_ = math::DiscreteDistribution(areas);
}

HarmonicArea::Point HarmonicArea::sample(const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const HarmonicCells::Element element =
        cells_->element_at(choice.index, 2 * choice.remainder - 1, 2 * u[1] - 1);
    return {element.position, element.normal, choice.probability / (4 * element.area)};
}

}  // namespace stilb::geometry
