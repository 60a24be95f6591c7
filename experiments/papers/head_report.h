// What a study of a head found: for people, as a table, as a plot.
#pragma once

#include <string>
#include <vector>

#include "io/text/table.h"
#include "papers/head_study.h"
#include "papers/plot.h"

namespace stilb::papers {

std::string to_text(const HeadStudy& study);
/// A row for each series; docs/reproduce.md has the columns.
std::vector<io::Column> columns_of(const HeadStudy& study);
/// Errors and the ratio of bytes over degrees.
Plot plot_of(const HeadStudy& study);

}  // namespace stilb::papers
