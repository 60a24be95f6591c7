#include "io/import/radiance/compiled_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "io/text/text.h"

namespace stilb::io::radiance {
namespace {

constexpr std::string_view kOctreeFormat = "Radiance_octree", kMeshFormat = "Radiance_tmesh";
/// The number at the beginning is this plus the size of an object's index.
constexpr std::int64_t kOctreeNumber = 283, kMeshNumber = 319;
constexpr std::int64_t kLargestIndexSize = 8;

/// Numbers with the most significant byte first, and texts that end with a zero byte.
class CompiledReader {
  public:
    CompiledReader(std::string_view content, const std::string& name) : rest_(content), name_(name) {}

    [[noreturn]] void fail(const std::string& message) const { throw InputError(message, {name_}); }

    /// Reads the lines up to the empty one, and the number behind them.
    void read_header(std::string_view format, std::int64_t number) {
        bool is_right = false;
        while (true) {
            const std::size_t end = rest_.find('\n');
            if (end == rest_.npos) break;
            const std::string_view line = rest_.substr(0, end);
            rest_.remove_prefix(end + 1);
            if (line.starts_with("FORMAT=")) is_right = trimmed(line.substr(7)) == format;
            if (line.empty()) break;
        }
        if (!is_right) fail(fmt::format("this is no file of the format {}.", format));
        index_size_ = integer(2) - number;
        if (index_size_ < 1 || index_size_ > kLargestIndexSize)
            fail("the version of this compiled file is not known. Compile it anew.");
    }

    std::string_view bytes(std::size_t count) {
        if (rest_.size() < count) fail("the file ends too early.");
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    std::int64_t integer(std::size_t size) {
        std::uint64_t value = 0;
        const std::string_view taken = bytes(size);
        if ((static_cast<unsigned char>(taken[0]) & 0x80) != 0) value = ~std::uint64_t{0};
        for (const char c : taken) value = value << 8 | static_cast<unsigned char>(c);
        return static_cast<std::int64_t>(value);
    }
    std::int64_t index() { return integer(static_cast<std::size_t>(index_size_)); }
    /// A count of things that take a byte at least.
    std::size_t count(std::size_t size) {
        const std::int64_t value = integer(size);
        if (value < 0 || static_cast<std::size_t>(value) > rest_.size()) fail("the file ends too early.");
        return static_cast<std::size_t>(value);
    }
    double real() {
        const std::int64_t mantissa = integer(4), exponent = integer(1);
        if (mantissa == 0) return 0;
        const double share = (static_cast<double>(mantissa) + (mantissa > 0 ? 0.5 : -0.5)) / 0x7fffffff;
        return std::ldexp(share, static_cast<int>(exponent));
    }
    std::string text() {
        const std::size_t end = rest_.find('\0');
        if (end == rest_.npos) fail("the file ends too early.");
        std::string result(rest_.substr(0, end));
        rest_.remove_prefix(end + 1);
        return result;
    }
    /// A number as text.
    double number_in_text() {
        const std::string word = text();
        const auto value = parse_number(word);
        if (!value) fail(fmt::format("found {} where a number is needed.", in_quotes(word)));
        return *value;
    }

    void skip_tree() {
        for (std::size_t nodes = 1; nodes > 0; --nodes) {
            switch (integer(1)) {
                case 0:  // empty
                    break;
                case 1: {  // a set of objects
                    const std::int64_t objects = index();
                    if (objects < 0) fail("the octree is damaged.");
                    bytes(std::min<std::size_t>(static_cast<std::size_t>(objects), rest_.size() + 1) *
                          static_cast<std::size_t>(index_size_));
                    break;
                }
                case 2:
                    nodes += 8;
                    if (nodes > rest_.size() + 1) fail("the file ends too early.");
                    break;
                default:
                    fail("the octree is damaged.");
            }
        }
    }

    std::vector<Primitive> primitives() {
        std::vector<std::string> types;
        for (std::string type = text(); !type.empty(); type = text()) types.push_back(std::move(type));
        std::vector<Primitive> result;
        for (std::int64_t type = integer(1); type != -1; type = integer(1)) {
            if (type < 0 || type >= std::ssize(types)) fail("a primitive has a type that is not known.");
            result.push_back(primitive(types[static_cast<std::size_t>(type)], result));
        }
        return result;
    }

  private:
    Primitive primitive(const std::string& type, const std::vector<Primitive>& earlier) {
        Primitive result;
        result.type = type;
        const std::int64_t modifier = index();
        if (modifier < -1 || modifier >= std::ssize(earlier)) fail("a modifier is missing.");
        result.modifier = modifier < 0 ? "void" : earlier[static_cast<std::size_t>(modifier)].name;
        result.name = text();
        for (std::size_t left = count(2); left > 0; --left) result.texts.push_back(text());
        for (std::size_t left = count(2); left > 0; --left) result.numbers.push_back(real());
        return result;
    }

    std::string_view rest_;
    const std::string& name_;
    std::int64_t index_size_ = 0;
};

/// A direction in 32 bits: the signs, two components of 13 bits, and which they are.
Vec3 direction_of(std::uint32_t code) {
    if (code == 0) return {};
    constexpr double scale = 11584.5;
    const double first = ((code >> 5 & 0x1fff) + 0.5) / scale, second = ((code >> 18 & 0x1fff) + 0.5) / scale;
    const double third = std::sqrt(std::max(0.0, 1 - first * first - second * second));
    const bool first_is_x = (code & 8) != 0, second_is_z = (code & 16) != 0;
    std::array<double, 3> direction{};
    direction[first_is_x ? 0 : 1] = first;
    direction[second_is_z ? 2 : first_is_x ? 1 : 0] = second;
    direction[!second_is_z ? 2 : first_is_x ? 1 : 0] = third;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((code >> axis & 1) != 0) direction[axis] = -direction[axis];
    }
    return {direction[0], direction[1], direction[2]};
}

struct MeshTriangle {
    std::array<std::uint32_t, 3> vertices{};
    std::int64_t material = -1;
};

/// Reads the patches of a mesh: up to 256 vertices each, and triangles between them or to those of other
/// patches.
class PatchReader {
  public:
    PatchReader(CompiledReader& reader, const Vec3& corner, double size)
        : reader_(reader), corner_(corner), size_(size) {}

    void read() {
        const std::size_t patches = reader_.count(4);
        for (std::size_t patch = 0; patch < patches; ++patch) read_patch(patch);
        for (const MeshTriangle& triangle : triangles_) {
            for (const std::uint32_t vertex : triangle.vertices) {
                if (vertex >= positions_.size() || !is_vertex_[vertex])
                    reader_.fail("a triangle refers to a vertex that is not there.");
            }
        }
    }
    const std::vector<MeshTriangle>& triangles() const { return triangles_; }
    std::vector<double> numbers_of(const MeshTriangle& triangle) const {
        std::vector<double> numbers;
        for (const auto* list : {&positions_, &normals_}) {
            for (const std::uint32_t vertex : triangle.vertices) {
                const Vec3& v = (*list)[vertex];
                numbers.insert(numbers.end(), {v.x, v.y, v.z});
            }
        }
        return numbers;
    }

  private:
    static constexpr std::size_t kPatchSize = 256;
    static constexpr unsigned kHasNormals = 2, kHasTexture = 4;

    std::uint32_t word() { return static_cast<std::uint32_t>(reader_.integer(4)); }
    std::uint32_t local() {
        return first_ + static_cast<std::uint32_t>(static_cast<unsigned char>(reader_.bytes(1)[0]));
    }

    void read_patch(std::size_t patch) {
        first_ = static_cast<std::uint32_t>(patch * kPatchSize);
        const auto flags = static_cast<unsigned>(reader_.integer(1));
        const std::size_t vertices = reader_.count(2);
        if ((flags & 1) == 0 || vertices > kPatchSize) reader_.fail("a part of the mesh is damaged.");
        read_vertices(vertices, flags);
        const std::size_t before = triangles_.size();
        for (std::size_t left = reader_.count(2); left > 0; --left)
            triangles_.push_back({{local(), local(), local()}});
        read_materials(before);
        for (std::size_t left = reader_.count(2); left > 0; --left) {
            MeshTriangle& triangle = triangles_.emplace_back(MeshTriangle{{word(), local(), local()}});
            triangle.material = reader_.integer(2);
        }
        for (std::size_t left = reader_.count(2); left > 0; --left) {
            MeshTriangle& triangle = triangles_.emplace_back(MeshTriangle{{word(), word(), local()}});
            triangle.material = reader_.integer(2);
        }
    }
    void read_vertices(std::size_t count, unsigned flags) {
        const std::size_t end = first_ + kPatchSize;
        positions_.resize(end), normals_.resize(end), is_vertex_.resize(end);
        for (std::size_t i = 0; i < count; ++i) {
            std::array<double, 3> offset{};
            for (double& along : offset) along = (word() + 0.5) * 0x1p-32 * size_;
            positions_[first_ + i] = corner_ + Vec3{offset[0], offset[1], offset[2]};
            is_vertex_[first_ + i] = true;
        }
        if ((flags & kHasNormals) != 0) {
            for (std::size_t i = 0; i < count; ++i) normals_[first_ + i] = direction_of(word());
        }
        if ((flags & kHasTexture) != 0) reader_.bytes(8 * count);
    }
    /// Of the triangles within the patch: one for all, or one for each.
    void read_materials(std::size_t first) {
        if (reader_.integer(2) > 1) {
            for (std::size_t t = first; t < triangles_.size(); ++t)
                triangles_[t].material = reader_.integer(2);
        } else {
            const std::int64_t material = reader_.integer(2);
            for (std::size_t t = first; t < triangles_.size(); ++t) triangles_[t].material = material;
        }
    }

    CompiledReader& reader_;
    Vec3 corner_;
    double size_;
    std::uint32_t first_ = 0;
    std::vector<Vec3> positions_, normals_;
    std::vector<bool> is_vertex_;
    std::vector<MeshTriangle> triangles_;
};

}  // namespace

std::vector<std::string> files_of_octree(std::string_view content, const std::string& name) {
    CompiledReader reader(content, name);
    reader.read_header(kOctreeFormat, kOctreeNumber);
    for (int i = 0; i < 4; ++i) reader.text();  // its bounds
    std::vector<std::string> files;
    for (std::string file = reader.text(); !file.empty(); file = reader.text())
        files.push_back(std::move(file));
    if (files.empty()) {
        reader.fail(
            "this octree is frozen (oconv -f). Name the Radiance files that it was made of, or make it "
            "without "
            "-f.");
    }
    return files;
}

void add_compiled_mesh(std::string_view content, const std::string& name, std::optional<std::size_t> modifier,
                       const Primitive& mesh, Collector& collector) {
    CompiledReader reader(content, name);
    reader.read_header(kMeshFormat, kMeshNumber);
    std::array<double, 3> corner{};
    for (double& coordinate : corner) coordinate = reader.number_in_text();
    const double size = reader.number_in_text();
    for (int i = 0; i < 4; ++i) reader.real();  // bounds of texture coordinates
    reader.skip_tree();
    std::vector<std::optional<std::size_t>> materials;
    for (Primitive& part : reader.primitives()) {
        if (role_of(part.type) != Role::modifier) {
            materials.emplace_back();  // an alias
            continue;
        }
        part.place = mesh.place;
        collector.add(part);
        materials.push_back(collector.find(part.name, part.place));
    }
    PatchReader patches(reader, {corner[0], corner[1], corner[2]}, size);
    patches.read();
    for (const MeshTriangle& triangle : patches.triangles()) {
        std::optional<std::size_t> own = modifier;
        if (!own && triangle.material >= 0) {
            if (triangle.material >= std::ssize(materials))
                reader.fail("a material of a triangle is missing.");
            own = materials[static_cast<std::size_t>(triangle.material)];
        }
        collector.add_surface(SurfaceKind::mesh, mesh.name, own, patches.numbers_of(triangle), mesh.place);
    }
}

}  // namespace stilb::io::radiance
