#include "statistics/replicate_moments.h"

#include <cmath>
#include <stdexcept>

namespace stilb::statistics {

ReplicateMoments compute_replicate_moments(const ReplicateTable& table) {
    const std::size_t replicates = table.replicates();
    if (replicates < 2 || table.means.size() != replicates * table.readings) {
        throw std::invalid_argument("an interval takes at least two replicates of every reading");
    }
    // Measured from the first replicate, so that equal replicates have exactly their mean and an error of
    // exactly 0.
    const std::span<const double> origin = table.row(0);
    std::vector<double> means(table.readings, 0.0);
    for (std::size_t r = 1; r < replicates; ++r) {
        const std::span<const double> row = table.row(r);
        for (std::size_t j = 0; j < means.size(); ++j) means[j] += row[j] - origin[j];
    }
    for (std::size_t j = 0; j < means.size(); ++j) {
        means[j] = origin[j] + means[j] / static_cast<double>(replicates);
    }
    const std::vector<double> slopes(table.readings, 0.0), common(replicates, 0.0);
    std::vector<double> errors = residual_standard_errors(table, means, slopes, common);
    return {std::move(means), std::move(errors)};
}

std::vector<double> residual_standard_errors(const ReplicateTable& table, std::span<const double> means,
                                             std::span<const double> slopes, std::span<const double> common) {
    std::vector<double> errors(table.readings, 0.0);
    for (std::size_t r = 0; r < table.replicates(); ++r) {
        const std::span<const double> row = table.row(r);
        const double shift = common[r];
        for (std::size_t j = 0; j < errors.size(); ++j) {
            const double residual = row[j] - means[j] - slopes[j] * shift;
            errors[j] += residual * residual;
        }
    }
    const double replicates = static_cast<double>(table.replicates());
    for (double& error : errors) error = std::sqrt(error / (replicates * (replicates - 1)));
    return errors;
}

}  // namespace stilb::statistics
