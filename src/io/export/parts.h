// The parts of an export that do not depend on the other program.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/export/export.h"
#include "io/text/grouped_warnings.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::io::exporting {

/// The folder that is written, and what was found on the way.
class Output {
  public:
    explicit Output(std::filesystem::path folder) : folder_(std::move(folder)) {}
    void write(const std::string& name, std::string_view content);
    /// Things of one kind ("material", "light") with the same message share one warning.
    void warn(std::string_view kind, std::string_view name, std::string_view message) {
        warnings_.add(kind, name, message);
    }
    ExportReport report() const { return {files_, warnings_.list()}; }

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    GroupedWarnings warnings_;
};

/// Identifiers of letters, digits, "_" and "-" that are different from each other.
class Identifiers {
  public:
    std::string make(std::string_view name);

  private:
    std::set<std::string> used_;
};

/// A surface of one material: box, harmonics and meshes of several materials are divided into such.
struct Surface {
    std::string name;  ///< an identifier
    std::variant<Mesh, Rectangle, Sphere, Disk> shape;
    MaterialId material{};
    std::optional<Rgb> luminance_cd_m2;  ///< of its front
};

/// The surfaces of all objects. Openings of luminaires are left out, as they are written with their lights.
std::vector<Surface> surfaces_of(const Scene& scene, Identifiers& identifiers, Output& output);

/// The intensity of a solid by C plane and gamma, in Radiance's format of data files: every 2.5 degrees of C,
/// from 0 to 360, and every degree of gamma.
std::string photometric_table(const PhotometricSolid& solid);
/// The same of any function of a unit direction in the luminaire's frame.
std::string photometric_table(const std::function<double(const Vec3&)>& of_direction);

/// A file NAME.pts of each sensor that measures illuminances at points ("x y z nx ny nz", a line each) or
/// luminances along lines of sight ("x y z dx dy dz"); warns of all other sensors except cameras.
void write_points(const std::vector<Sensor>& sensors, Output& output);

/// The warning about a thing of a type that the other program lacks. `instead`: what is written.
std::string no_equal(std::string_view type, std::string_view program, std::string_view instead);

/// Three numbers with blanks between them, with as many digits as single precision needs.
std::string text_of(const Vec3& vector);
std::string text_of(const Rgb& rgb);

// The other programs.

void write_mitsuba(const SceneFile& file, Output& output);
void write_radiance(const SceneFile& file, Output& output);

}  // namespace stilb::io::exporting
