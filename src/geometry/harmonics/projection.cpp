#include "geometry/harmonics/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace stilb::geometry {
namespace {

/// Y_lm at phi = 0; for m < 0 the value of the cosine term: the factor that depends on z.
std::vector<double> legendre_parts(double z, int degree) {
    std::vector<double> parts(math::harmonic_count(degree));
    math::evaluate_harmonics({std::sqrt(1 - z * z), 0, z}, degree, parts);
    for (int l = 1; l <= degree; ++l) {
        for (int m = 1; m <= l; ++m) parts[math::harmonic_number(l, -m)] = parts[math::harmonic_number(l, m)];
    }
    return parts;
}

/// The factor that depends on phi, on the azimuths of a grid: a row for each m from -degree to degree, cos(m
/// phi) or sin(|m| phi).
class PhiParts {
  public:
    PhiParts(const ParallelGrid& grid, int degree) : degree_(degree), azimuths_(grid.azimuths) {
        for (int m = -degree; m <= degree; ++m) {
            for (std::size_t k = 0; k < azimuths_; ++k) {
                const double angle = std::abs(m) * grid.phi(k);
                parts_.push_back(m < 0 ? std::sin(angle) : std::cos(angle));
            }
        }
    }
    std::span<const double> of(int m) const {
        return {parts_.data() + static_cast<std::size_t>(m + degree_) * azimuths_, azimuths_};
    }

  private:
    int degree_;
    std::size_t azimuths_;
    std::vector<double> parts_;
};

double inner_product(std::span<const double> a, std::span<const double> b) {
    std::array<double, 4> sums{};
    std::size_t i = 0;
    for (; i + 4 <= a.size(); i += 4) {
        for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += a[i + lane] * b[i + lane];
    }
    for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The mean of the known neighbouring values; none where there are none.
std::optional<double> mean_of_neighbours(const ParallelGrid& grid, std::span<const double> values,
                                         std::size_t index) {
    const std::size_t n = grid.azimuths, parallel = index / n, k = index % n;
    std::array<std::size_t, 4> neighbours{parallel * n + (k + 1) % n, parallel * n + (k + n - 1) % n, index,
                                          index};
    if (parallel > 0) neighbours[2] = index - n;
    if (parallel + 1 < grid.parallels()) neighbours[3] = index + n;
    double sum = 0;
    int count = 0;
    for (const std::size_t neighbour : neighbours) {
        if (!std::isnan(values[neighbour])) sum += values[neighbour], ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

}  // namespace

std::vector<double> project(const ParallelGrid& grid, std::span<const double> values, int degree) {
    const PhiParts phi_parts(grid, degree);
    std::vector<double> coefficients(math::harmonic_count(degree));
    for (std::size_t parallel = 0; parallel < grid.parallels(); ++parallel) {
        const auto own = values.subspan(parallel * grid.azimuths, grid.azimuths);
        const std::vector<double> legendre = legendre_parts(grid.z[parallel], degree);
        for (int m = -degree; m <= degree; ++m) {
            const double sum = grid.weights_sr[parallel] * inner_product(own, phi_parts.of(m));
            for (int l = std::abs(m); l <= degree; ++l) {
                coefficients[math::harmonic_number(l, m)] += legendre[math::harmonic_number(l, m)] * sum;
            }
        }
    }
    return coefficients;
}

std::vector<DegreeError> errors_by_degree(const ParallelGrid& grid, std::span<const double> values,
                                          std::span<const double> coefficients) {
    const int degree = math::HarmonicSeries<double>(coefficients).degree();
    const PhiParts phi_parts(grid, degree);
    std::vector<DegreeError> errors(static_cast<std::size_t>(degree) + 1);
    double all_weights = 0;
    for (std::size_t parallel = 0; parallel < grid.parallels(); ++parallel) {
        const double weight = grid.weights_sr[parallel];
        const std::vector<double> legendre = legendre_parts(grid.z[parallel], degree);
        const auto own = values.subspan(parallel * grid.azimuths, grid.azimuths);
        std::vector<double> rest(own.begin(), own.end());
        for (const double value : rest) all_weights += std::isnan(value) ? 0 : weight;
        for (int l = 0; l <= degree; ++l) {
            for (int m = -l; m <= l; ++m) {
                const std::size_t number = math::harmonic_number(l, m);
                const double factor = coefficients[number] * legendre[number];
                const auto part = phi_parts.of(m);
                for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= factor * part[k];
            }
            DegreeError& error = errors[static_cast<std::size_t>(l)];
            for (const double off : rest) {
                if (std::isnan(off)) continue;
                error.rms += weight * off * off;
                error.maximum = std::max(error.maximum, std::abs(off));
            }
        }
    }
    for (DegreeError& error : errors) error.rms = std::sqrt(error.rms / all_weights);
    return errors;
}

void fill_holes(const ParallelGrid& grid, std::span<double> values) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) open.push_back(i);
    }
    if (open.size() == values.size()) throw std::invalid_argument("the function has no value at all");
    while (!open.empty()) {
        std::vector<std::size_t> still_open;
        std::vector<std::pair<std::size_t, double>> filled;
        for (const std::size_t index : open) {
            const auto mean = mean_of_neighbours(grid, values, index);
            if (mean)
                filled.emplace_back(index, *mean);
            else
                still_open.push_back(index);
        }
        for (const auto& [index, mean] : filled) values[index] = mean;
        open = std::move(still_open);
    }
}

}  // namespace stilb::geometry
