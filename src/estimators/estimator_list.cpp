#include "estimators/estimator_list.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "base/error.h"
#include "estimators/local_estimation.h"
#include "estimators/path.h"

namespace stilb {

std::span<const EstimatorEntry> estimator_list() {
    static constexpr std::array list{
        EstimatorEntry{
            "auto", "local estimation and path tracing, balanced at every point: unbiased, finite variance",
            false, true, make_auto_estimator},
        EstimatorEntry{"local", "local estimation as published: fast, but of infinite variance in corners",
                       true, false, make_local_estimator},
        EstimatorEntry{"double-local",
                       "the same for luminance, of the surfaces that are seen; no light that leaves a point "
                       "source, meets mirror or glass first and comes to them by mirror or glass",
                       true, true, make_local_estimator},
        EstimatorEntry{"path",
                       "path tracing from every point with next-event estimation: the naive reference", false,
                       true, make_path_estimator},
    };
    return list;
}

const EstimatorEntry& find_estimator(std::string_view name) {
    std::vector<std::string_view> names;
    for (const EstimatorEntry& entry : estimator_list()) {
        if (entry.name == name) return entry;
        names.push_back(entry.name);
    }
    const std::string nearest = nearest_name(name, names);
    throw InputError(fmt::format("unknown method \"{}\".{} Methods: {}.", name,
                                 nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest),
                                 fmt::join(names, ", ")));
}

}  // namespace stilb
