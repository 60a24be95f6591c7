// The program gensky: suns and skies of the CIE by place and time.
#pragma once

#include <string>
#include <vector>

namespace stilb::io::radiance {

/// The primitives that gensky prints, as text: the light "solar" with the source "sun", and the brightfunc
/// "skyfunc". Throws InputError, without a place, for wrong arguments.
std::string gensky(const std::vector<std::string>& arguments);

}  // namespace stilb::io::radiance
