// The scene: objects with materials, and lights. Plain values, immutable once built; see scene_file for the
// reader and RayCaster for the queries.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/rays.h"
#include "base/shared_list.h"
#include "base/vec.h"
#include "geometry/shape.h"
#include "lights/light.h"
#include "lights/opening_shape.h"
#include "materials/material.h"

namespace stilb::scene {

struct NamedMaterial {
    std::string name;
    Material material;
    std::optional<MaterialId> back = {};  ///< the material of the back, where it differs
};

struct Object {
    std::string name;
    Shape shape;
    /// One material for the whole object, or (meshes and instances) one for each triangle.
    SharedList<MaterialId> materials;
    /// The object that a lamp's faces were cut out of (cut_lamps.h).
    std::optional<ObjectId> cut_from = {};
};

/// A luminaire's distribution, and the statements of its file.
struct NamedSolid {
    std::string file;
    std::string luminaire;  ///< the name that the file gives, may be empty
    PhotometricSolid solid;
    std::string format = {};             ///< "EULUMDAT", "IES LM-63-2002"
    std::string flux_statement = {};     ///< comparison of the file's stated flux with the integral, as text
    lights::Opening opening = {};        ///< as the file states it; a point where it states none
    std::optional<double> power_w = {};  ///< electric, where the file states it
};

struct Scene {
    std::string name;
    std::vector<NamedMaterial> materials;
    std::vector<Object> objects;
    std::vector<NamedSolid> solids;
    std::vector<Light> lights;

    // Compiled once, not wherever a scene is copied or ends: each is a thousand instructions.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    const Material& material(MaterialId id) const { return materials[index_of(id)].material; }
    /// The material of a side of a surface that has this material.
    MaterialId on_side(MaterialId id, bool is_front) const {
        return is_front ? id : materials[index_of(id)].back.value_or(id);
    }
    const Object& object(ObjectId id) const { return objects[index_of(id)]; }
    const PhotometricSolid& solid(SolidId id) const { return solids[index_of(id)].solid; }
};

/// The scene as the lights' Surroundings. Keeps references.
class LightSurroundings final : public lights::Surroundings {
  public:
    explicit LightSurroundings(const Scene& scene, std::span<const lights::Entry> entries = {})
        : scene_(scene), entries_(entries) {}
    const Shape& shape(ObjectId object) const override { return scene_.object(object).shape; }
    std::string_view name(ObjectId object) const override { return scene_.object(object).name; }
    const PhotometricSolid& solid(SolidId solid) const override { return scene_.solid(solid); }
    std::string_view file(SolidId solid) const override { return scene_.solids[index_of(solid)].file; }
    Bounds bounds() const override;
    std::span<const lights::Entry> entries() const override { return entries_; }

  private:
    const Scene& scene_;
    std::span<const lights::Entry> entries_;
};

/// Bounds of all objects and point lights; a point at the origin where there are none.
Bounds bounds_of(const Scene& scene);
/// A scene of a larger half extent is large: single precision is not enough everywhere in it, and things may
/// lie far apart. Smaller ones lift points by 61 micrometres at most, wherever their centre is.
inline constexpr double kLargeHalfExtent_m = 32;
/// How points are lifted off surfaces. Single precision is best near its centre: the middle of the bounding
/// box, or in a scene of more than 64 m the median of the middles of all objects and lights, so that the
/// details of a house count, not the middle of the ground around it. `measured`: points at which light is
/// measured, if they are known; then the surfaces near to them count, and what lies beyond a gap of more than
/// 32 times the extent of lamps, measured points and what is near to them does not. `sees_fine_things`: as of
/// these points (fine_things.h); then, or with such a gap, a smaller scene is treated like one of more than
/// 64 m.
Lift lift_of(const Scene& scene, std::span<const Vec3> measured = {}, bool sees_fine_things = false);
/// The materials of an object's fronts and backs, each once.
std::set<MaterialId> materials_of(const Scene& scene, const Object& object);
bool have_backs(const Scene& scene);
/// The objects whose fronts are lamps.
std::set<ObjectId> lamps_of(const Scene& scene);
/// The place of a lamp: of a luminaire or a point, or the middle of its surface; nothing for light from
/// infinity.
std::optional<Vec3> place_of(const Scene& scene, const Light& light);
/// Flux of a light per band; luminance() of it is lumen.
Rgb flux_lm(const Scene& scene, const Light& light);
/// The lowest and the highest maintenance factor of the lamps; nothing where no lamp has one below 1.
std::optional<std::array<double, 2>> maintenance_factors(const Scene& scene);
/// The area of all objects; each surface once, though both its sides reflect.
double surface_area_m2(const Scene& scene);

}  // namespace stilb::scene

namespace stilb {
using scene::NamedMaterial;
using scene::NamedSolid;
using scene::Object;
using scene::Scene;
}  // namespace stilb
