#include "verification/verification_cases.h"

#include <iterator>

#include "verification/case_families.h"

namespace stilb::verification {

bool VerificationCase::is_for(const estimators::EstimatorEntry& method) const {
    if (!only_method.empty()) return method.name == only_method;
    // At points double-local is local.
    return measures_luminance() ? method.measures_luminance() : method.name != "double-local";
}

std::vector<VerificationCase> verification_cases() {
    std::vector<VerificationCase> all;
    for (const auto family :
         {sobolev_cases, sphere_cases, furnace_cases, source_cases, seen_source_cases, environment_cases}) {
        std::vector<VerificationCase> cases = family();
        all.insert(all.end(), std::make_move_iterator(cases.begin()), std::make_move_iterator(cases.end()));
    }
    return all;
}

}  // namespace stilb::verification
