#include "support/source_directory.h"

namespace stilb {

std::filesystem::path source_directory() { return STILB_SOURCE_DIR; }

}  // namespace stilb
