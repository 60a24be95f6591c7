#include "io/import/gltf/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "io/scene/toml.h"
#include "scene/instances.h"
#include "stilb/error.h"

namespace stilb::io::gltf {
namespace {

/// A parent chain this long is no scene of a person; it limits the recursion.
constexpr std::size_t kMostLevels = 1000;

std::vector<double> checked_numbers(const File& file, const std::vector<double>& numbers, std::size_t count,
                                    std::string_view part, std::string_view key) {
    const bool is_right = numbers.size() == count &&
                          std::ranges::all_of(numbers, [](double n) { return kCoordinate.contains(n); });
    if (!is_right) {
        file.fail(part, fmt::format("\"{}\" must be {} numbers from -1e9 to 1e9.", key, count));
    }
    return numbers;
}

geometry::Transform rotation_of(const File& file, std::span<const double> q, std::string_view part) {
    const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(squared > 1e-12)) file.fail(part, "\"rotation\" is no quaternion: its length is 0.");
    const double s = 2 / squared;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
            {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)},
            {}};
}

geometry::Transform local_transform(const File& file, const tinygltf::Node& node, std::string_view part) {
    if (!node.matrix.empty()) {
        const std::vector<double> m = checked_numbers(file, node.matrix, 16, part, "matrix");
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    geometry::Transform transform;
    if (!node.scale.empty()) {
        const std::vector<double> s = checked_numbers(file, node.scale, 3, part, "scale");
        transform = {{s[0], 0, 0}, {0, s[1], 0}, {0, 0, s[2]}, {}};
    }
    if (!node.rotation.empty()) {
        const std::vector<double> q = checked_numbers(file, node.rotation, 4, part, "rotation");
        transform = compose(rotation_of(file, q, part), transform);
    }
    if (!node.translation.empty()) {
        const std::vector<double> t = checked_numbers(file, node.translation, 3, part, "translation");
        transform.translation = {t[0], t[1], t[2]};
    }
    return transform;
}

/// Places the copies of a node's mesh among themselves (EXT_mesh_gpu_instancing).
class CopyPlaces {
  public:
    CopyPlaces(const File& file, const tinygltf::Value& extension, std::string part)
        : file_(file), part_(std::move(part)) {
        const tinygltf::Value& attributes = extension.Get("attributes");
        translations_ = read(attributes, "TRANSLATION", 3);
        rotations_ = read(attributes, "ROTATION", 4);
        scales_ = read(attributes, "SCALE", 3);
    }

    std::size_t count() const { return count_.value_or(0); }

    geometry::Transform at(std::size_t i) const {
        geometry::Transform place;
        if (!scales_.empty()) {
            const double* const s = scales_.data() + 3 * i;
            place = {{s[0], 0, 0}, {0, s[1], 0}, {0, 0, s[2]}, {}};
        }
        if (!rotations_.empty())
            place = compose(rotation_of(file_, std::span(rotations_).subspan(4 * i, 4), part_), place);
        if (!translations_.empty())
            place.translation = {translations_[3 * i], translations_[3 * i + 1], translations_[3 * i + 2]};
        return place;
    }

  private:
    std::vector<double> read(const tinygltf::Value& attributes, const std::string& name, int components) {
        if (!attributes.IsObject() || !attributes.Has(name)) return {};
        const std::string part = part_ + "." + name;
        std::vector<double> numbers = read_vectors(file_, index_in(attributes, name), components, part);
        const std::size_t found = numbers.size() / static_cast<std::size_t>(components);
        if (found != count_.value_or(found))
            file_.fail(part, fmt::format("it has {} elements, another attribute {}.", found, *count_));
        constexpr std::size_t kMostCopies = 200'000;
        if (found > kMostCopies)
            file_.fail(part, fmt::format("it has {} copies. Allowed: up to {}.", found, kMostCopies));
        if (!std::ranges::all_of(numbers, [](double n) { return kCoordinate.contains(n); }))
            file_.fail(part, "an element has a number that is not from -1e9 to 1e9.");
        count_ = found;
        return numbers;
    }

    const File& file_;
    std::string part_;
    std::optional<std::size_t> count_;
    std::vector<double> translations_, rotations_, scales_;
};

class NodeWalk {
  public:
    explicit NodeWalk(const File& file) : file_(file), is_visited_(file.model.nodes.size()) {}

    void visit(int index, const geometry::Transform& parent, std::string_view from, std::size_t level) {
        const tinygltf::Node& node = element(file_, file_.model.nodes, index, "nodes", from);
        const std::string part = fmt::format("nodes[{}]", index);
        if (is_visited_[static_cast<std::size_t>(index)]) {
            file_.fail(part, "it is its own descendant, or a child of two nodes. Allowed: trees of nodes.");
        }
        is_visited_[static_cast<std::size_t>(index)] = true;
        if (level > kMostLevels)
            file_.fail(part, fmt::format("it lies more than {} levels below the scene.", kMostLevels));
        const geometry::Transform to_world = compose(parent, local_transform(file_, node, part));
        const auto* const copies = find_extension(node.extensions, "EXT_mesh_gpu_instancing");
        nodes.push_back({&node, part, to_world, copies == nullptr ? node.mesh : -1});
        if (copies != nullptr && node.mesh >= 0) add_copies(node, part, to_world, *copies);
        for (const int child : node.children) visit(child, to_world, part, level + 1);
    }

    std::vector<PlacedNode> nodes;

  private:
    void add_copies(const tinygltf::Node& node, const std::string& part, const geometry::Transform& to_world,
                    const tinygltf::Value& extension) {
        const CopyPlaces places(file_, extension, part + ".extensions.EXT_mesh_gpu_instancing");
        for (std::size_t i = 0; i < places.count(); ++i)
            nodes.push_back({&node, part, compose(to_world, places.at(i)), node.mesh, true});
    }

    const File& file_;
    std::vector<bool> is_visited_;
};

/// The nodes that are no children.
std::vector<int> roots_of(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
}

// Triangles

using Indices = std::vector<std::uint32_t>;

Indices indices_of(const File& file, const tinygltf::Primitive& primitive, std::size_t vertices,
                   const std::string& part) {
    if (primitive.indices >= 0) return read_indices(file, primitive.indices, vertices, part + ".indices");
    Indices all(vertices);
    for (std::size_t i = 0; i < vertices; ++i) all[i] = static_cast<std::uint32_t>(i);
    return all;
}

std::vector<Triangle> triangles_of(int mode, const Indices& i) {
    std::vector<Triangle> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t t = 0; t + 2 < i.size(); t += 3) triangles.push_back({i[t], i[t + 1], i[t + 2]});
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t t = 0; t + 2 < i.size(); ++t)
            triangles.push_back({i[t], i[t + 1 + t % 2], i[t + 2 - t % 2]});
    } else {
        for (std::size_t t = 1; t + 1 < i.size(); ++t) triangles.push_back({i[0], i[t], i[t + 1]});
    }
    return triangles;
}

std::vector<Vec3> vectors_of(const std::vector<double>& numbers) {
    std::vector<Vec3> vectors;
    vectors.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return vectors;
}

/// Positions and normals in the world.
void place(Mesh& mesh, const geometry::Transform& transform) {
    for (Vec3& vertex : mesh.vertices) vertex = transform.point(vertex);
    for (Vec3& normal : mesh.normals) {
        const double size = length(normal);
        normal = size > 1e-9 && std::isfinite(size) ? transform.normal(normal / size) : Vec3{};
    }
    if (!transform.is_mirrored()) return;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) turn_over(mesh, t);
}

std::map<int, std::size_t> uses_of_meshes(const std::vector<PlacedNode>& nodes) {
    std::map<int, std::size_t> uses;
    for (const PlacedNode& node : nodes) ++uses[node.mesh];
    return uses;
}

/// Whether alpha may cut holes into a mesh, which divides the surfaces of each node on its own.
bool may_have_holes(const File& file, const tinygltf::Mesh& mesh) {
    return std::ranges::any_of(mesh.primitives, [&](const tinygltf::Primitive& primitive) {
        const auto index = static_cast<std::size_t>(primitive.material);
        return primitive.material >= 0 && index < file.model.materials.size() &&
               file.model.materials[index].alphaMode != "OPAQUE";
    });
}

class PrimitiveReader {
  public:
    PrimitiveReader(const File& file, GroupedWarnings& warnings) : file_(file), warnings_(warnings) {}

    std::optional<PlacedPrimitive> read(const tinygltf::Primitive& primitive, const PlacedNode& node,
                                        const std::string& part) {
        const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
        if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            warnings_.add("primitive", part, "points and lines have no surface; they are left out.");
            return std::nullopt;
        }
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) {
            warnings_.add("primitive", part, "it has no POSITION and is left out.");
            return std::nullopt;
        }
        PlacedPrimitive placed;
        placed.material = std::max(primitive.material, -1);
        placed.mesh.vertices = vectors_of(read_vectors(file_, position->second, 3, part + ".POSITION"));
        const std::size_t vertices = placed.mesh.vertices.size();
        read_normals(primitive, part, vertices, placed.mesh);
        for (std::size_t set = 0; set < placed.uv.size(); ++set)
            placed.uv[set] = read_uv(primitive, part, set, vertices);
        placed.mesh.triangles = triangles_of(mode, indices_of(file_, primitive, vertices, part));
        place(placed.mesh, node.to_world);
        expect_near(placed.mesh, part);
        drop_degenerate(placed.mesh, part);
        if (placed.mesh.triangles.empty()) return std::nullopt;
        warn_of_the_rest(primitive, part);
        return placed;
    }

  private:
    void read_normals(const tinygltf::Primitive& primitive, const std::string& part, std::size_t vertices,
                      Mesh& mesh) const {
        const auto normal = primitive.attributes.find("NORMAL");
        if (normal == primitive.attributes.end()) return;
        mesh.normals = vectors_of(vertex_numbers(normal->second, 3, vertices, part, "NORMAL"));
    }

    std::vector<std::array<double, 2>> read_uv(const tinygltf::Primitive& primitive, const std::string& part,
                                               std::size_t set, std::size_t vertices) const {
        std::vector<std::array<double, 2>> uv;
        const std::string name = fmt::format("TEXCOORD_{}", set);
        const auto coordinates = primitive.attributes.find(name);
        if (file_.model.textures.empty() || coordinates == primitive.attributes.end()) return uv;
        const std::vector<double> numbers = vertex_numbers(coordinates->second, 2, vertices, part, name);
        for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) uv.push_back({numbers[i], numbers[i + 1]});
        return uv;
    }

    /// What the vertices have beside their positions; nothing, with a warning, where it cannot be read: the
    /// surface is there without it. Numbers that are not finite mark the vertices that have none.
    std::vector<double> vertex_numbers(int accessor, std::size_t components, std::size_t vertices,
                                       const std::string& part, const std::string& name) const {
        std::string reason;
        try {
            std::vector<double> numbers = read_vectors(file_, accessor, static_cast<int>(components),
                                                       part + "." + name, NotFinite::kept);
            if (numbers.size() == components * vertices) return numbers;
            reason = fmt::format("it has {} elements for {} vertices", numbers.size() / components, vertices);
        } catch (const InputError& error) {
            reason = error.what();
        }
        warnings_.add("primitive", part, fmt::format("its {} is left out ({}).", name, reason));
        return {};
    }

    void expect_near(const Mesh& mesh, const std::string& part) const {
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            if (!is_placeable(mesh.vertices[v]))
                file_.fail(part + ".POSITION", fmt::format("vertex {} lies beyond 1e9 m.", v));
        }
    }

    void drop_degenerate(Mesh& mesh, const std::string& part) const {
        std::vector<Triangle> kept;
        for (const Triangle& triangle : mesh.triangles) {
            const auto& [a, b, c] = triangle;
            const Vec3 u = mesh.vertices[b] - mesh.vertices[a], v = mesh.vertices[c] - mesh.vertices[a],
                       w = mesh.vertices[c] - mesh.vertices[b];
            constexpr double kThinnest = 1e-12;  // as in mesh files
            const double longest = std::max({squared_length(u), squared_length(v), squared_length(w)});
            if (length(cross(u, v)) > kThinnest * longest) kept.push_back(triangle);
        }
        if (kept.size() < mesh.triangles.size())
            warnings_.add("primitive", part, "triangles without area are left out.");
        mesh.triangles = std::move(kept);
    }

    void warn_of_the_rest(const tinygltf::Primitive& primitive, const std::string& part) const {
        if (primitive.attributes.contains("COLOR_0"))
            warnings_.add("primitive", part, "colours of vertices are left out.");
        if (!primitive.targets.empty())
            warnings_.add("primitive", part, "morph targets are left out; its basic shape is used.");
        if (primitive.attributes.contains("JOINTS_0"))
            warnings_.add("primitive", part, "skins are left out; its basic pose is used.");
    }

    const File& file_;
    GroupedWarnings& warnings_;
};

}  // namespace

bool is_placeable(const Vec3& p) {
    return kCoordinate.contains(p.x) && kCoordinate.contains(p.y) && kCoordinate.contains(p.z);
}

std::vector<PlacedNode> placed_nodes(const File& file, const geometry::Transform& root) {
    const tinygltf::Model& model = file.model;
    NodeWalk walk(file);
    if (model.scenes.empty()) {
        for (const int node : roots_of(model)) walk.visit(node, root, "nodes", 0);
    } else {
        const int index = model.defaultScene < 0 ? 0 : model.defaultScene;
        const tinygltf::Scene& scene = element(file, model.scenes, index, "scenes", "scene");
        for (const int node : scene.nodes) walk.visit(node, root, fmt::format("scenes[{}]", index), 0);
    }
    return std::move(walk.nodes);
}

PlacedMeshes placed_meshes(const File& file, const std::vector<PlacedNode>& nodes, Repeats repeats,
                           GroupedWarnings& warnings) {
    constexpr double kLeastRegularity = 1e-6;  // as of objects in scene files
    PrimitiveReader reader(file, warnings);
    const std::map<int, std::size_t> uses = uses_of_meshes(nodes);
    std::map<int, std::size_t> first_of_shared;
    PlacedMeshes placed;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const tinygltf::Node& node = *nodes[n].node;
        const int index = nodes[n].mesh;
        if (index < 0) continue;
        const tinygltf::Mesh& mesh = element(file, file.model.meshes, index, "meshes", nodes[n].part);
        if (!(nodes[n].to_world.regularity() > kLeastRegularity)) {
            warnings.add("node", node.name.empty() ? nodes[n].part : node.name,
                         "its scale is 0 along an axis; it is left out.");
            continue;
        }
        if (const auto first = first_of_shared.find(index); first != first_of_shared.end()) {
            placed.first_of_instance[n] = first->second;
            continue;
        }
        std::size_t triangles = 0;
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            auto primitive =
                reader.read(mesh.primitives[p], nodes[n], fmt::format("meshes[{}].primitives[{}]", index, p));
            if (!primitive) continue;
            primitive->node = n;
            triangles += primitive->mesh.triangles.size();
            placed.primitives.push_back(std::move(*primitive));
        }
        if (repeats == Repeats::instances && !may_have_holes(file, mesh) &&
            scene::are_instances(triangles, uses.at(index)))
            first_of_shared[index] = n;
    }
    return placed;
}

}  // namespace stilb::io::gltf
