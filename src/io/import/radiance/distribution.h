// The radiance of a lamp by direction: tables of brightdata as ies2rad makes them, and cones of spotlights.
#pragma once

#include <optional>
#include <vector>

#include "io/import/radiance/description.h"
#include "io/import/radiance/optics.h"
#include "io/text/grouped_warnings.h"
#include "lights/luminaire.h"
#include "lights/photometric_solid.h"

namespace stilb::io::radiance {

/// Values over one or two coordinates, each in order.
struct Table {
    std::vector<std::vector<double>> coordinates;
    std::vector<double> values;  ///< the last coordinate fastest

    /// Linear in all coordinates; 0 outside of the table.
    double at(const std::vector<double>& point) const;
};
/// A data file of Radiance. Throws InputError with file and line.
Table read_table(std::string_view content, const std::string& name);

/// One brightdata.
class Pattern {
  public:
    /// The correction of the table for the shape of the lamp.
    enum class Correction { none, flat, box, cylinder };

    /// Nothing, with a warning, where its functions are others than those of source.cal.
    static std::optional<Pattern> read(const Modifier& modifier, const Description& description,
                                       GroupedWarnings& warnings,
                                       std::vector<std::filesystem::path>& sources);

    Correction correction() const { return correction_; }
    /// The factor of the radiance for light that leaves the lamp along a unit vector. For a flat lamp,
    /// without the division by the cosine.
    double factor(const Vec3& leaving) const;
    /// The axes of its coordinates in the scene, as those of a luminaire.
    lights::LuminaireFrame frame() const;
    /// The C planes [degrees] where its table has a bend: from 0 to 360; {0} where all are alike. Empty where
    /// its coordinates are others than angles about the vertical.
    std::vector<double> planes_deg() const;
    /// The angles to the nadir where the table has a bend.
    const std::vector<double>& polar_deg() const { return table_.coordinates.back(); }

  private:
    class Reader;
    enum class Angle { theta, phi, phi2, phi4, vertical, vertical2, horizontal, horizontal2 };
    struct Coordinate {
        Angle angle{};
        double offset = 0;
    };
    static std::optional<Coordinate> coordinate_of(std::string_view text);
    static double angle_deg(Angle angle, const Vec3& leaving);

    Table table_;
    std::vector<Coordinate> coordinates_;
    Correction correction_ = Correction::none;
    double multiplier_ = 1;
    Vec3 size_;  ///< of a box; the diameter and the height of a cylinder
    Frame axes_;
};

/// The distribution of a lamp with patterns or a cone.
struct Emission {
    lights::LuminaireFrame frame;
    PhotometricSolid::Grid grid;  ///< of intensities for a radiance of 1 [lm/(sr m2)] before the patterns
};
/// Nothing where the lamp is dark. `shape`: its surface.
std::optional<Emission> emission_of(const Shape& shape, const std::vector<Pattern>& patterns,
                                    const std::optional<Cone>& cone);

}  // namespace stilb::io::radiance
