// The verification cases by the exact solutions that they are of.
#pragma once

#include <vector>

#include "verification/verification_cases.h"

namespace stilb::verification {

std::vector<VerificationCase> sobolev_cases();
std::vector<VerificationCase> sphere_cases();
std::vector<VerificationCase> furnace_cases();
/// Elements lit by single sources.
std::vector<VerificationCase> source_cases();
/// Single sources that are looked at, straight, in a mirror and through a pane.
std::vector<VerificationCase> seen_source_cases();
/// Elements and things in light from infinity.
std::vector<VerificationCase> environment_cases();

}  // namespace stilb::verification
