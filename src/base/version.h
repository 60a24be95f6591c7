#pragma once

namespace stilb {

/// "1.2.3": of the program and of all that it writes.
const char* program_version();

}  // namespace stilb
