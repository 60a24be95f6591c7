#include "papers/estimate_series.h"

namespace stilb::papers {
namespace {

std::vector<double> collect(std::span<const statistics::Estimate> estimates,
                            double statistics::Estimate::*part) {
    std::vector<double> numbers;
    for (const statistics::Estimate& estimate : estimates) numbers.push_back(estimate.*part);
    return numbers;
}

}  // namespace

std::vector<statistics::Estimate> estimates_of(const SensorResult& result) {
    std::vector<statistics::Estimate> estimates;
    for (const Reading& reading : result.readings) estimates.push_back(reading.estimate);
    return estimates;
}

statistics::Estimate scaled(const statistics::Estimate& estimate, double factor) {
    return {factor * estimate.value, factor * estimate.standard_error, factor * estimate.lower,
            factor * estimate.upper};
}

plot::Series series_of(const std::string& name, const std::vector<double>& x,
                       std::span<const statistics::Estimate> estimates) {
    return {name, x, collect(estimates, &statistics::Estimate::value),
            collect(estimates, &statistics::Estimate::lower),
            collect(estimates, &statistics::Estimate::upper)};
}

void add_columns(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const statistics::Estimate> estimates) {
    columns.push_back({name + "_" + unit, collect(estimates, &statistics::Estimate::value)});
    columns.push_back(
        {name + "_standard_error_" + unit, collect(estimates, &statistics::Estimate::standard_error)});
    columns.push_back({name + "_lower_" + unit, collect(estimates, &statistics::Estimate::lower)});
    columns.push_back({name + "_upper_" + unit, collect(estimates, &statistics::Estimate::upper)});
}

}  // namespace stilb::papers
