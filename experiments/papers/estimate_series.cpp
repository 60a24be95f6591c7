#include "papers/estimate_series.h"

namespace stilb {
namespace {

std::vector<double> collect(std::span<const Estimate> estimates, double Estimate::*part) {
    std::vector<double> numbers;
    for (const Estimate& estimate : estimates) numbers.push_back(estimate.*part);
    return numbers;
}

}  // namespace

std::vector<Estimate> estimates_of(const SensorResult& result) {
    std::vector<Estimate> estimates;
    for (const Reading& reading : result.readings) estimates.push_back(reading.estimate);
    return estimates;
}

Estimate scaled(const Estimate& estimate, double factor) {
    return {factor * estimate.value, factor * estimate.standard_error, factor * estimate.lower,
            factor * estimate.upper};
}

Series series_of(const std::string& name, const std::vector<double>& x, std::span<const Estimate> estimates) {
    return {name, x, collect(estimates, &Estimate::value), collect(estimates, &Estimate::lower),
            collect(estimates, &Estimate::upper)};
}

void add_columns(std::vector<Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const Estimate> estimates) {
    columns.push_back({name + "_" + unit, collect(estimates, &Estimate::value)});
    columns.push_back({name + "_standard_error_" + unit, collect(estimates, &Estimate::standard_error)});
    columns.push_back({name + "_lower_" + unit, collect(estimates, &Estimate::lower)});
    columns.push_back({name + "_upper_" + unit, collect(estimates, &Estimate::upper)});
}

}  // namespace stilb
