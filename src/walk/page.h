// The page of `stilb view`, built from web/ and embedded in the program.
#pragma once

#include <string_view>

namespace stilb::walk {

struct PageFiles {
    std::string_view html, script, style;
};

PageFiles page_files();

}  // namespace stilb::walk
