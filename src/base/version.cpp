#include "base/version.h"

#include "stilb/version.h"

namespace stilb {

const char* program_version() { return STILB_VERSION; }

}  // namespace stilb
