// The common part of the readers of scenes of other formats: names, lamps that are faces of meshes, and the
// checks at the end.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/warning.h"
#include "io/import/import_settings.h"
#include "io/import/textures/textured_surfaces.h"
#include "io/scene/scene_file.h"
#include "io/text/grouped_warnings.h"

namespace stilb::io {

/// Names of one section of a scene, different from each other and without characters that file names cannot
/// have.
class UniqueNames {
  public:
    /// The name, or `otherwise` where it is empty; with a number where it is taken.
    std::string make(std::string_view name, std::string_view otherwise);

  private:
    std::set<std::string> used_;
    std::map<std::string, int> last_number_;  ///< of each name that was wanted, for its next
};

/// The light of a material's faces.
struct Emission {
    Rgb luminance_cd_m2;
    bool both_sides = false;  ///< else the front alone
};

/// A mesh with a material for each triangle.
struct ImportedMesh {
    Mesh mesh;
    std::vector<MaterialId> materials;
    /// For each triangle, its place in the texture of its material (SceneTextures); empty where there are
    /// none.
    std::vector<FacePlace> places = {};
};

/// A mesh of several objects.
struct SharedMesh {
    std::shared_ptr<const Mesh> mesh;
    SharedList<MaterialId> materials;

    explicit SharedMesh(ImportedMesh imported);
};

class ImportedScene {
  public:
    explicit ImportedScene(const std::filesystem::path& path);

    SceneFile file;
    GroupedWarnings warnings;

    /// Says among the notes that the texture of a material counts by its mean.
    void remark_mean_texture(std::string_view material);
    /// Adds a sentence about the scene as a whole to its warnings.
    void note(std::string_view sentence, WarningKind kind = WarningKind::file);
    MaterialId add_material(std::string_view name, const Material& material);
    /// Makes all faces of a material shine.
    void set_emission(MaterialId material, const Emission& emission) { emissions_[material] = emission; }
    /// Shows the texture on the faces of a material that have a place in it.
    void set_texture(MaterialId material, FaceTexture texture);
    void add_object(std::string_view name, ImportedMesh imported);
    ObjectId add_object(std::string_view name, Shape shape, SharedList<MaterialId> materials);
    void add_instance(std::string_view name, const SharedMesh& shared, const geometry::Transform& to_world);
    void add_light(std::string_view name, lights::LightSource source, std::string_view group = {});
    void add_sensor(std::string_view name, sensors::SensorKind kind);

    /// Does what formats of modellers need: faces with textures become small faces, shining faces become
    /// lights, and glass gets the media of its two sides. Warns of unlikely sizes and units. Throws
    /// InputError where there is no surface.
    void settle_faces(const ImportSettings& settings);
    /// The scene, with all light scaled and the settings applied.
    SceneFile finish(const ImportSettings& settings) &&;

  private:
    void light_faces(ObjectId object);
    void light_triangles(ObjectId object, MaterialId material, std::vector<std::uint32_t> triangles,
                         const Emission& emission);
    void warn_of_units(double light_scale);
    /// To metres, from the file's unit of length.
    void scale_colours_of_glass(double scale);

    std::map<MaterialId, Emission> emissions_;
    SceneTextures textures_;
    GroupedWarnings remarks_;
    UniqueNames materials_, objects_, lights_, sensors_;
};

/// Leaves out the normals of a mesh whose triangles all have their own: it is not meant to look smooth.
void drop_flat_normals(Mesh& mesh);

}  // namespace stilb::io
