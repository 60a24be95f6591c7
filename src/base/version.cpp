#include "base/version.h"

namespace stilb {

const char* program_version() { return STILB_VERSION; }

}  // namespace stilb
