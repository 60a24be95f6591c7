// The style sheet of reports.
#pragma once

#include <string_view>

namespace stilb::report {

/// Made by cmake/report.cmake from report.css.
extern const std::string_view kStyle;

}  // namespace stilb::report
