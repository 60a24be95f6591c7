// Scenes: read from a file, or built in code with the same keys, the same checks and the same messages.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "stilb/options.h"

#pragma GCC visibility push(default)

namespace stilb::api {

/// A position [m], a direction, or a colour (linear Rec. 709).
using Triple = std::array<double, 3>;

/// The value of a key: true or false, a number, a text, a list of values such as {0, 0, 1}, or a table of
/// keys and values.
class Value {
  public:
    using List = std::vector<Value>;
    using Table = std::map<std::string, Value>;
    using Content = std::variant<bool, std::int64_t, double, std::string, List, Table>;

    Value(bool value) : content_(value) {}
    Value(int value) : content_(std::int64_t{value}) {}
    Value(std::int64_t value) : content_(value) {}
    Value(double value) : content_(value) {}
    Value(const char* text) : content_(std::string(text)) {}
    Value(std::string text) : content_(std::move(text)) {}
    Value(const Triple& triple) : content_(List(triple.begin(), triple.end())) {}
    Value(List list) : content_(std::move(list)) {}
    Value(std::initializer_list<Value> list) : content_(List(list)) {}
    Value(Table table) : content_(std::move(table)) {}

    const Content& content() const { return content_; }

  private:
    Content content_;
};

/// Keys and values as in scene files: docs/scene-format.md lists them.
using Parameters = Value::Table;

/// Objects, materials, lights and sensors. Immutable; copies share their data.
class Scene {
  public:
    /// Reads a scene file, or a scene of another program that Stilb reads (glTF, OBJ, Radiance). `settings`:
    /// "KEY=VALUE", as `--set` on the command line ("import.scale=0.01"). Throws InputError: file, line, key,
    /// what was found, and what is allowed; Cancelled where `control` interrupts.
    static Scene load(const std::filesystem::path& path, std::span<const std::string> settings = {},
                      const Control& control = {});
    /// Reads a scene from a text; file names in it are relative to `directory`.
    static Scene parse(std::string_view toml, const std::filesystem::path& directory = ".");

    std::string name() const;
    /// In the order of the scene; cameras are among them.
    std::vector<std::string> sensors() const;
    /// The scene file's section [run]; the defaults where it has none.
    Options options() const;

    struct Data;
    explicit Scene(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    const Data& data() const { return *data_; }

  private:
    std::shared_ptr<const Data> data_;
};

/// Collects the parts of a scene. Their names are used by results and messages.
class SceneBuilder {
  public:
    explicit SceneBuilder(const std::string& name = "");
    /// Adds to a scene, which may come from a file of any format.
    explicit SceneBuilder(Scene scene);
    ~SceneBuilder();
    SceneBuilder(SceneBuilder&&) noexcept;
    SceneBuilder& operator=(SceneBuilder&&) noexcept;

    /// Such as `material("wall", {{"type", "diffuse"}, {"reflectance", 0.6}})`.
    SceneBuilder& material(const std::string& name, const Parameters& parameters);
    /// Such as `object("room", {{"shape", "box"}, {"min", {0, 0, 0}}, {"max", {4, 3, 2.5}}, {"material",
    /// "wall"}})`.
    SceneBuilder& object(const std::string& name, const Parameters& parameters);
    /// Triangles as indices of vertices [m]; the front of a triangle is the side from which its vertices run
    /// counterclockwise. `parameters`: the other keys of the object, such as {{"material", "wall"}}.
    SceneBuilder& mesh(const std::string& name, std::span<const Triple> vertices,
                       std::span<const std::array<std::uint32_t, 3>> triangles, const Parameters& parameters);
    /// The same with a material alone.
    SceneBuilder& mesh(const std::string& name, const std::vector<Triple>& vertices,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       const std::string& material);
    /// Such as `light("bulb", {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 800}})`.
    SceneBuilder& light(const std::string& name, const Parameters& parameters);
    /// Such as `sensor("desk", {{"type", "illuminance"}, {"position", {1, 1, 0.75}}, {"normal", {0, 0,
    /// 1}}})`.
    SceneBuilder& sensor(const std::string& name, const Parameters& parameters);
    /// The section [run], such as `run({{"maintenance", 0.8}})`.
    SceneBuilder& run(const Parameters& parameters);
    /// A state of the lamps, such as `light_scene("evening", {{"panel", 0.2}, {"others", 0}})`.
    SceneBuilder& light_scene(const std::string& name, const Parameters& parameters);
    /// The section [defaults], such as `defaults({{"lights", Parameters{{"cct", 4000}}}})`.
    SceneBuilder& defaults(const Parameters& parameters);
    /// The folder that file names are relative to; the working directory by default.
    SceneBuilder& directory(const std::filesystem::path& path);

    /// Throws InputError with the scene reader's message, such as "materials.wall.reflectance: 2 is not
    /// allowed. Allowed: from 0 to 1 (...)".
    Scene build() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// The files that export_scene() has written.
struct Export {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> warnings;  ///< of what has no equal in the other program
};
/// Writes a scene, its points and its views for "mitsuba" or "radiance" into a folder, which is made where it
/// does not exist. Throws InputError where files cannot be written, and for other formats.
Export export_scene(const Scene& scene, const std::string& format, const std::filesystem::path& folder);

/// A type of material, shape, light or sensor, with its keys.
struct PartType {
    std::string section;  ///< "materials", "objects", "lights" or "sensors"
    std::string type;     ///< such as "diffuse"; of objects the shape
    std::vector<std::string> keys;
};
/// All types that scenes can have: what the scene reader allows.
std::vector<PartType> part_types();

/// Warns of faults that a scene probably has, though it can be computed: holes in closed surfaces,
/// overlapping surfaces, lights and sensors on the wrong side of a wall, objects that no light reaches. The
/// warnings of the reader come first. These are the sentences of `stilb info`; there are none where nothing
/// is odd. Traces rays, which takes about a second.
std::vector<std::string> validate(const Scene& scene);
/// The same of a scene that is being built; the message of build() where it cannot be built.
std::vector<std::string> validate(const SceneBuilder& builder);

}  // namespace stilb::api

#pragma GCC visibility pop
