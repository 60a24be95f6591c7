// The scenes that the methods are held together on.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb {

/// What a scene asks of a method to be measured without error or with finite variance.
enum class Demand {
    nothing,
    finite_variance,     ///< points in corners: not for methods with heavy tails
    light_from_mirrors,  ///< light of a point-like source by a mirror: only light paths find it
};

struct AgreementScene {
    std::string_view name;
    Demand demand;
    std::optional<int> bounces;
    Scene (*make)();
    std::vector<MeasuringPoint> points;
    std::vector<Measurand> sights;  ///< of luminance
    std::vector<Sensor> bodies{};   ///< cylindrical illuminance and the like
    /// A factor on the number of paths: where light is so rare that a pilot run underestimates its noise, and
    /// where two methods at two points have few chances to notice an error.
    std::uint64_t path_factor = 1;
    /// A factor on all errors that are aimed at and noticed (support/coarser.h).
    double coarser = 2;

    /// Points, sights and bodies.
    std::vector<Sensor> sensors() const;
};

std::span<const AgreementScene> agreement_scenes();

/// A scene in which fine meshes stand for bodies by harmonics.
struct MeshTwin {
    std::string_view of;  ///< name of the scene
    Scene (*make)();
    std::vector<Measurand> many_sights;
};
std::span<const MeshTwin> mesh_twins();

/// A room of 4 x 3 x 2.8 m with a point source, off its middle.
Scene closed_box();

}  // namespace stilb
