#include "cli/patch_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "estimators/estimator_list.h"

namespace stilb {
namespace {

constexpr std::array<std::string_view, 3> kWindowNames{"cube", "hemicube", "tetrahedron"};

/// The value of `flag`, by its place among the names.
template <typename Enum>
void read(const char* flag, const std::optional<std::string>& typed, std::span<const std::string_view> names,
          Enum& value) {
    if (!typed) return;
    const auto found = std::ranges::find(names, *typed);
    if (found == names.end()) {
        const std::string nearest = nearest_name(*typed, names);
        throw InputError(fmt::format("{} {}: there is no such value.{} Allowed: {}.", flag, *typed,
                                     nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest),
                                     fmt::join(names, ", ")));
    }
    value = static_cast<Enum>(found - names.begin());
}

}  // namespace

void PatchFlags::add_to(CLI::App& command) {
    const std::string group = "Methods that light patches (ray-bundle)";
    const auto add = [&](const char* name, auto& value, const std::string& text, const char* type) {
        command.add_option(name, value, text)->type_name(type)->group(group);
    };
    add("--patch", patch_m, "Longest edge of a patch [m] (default: about 10,000 patches)", "SIZE");
    add("--first-shot", first_shot,
        "What stands for small lights: auto, none, classical, diffuse, incoming, on-the-fly (default: auto, "
        "which is incoming)",
        "NAME");
    add("--window", window, "Item buffers on area lights: hemicube (default) or tetrahedron", "NAME");
    add("--resolution", resolution, "Pixels along an edge of item buffers (default: by the patches)", "R");
    add("--visibility", visibility, "Who finds what patches see: rays (default) or opengl", "NAME");
    add("--directions", directions, "Bundles of a step: single, pair or frame (default)", "NAME");
}

bool PatchFlags::are_given() const {
    return patch_m || first_shot || window || visibility || directions || resolution;
}

PatchOptions PatchFlags::options_for(const std::string& method) const {
    if (are_given() && !find_estimator(method).lights_patches) {
        throw InputError(
            fmt::format("--patch, --first-shot, --window, --resolution, --visibility and --directions are "
                        "for methods that "
                        "light patches, and {} has none. Use --method ray-bundle.",
                        method));
    }
    PatchOptions options;
    options.patch_m = patch_m;
    if (first_shot != "auto") read("--first-shot", first_shot, kFirstShotNames, options.first_shot.variant);
    read("--window", window, kWindowNames, options.first_shot.shooting.window);
    read("--visibility", visibility, kBufferBackendNames, options.first_shot.shooting.backend);
    read("--directions", directions, kBundleDirectionsNames, options.directions);
    options.resolution = resolution;
    return options;
}

}  // namespace stilb
