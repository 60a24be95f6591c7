#include "scene/harmonic_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scene/first_root.h"

namespace stilb {
namespace {

constexpr double kNarrowest = 1e-9;
/// Cells reach a little beyond their edges, so that rounding leaves nothing between them.
constexpr double kOverlap = 1e-12;

/// The axes (i, j, k) of a face and the sign of x_k.
struct Face {
    std::size_t i, j, k;
    double sign;

    explicit Face(std::size_t number)
        : i((number / 2 + 1) % 3), j((number / 2 + 2) % 3), k(number / 2), sign(number % 2 == 0 ? 1 : -1) {}

    /// (x_i, x_j, |x_k|).
    Vec3 to_local(const Vec3& x) const { return {x[i], x[j], sign * x[k]}; }
    Vec3 to_world(const Vec3& local) const {
        std::array<double, 3> x{};
        x[i] = local.x, x[j] = local.y, x[k] = sign * local.z;
        return {x[0], x[1], x[2]};
    }
};

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

template <std::size_t N>
std::array<double, N> lobatto_nodes() {
    std::array<double, N> nodes{};
    for (std::size_t k = 0; k < N; ++k) {
        nodes[k] = -std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(N - 1));
    }
    return nodes;
}

/// From values at nodes to coefficients of powers: row p, column node, by Lagrange's polynomials multiplied
/// out.
template <std::size_t N>
Matrix<N> power_matrix(const std::array<double, N>& nodes) {
    Matrix<N> matrix{};
    for (std::size_t node = 0; node < N; ++node) {
        std::array<double, N> powers{1};
        for (std::size_t other = 0; other < N; ++other) {
            if (other == node) continue;
            const double scale = 1 / (nodes[node] - nodes[other]);
            for (std::size_t p = N; p-- > 0;) {
                powers[p] = scale * ((p > 0 ? powers[p - 1] : 0) - nodes[other] * powers[p]);
            }
        }
        for (std::size_t p = 0; p < N; ++p) matrix[p][node] = powers[p];
    }
    return matrix;
}

struct Value {
    double value = 0, along_a = 0, along_b = 0;
};

template <std::size_t N>
Value evaluate(const Matrix<N>& c, double a, double b) {
    Value sum;
    for (std::size_t p = N; p-- > 0;) {
        double row = 0, slope = 0;
        for (std::size_t q = N; q-- > 0;) {
            slope = slope * b + row;
            row = row * b + c[p][q];
        }
        sum.along_a = sum.along_a * a + sum.value;
        sum.value = sum.value * a + row;
        sum.along_b = sum.along_b * a + slope;
    }
    return sum;
}

/// The part of a ray where linear functions of the distance are not below 0.
struct Stretch {
    double low, high;

    void keep(double at_0, double slope) {
        if (slope > 0) {
            low = std::max(low, -at_0 / slope);
        } else if (slope < 0) {
            high = std::min(high, -at_0 / slope);
        } else if (at_0 < 0) {
            high = -std::numeric_limits<double>::infinity();
        }
    }
    bool is_empty() const { return !(low < high); }
};

/// w in a direction given by s and t.
double inverse_height(const HarmonicSurface& surface, const Face& face, double s, double t) {
    const double length = std::sqrt(1 + s * s + t * t);
    return length / surface.radius().at(face.to_world({s / length, t / length, 1 / length}));
}

}  // namespace

HarmonicCells::HarmonicCells(const HarmonicSurface& surface, double tolerance) {
    const int least = 2 + surface.radius().degree() / 4;
    for (auto on_edge = static_cast<std::size_t>(least); !divide(surface, on_edge, tolerance);
         on_edge += (on_edge + 3) / 4) {
    }
}

/// False where a polynomial is not good enough.
bool HarmonicCells::divide(const HarmonicSurface& surface, std::size_t cells_on_edge, double tolerance) {
    cells_.clear();
    error_ = 0;
    half_ = 1 / static_cast<double>(cells_on_edge);
    const auto middle = [&](std::size_t n) { return half_ * (2 * static_cast<double>(n) + 1) - 1; };
    for (std::size_t face = 0; face < 6; ++face) {
        for (std::size_t m = 0; m < cells_on_edge; ++m) {
            for (std::size_t n = 0; n < cells_on_edge; ++n) {
                cells_.push_back(make_cell(surface, face, middle(m), middle(n)));
                error_ = std::max(error_, error_of(surface, cells_.back()));
                if (error_ > tolerance) return false;
            }
        }
    }
    return true;
}

HarmonicCells::Cell HarmonicCells::make_cell(const HarmonicSurface& surface, std::size_t face, double s,
                                             double t) const {
    static const auto nodes = lobatto_nodes<kNodes>();
    static const auto powers = power_matrix(nodes);
    Cell cell{face, s, t, {}};
    Coefficients half_way{};  // powers of a, nodes of b
    for (std::size_t m = 0; m < kNodes; ++m) {
        for (std::size_t n = 0; n < kNodes; ++n) {
            const double w = inverse_height(surface, Face(face), s + half_ * nodes[m], t + half_ * nodes[n]);
            for (std::size_t p = 0; p < kNodes; ++p) half_way[p][n] += powers[p][m] * w;
        }
    }
    double varying = 0;
    for (std::size_t p = 0; p < kNodes; ++p) {
        for (std::size_t q = 0; q < kNodes; ++q) {
            double& c = cell.polynomial[p][q];
            for (std::size_t n = 0; n < kNodes; ++n) c += powers[q][n] * half_way[p][n];
            const double size = std::abs(c);
            if (p + q > 0) varying += size;
            cell.curvature_aa += size * static_cast<double>(p * (p - (p > 0)));
            cell.curvature_ab += size * static_cast<double>(p * q);
            cell.curvature_bb += size * static_cast<double>(q * (q - (q > 0)));
        }
    }
    const double middle = cell.polynomial[0][0];
    cell.low = 1 / (middle + varying);
    cell.high = middle > varying ? 1 / (middle - varying) : surface.greatest_radius();
    return cell;
}

double HarmonicCells::error_of(const HarmonicSurface& surface, const Cell& cell) const {
    double worst = 0;
    for (const double a : {-0.95, -0.2, 0.65}) {
        for (const double b : {-0.65, 0.2, 0.95}) {
            const double w = inverse_height(surface, Face(cell.face), cell.s + half_ * a, cell.t + half_ * b);
            worst = std::max(worst, std::abs(evaluate(cell.polynomial, a, b).value / w - 1));
        }
    }
    return worst;
}

Bounds HarmonicCells::bounds_of(std::size_t number) const {
    const Cell& cell = cells_[number];
    Bounds bounds;
    for (const double z : {cell.low, cell.high}) {
        for (const double s : {cell.s - half_, cell.s + half_}) {
            for (const double t : {cell.t - half_, cell.t + half_}) {
                bounds.include(Face(cell.face).to_world({s * z, t * z, z}));
            }
        }
    }
    return bounds;
}

std::optional<double> HarmonicCells::crossing(std::size_t number, const Vec3& origin, const Vec3& direction,
                                              double start, double end) const {
    const Cell& cell = cells_[number];
    const Vec3 o = Face(cell.face).to_local(origin), d = Face(cell.face).to_local(direction);
    Stretch stretch{start, end};
    const auto keep = [&](const Vec3& plane, double offset) {
        stretch.keep(dot(plane, o) + offset, dot(plane, d));
    };
    const double half = half_ + kOverlap;
    keep({0, 0, 1}, -cell.low);
    keep({0, 0, -1}, cell.high);
    keep({1, 0, half - cell.s}, 0);
    keep({-1, 0, half + cell.s}, 0);
    keep({0, 1, half - cell.t}, 0);
    keep({0, -1, half + cell.t}, 0);
    if (stretch.is_empty()) return std::nullopt;
    struct End {
        double distance, w, a, b;
    };
    const auto end_at = [&](double distance) {
        const Vec3 x = o + distance * d;
        return End{distance, 1 / x.z, (x.x / x.z - cell.s) / half_, (x.y / x.z - cell.t) / half_};
    };
    const End from = end_at(stretch.low), to = end_at(stretch.high);
    const double da = to.a - from.a, db = to.b - from.b, dw = to.w - from.w;
    const auto depth = [&](double x) {
        const Value at = evaluate(cell.polynomial, from.a + x * da, from.b + x * db);
        return std::pair(at.value - (from.w + x * dw), at.along_a * da + at.along_b * db - dw);
    };
    const double curvature =
        cell.curvature_aa * da * da + 2 * cell.curvature_ab * std::abs(da * db) + cell.curvature_bb * db * db;
    const auto root = first_root(depth, curvature, kNarrowest, 0, 1);
    if (!root) return std::nullopt;
    const double share = *root * to.w, rest = (1 - *root) * from.w;  // affine in 1 / x_k
    return (rest * from.distance + share * to.distance) / (rest + share);
}

/// z W(x / z, y / z) is 1 on the surface and more outside; its gradient is (W_s, W_t, W - s W_s - t W_t).
HarmonicCells::Place HarmonicCells::place_at(std::size_t number, const Vec3& near_by) const {
    const Cell& cell = cells_[number];
    const Face face(cell.face);
    const Vec3 x = face.to_local(near_by);
    const double s = x.x / x.z, t = x.y / x.z;
    const Value w = evaluate(cell.polynomial, (s - cell.s) / half_, (t - cell.t) / half_);
    const double along_s = w.along_a / half_, along_t = w.along_b / half_;
    const Vec3 outwards{along_s, along_t, w.value - s * along_s - t * along_t};
    return {face.to_world(Vec3{s, t, 1} / w.value), normalized(face.to_world(outwards))};
}

}  // namespace stilb
