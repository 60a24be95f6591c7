// The version of the library. CMakeLists.txt and pyproject.toml read it here.
#pragma once

#define STILB_VERSION_MAJOR 0
#define STILB_VERSION_MINOR 2
#define STILB_VERSION_PATCH 0

#define STILB_TEXT_OF_(number) #number
#define STILB_TEXT_OF(number) STILB_TEXT_OF_(number)
/// "0.2.0".
#define STILB_VERSION                  \
    STILB_TEXT_OF(STILB_VERSION_MAJOR) \
    "." STILB_TEXT_OF(STILB_VERSION_MINOR) "." STILB_TEXT_OF(STILB_VERSION_PATCH)
