// The user's browser.
#pragma once

#include <string>

namespace stilb::cli {

/// Whether the name of a file is that of a page: .html or .htm.
bool is_page(const std::string& name);

/// Opens the address by xdg-open, in a process of its own, without a shell and without waiting. Does nothing
/// where there is no display or no such program.
void open_browser(const std::string& address);

}  // namespace stilb::cli
