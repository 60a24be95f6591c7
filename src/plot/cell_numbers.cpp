#include "plot/cell_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/axis.h"

namespace stilb::plot {
namespace {

constexpr double kLeastSize = 6.5, kComfortableSize = 8, kMostSize = 13;
/// The shares of a cell's width and height that numbers may take.
constexpr double kWidthShare = 0.7, kHeightShare = 0.55;

double largest_of(const std::vector<double>& values) {
    double largest = 0;
    for (const double value : values) {
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
    return largest;
}

/// The median of those above 0; 0 where there are none.
double median_of(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !(value > 0 && std::isfinite(value)); });
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::string ordinal(int number) {
    const int last = number % 10;
    const bool is_teen = number / 10 % 10 == 1;
    const char* ending = is_teen || last == 0 || last > 3 ? "th" : last == 1 ? "st" : last == 2 ? "nd" : "rd";
    return fmt::format("{}{}", number, ending);
}

}  // namespace

CellNumbers::CellNumbers(const FalseColourPanel& panel)
    : panel_(panel),
      decimals_(three_digit_decimals(largest_of(panel.values))),
      error_decimals_(std::clamp(three_digit_decimals(median_of(panel.errors)) - 1, 0, decimals_ + 2)) {
    constexpr double kMeasured = 10;
    for (std::size_t cell = 0; cell < panel.values.size(); ++cell) {
        const CellNumber number{{}, panel.values[cell], lines_of(cell), kMeasured};
        if (number.lines.empty()) continue;
        const PageRectangle size = text_box(number);
        width_ = std::max(width_, size.width / kMeasured);
        height_ = std::max(height_, size.height / kMeasured);
    }
}

std::vector<std::string> CellNumbers::lines_of(std::size_t cell) const {
    if (std::isnan(panel_.values[cell])) return {};
    std::vector<std::string> lines{number_text(panel_.values[cell], decimals_)};
    if (!panel_.errors.empty() && std::isfinite(panel_.errors[cell]))
        lines.push_back("±" + number_text(panel_.errors[cell], error_decimals_));
    return lines;
}

CellSize CellNumbers::comfortable_cell() const {
    return {kComfortableSize * width_ / kWidthShare, kComfortableSize * height_ / kHeightShare};
}

void CellNumbers::fit_into(const CellSize& cell) {
    if (width_ == 0) return;
    const auto every = [](double needed, double pitch, int count) {
        return std::clamp(static_cast<int>(std::ceil(needed / pitch)), 1, count);
    };
    every_u_ = every(kLeastSize * width_ / kWidthShare, cell.width, panel_.nu);
    every_v_ = every(kLeastSize * height_ / kHeightShare, cell.height, panel_.nv);
    size_ = std::clamp(std::min(kWidthShare * every_u_ * cell.width / width_,
                                kHeightShare * every_v_ * cell.height / height_),
                       kLeastSize, kMostSize);
}

std::string CellNumbers::note() const {
    std::vector<std::string> parts;
    if (every_u_ == every_v_ && every_u_ > 1)
        return fmt::format("numbers of every {} column and row", ordinal(every_u_));
    if (every_u_ > 1) parts.push_back(fmt::format("{} column", ordinal(every_u_)));
    if (every_v_ > 1) parts.push_back(fmt::format("{} row", ordinal(every_v_)));
    if (parts.empty()) return "";
    return fmt::format("numbers of every {}", fmt::join(parts, " and "));
}

std::vector<CellNumber> CellNumbers::place(const PageRectangle& frame) const {
    std::vector<CellNumber> numbers;
    if (size_ == 0) return numbers;
    // In the middles of their parts; a part at the end that is too short has none.
    for (int v = (every_v_ - 1) / 2; v + every_v_ / 2 < panel_.nv; v += every_v_) {
        for (int u = (every_u_ - 1) / 2; u + every_u_ / 2 < panel_.nu; u += every_u_) {
            const std::size_t cell = panel_.index_of(u, v);
            std::vector<std::string> lines = lines_of(cell);
            if (!lines.empty())
                numbers.push_back(
                    {cell_in(frame, panel_, u, v).center(), panel_.values[cell], std::move(lines), size_});
        }
    }
    return numbers;
}

}  // namespace stilb::plot
