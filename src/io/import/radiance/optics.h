// Materials and lamps of a Radiance scene, from its modifiers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "io/import/radiance/description.h"
#include "io/import/radiance/sky_pattern.h"
#include "io/text/grouped_warnings.h"
#include "materials/black.h"
#include "materials/material.h"

namespace stilb::io::radiance {

/// A spotlight emits within a cone only.
struct Cone {
    Vec3 axis;  ///< unit
    double half_angle_deg = 180;
};

struct Lamp {
    Rgb radiance_w_sr_m2;
    std::optional<Cone> cone;
    std::vector<std::size_t> patterns;  ///< of type brightdata, indices into Description::modifiers
    std::vector<SkyPattern> skies;      ///< of type brightfunc, for sources
};

/// The meaning of a modifier for the surfaces that it modifies.
struct Optics {
    enum class Kind { surface, lamp, invisible };
    Kind kind = Kind::invisible;
    std::size_t definition = 0;  ///< of the material, an index into Description::modifiers
    std::string name = {};
    Material material = Black{};  ///< of a surface
    Lamp lamp = {};
    /// Whether the front matters: the material is glass, which has an inside.
    bool is_solid = false;
};

class OpticsReader {
  public:
    /// Keeps references.
    OpticsReader(const Description& description, GroupedWarnings& warnings)
        : description_(description), warnings_(warnings), known_(description.modifiers.size()) {}

    /// Throws InputError with file and line where arguments of the modifier are wrong.
    const Optics& of(std::size_t modifier);

  private:
    Optics read(std::size_t modifier);
    Optics read_material(std::size_t material, const std::vector<std::size_t>& patterns);
    std::optional<std::size_t> foreground(std::size_t mixture) const;
    std::optional<std::size_t> latest_before(std::size_t index, const std::string& name) const;
    void note_patterns(const std::vector<std::size_t>& patterns, Optics& optics);

    const Description& description_;
    GroupedWarnings& warnings_;
    std::vector<std::optional<Optics>> known_;
};

}  // namespace stilb::io::radiance
