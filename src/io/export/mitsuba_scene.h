// Sections of Mitsuba's scene.xml.
#pragma once

#include <string>

#include "io/export/parts.h"

namespace stilb::io::exporting {

/// A <bsdf> with this id. Warns where the model is not equal, or needs stilb_plugins.py.
std::string mitsuba_material(const NamedMaterial& material, const std::string& id, Output& output);

/// The <emitter> of a light that is not on a surface.
std::string mitsuba_light(const Scene& scene, const Light& light, const std::string& id, Output& output);

/// The files that add to Mitsuba what it lacks, and that measure.
extern const std::string_view kMitsubaPlugins;  ///< stilb_plugins.py
extern const std::string_view kMitsubaMeasure;  ///< measure.py

}  // namespace stilb::io::exporting
