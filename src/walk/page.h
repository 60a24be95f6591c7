// The page of `stilb view`, built from web/ and part of the program (cmake/page.cmake).
#pragma once

#include <string_view>

namespace stilb::walk {

/// `html` refers to page.js and page.css by relative names, each in one tag that stands alone on its line:
/// <script type="module" src="./page.js"></script> and <link rel="stylesheet" href="./page.css">.
struct PageFiles {
    std::string_view html, script, style;
};

PageFiles page_files();

}  // namespace stilb::walk
