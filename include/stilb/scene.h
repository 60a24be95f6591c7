// Scenes: read from a file, or built in code with the same keys and the same messages.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "stilb/parameters.h"

namespace stilb::api {

/// Rooms, objects, lights and sensors. Immutable; copies share what they hold.
class Scene {
  public:
    /// Reads a scene file. Throws InputError, which names file, line, key, what was found and what is
    /// allowed.
    static Scene load(const std::filesystem::path& path);
    /// The same of a text; paths in it start from `directory`.
    static Scene parse(std::string_view toml, const std::filesystem::path& directory = ".");

    std::string name() const;
    /// In the order of the scene.
    std::vector<std::string> sensor_names() const;
    /// What is odd but not wrong, as `stilb info` prints it: normals that were not unit vectors, holes,
    /// overlaps, objects that no light reaches, sensors and lights on the wrong side of a wall. Casts rays,
    /// which takes a moment in large scenes.
    std::vector<std::string> warnings() const;

    struct Implementation;
    explicit Scene(std::shared_ptr<const Implementation> implementation);
    const Implementation& implementation() const { return *implementation_; }

  private:
    std::shared_ptr<const Implementation> implementation_;
};

/// Collects what a scene consists of. Names are those that results and messages use.
class SceneBuilder {
  public:
    explicit SceneBuilder(std::string name = "");
    ~SceneBuilder();
    SceneBuilder(const SceneBuilder&) = delete;
    SceneBuilder& operator=(const SceneBuilder&) = delete;

    /// {{"type", "diffuse"}, {"reflectance", 0.6}}
    SceneBuilder& material(const std::string& name, Parameters parameters);
    /// {{"shape", "box"}, {"min", {0, 0, 0}}, {"max", {4, 3, 2.5}}, {"material", "wall"}}
    SceneBuilder& object(const std::string& name, Parameters parameters);
    /// A triangle mesh; the front of a triangle is where its vertices run counterclockwise. Vertices in
    /// metres.
    SceneBuilder& mesh(const std::string& name, const std::vector<Triple>& vertices,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       const std::string& material);
    /// {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 800}}
    SceneBuilder& light(const std::string& name, Parameters parameters);
    /// {{"type", "illuminance"}, {"position", {1, 1, 0.75}}, {"normal", {0, 0, 1}}}
    SceneBuilder& sensor(const std::string& name, Parameters parameters);
    /// Where paths of files start from; the working directory by default.
    SceneBuilder& directory(const std::filesystem::path& path);

    /// Throws InputError with the message of the scene reader, such as "materials.wall.reflectance: 2 is not
    /// from 0 to 1 (...)".
    Scene build() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// All that is wrong with what a builder holds (the message of build()), or odd with the scene that it makes
/// (Scene::warnings()); empty where nothing is.
std::vector<std::string> validate(const SceneBuilder& builder);

}  // namespace stilb::api
