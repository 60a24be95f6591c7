// Where the sources of this build are: for tests that read documents and data.
#pragma once

#include <filesystem>

namespace stilb {

std::filesystem::path source_directory();

}  // namespace stilb
