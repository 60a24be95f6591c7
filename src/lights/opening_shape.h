// The surface of a luminaire's luminous opening.
#pragma once

#include <optional>

#include "geometry/shape.h"
#include "lights/luminaire.h"

namespace stilb::lights {

/// The luminous opening as luminaire files state it.
struct Opening {
    enum class Form { box, vertical_cylinder, cylinder_along_c0, cylinder_along_c90, ball };
    Form form = Form::box;
    Vec3 extent_m;  ///< along C0-C180, along C90-C270, along the vertical; each at least 0

    bool is_point() const { return extent_m.x <= 0 && extent_m.y <= 0 && extent_m.z <= 0; }
    /// Whether it is no more than a rectangle or a disk.
    bool is_flat() const {
        return !is_point() && !(extent_m.z > 0) && (form == Form::box || form == Form::vertical_cylinder);
    }
    /// From the three numbers of LM-63-2002, where signs mean round outlines.
    static Opening of_signed(const Vec3& signed_extent_m);
};

/// Openings whose largest extent is below or above these were most likely stated in another unit.
inline constexpr double kSmallestOpening_m = 0.005, kLargestOpening_m = 10;

/// The surface of an opening in the middle of which the luminaire is.
struct OpeningShape {
    Shape shape;
    /// The share of the luminaire's flux whose directions see nothing of the surface: less than
    /// kMostHiddenShare.
    double hidden_share = 0;
};
/// A flat opening that sends all but this share of its flux to one side is one-sided, else a thin plate of
/// two faces, the upper one in the plane of the luminaire.
inline constexpr double kMostHiddenShare = 1e-3;

/// How far a luminaire's body reaches beyond the plane of its opening: along the nadir, and against it.
struct BodyExtent {
    double below_m = 0, above_m = 0;
};

/// Ellipses have 16 corners and their right area, those of tubes their right perimeter, and ellipsoids become
/// balls of the same volume. Lines get a hundredth of their length as width. The opening must not be a point.
/// Faces of a flat opening are moved out of the body, so that it hides nothing of them; other openings are
/// not.
OpeningShape shape_of(const Opening& opening, const Luminaire& luminaire, const PhotometricSolid& solid,
                      const BodyExtent& body = {});

}  // namespace stilb::lights
