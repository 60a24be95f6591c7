// The numbers in the cells of a false-colour picture: their size, and the columns and rows that have them.
#pragma once

#include <string>
#include <vector>

#include "plot/canvas.h"
#include "plot/false_colour.h"
#include "plot/false_colour_layout.h"
#include "plot/false_colour_painter.h"

namespace stilb::plot {

class CellNumbers {
  public:
    /// Numbers with three digits of the panel's largest value, errors with two of their median.
    explicit CellNumbers(const FalseColourPanel& panel);

    /// The least cell into which every number fits in a size that is easily read.
    CellSize comfortable_cell() const;
    /// Every number, or those of every n-th column and row where cells are too small for all: as few as
    /// possible are left out.
    void fit_into(const CellSize& cell);
    /// What is left out, such as "numbers of every 2nd column and 3rd row"; empty where nothing is.
    std::string note() const;
    /// The numbers of cells with a value.
    std::vector<CellNumber> place(const PageRectangle& frame) const;

  private:
    std::vector<std::string> lines_of(std::size_t cell) const;

    const FalseColourPanel& panel_;
    int decimals_ = 0, error_decimals_ = 0;
    double width_ = 0, height_ = 0;  ///< of the largest number at size 1
    double size_ = 0;
    int every_u_ = 1, every_v_ = 1;
};

}  // namespace stilb::plot
