#include "io/results/solution_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/version.h"
#include "io/results/packed_light.h"
#include "io/text/compression.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "scene/light_groups.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr std::uint32_t kVersion = 3;
constexpr std::string_view kRemedy = "Solve the scene again.";
/// Magic, version, size and hash.
constexpr std::size_t kHeaderSize = kSolutionBeginning.size() + 4 + 8 + 8;

void write_patches(const patches::Patches& patches, ByteWriter& bytes) {
    bytes.add(patches.center);
    bytes.add_list(patches.vertices);
    bytes.add_list(patches.corners);
    bytes.add_list(patches.normals);
    bytes.add_list(patches.areas_m2);
    bytes.add_list(patches.materials);
    bytes.add_list(patches.first_of_object);
}

patches::Patches read_patches(ByteReader& bytes) {
    patches::Patches patches;
    patches.center = bytes.take<Vec3>("the patches' centre");
    patches.vertices = bytes.take_list<std::vector<patches::Float3>>("the vertices");
    patches.corners = bytes.take_list<std::vector<Triangle>>("the patches' corners");
    patches.normals = bytes.take_list<std::vector<patches::Float3>>("the patches' normals");
    patches.areas_m2 = bytes.take_list<std::vector<float>>("the patches' areas");
    patches.materials = bytes.take_list<std::vector<MaterialId>>("the patches' materials");
    patches.first_of_object = bytes.take_list<std::vector<std::uint32_t>>("the objects' first patches");
    return patches;
}

std::string contents_of(const StoredSolution& stored) {
    const estimators::PatchSolution& solution = stored.solution;
    ByteWriter bytes;
    bytes.add_list(stored.version);
    bytes.add_list(stored.scene);
    bytes.add_list(stored.light_hash);
    bytes.add(stored.seed);
    bytes.add(stored.steps);
    bytes.add(stored.attained_error);
    write_patches(solution.patches, bytes);
    bytes.add(static_cast<std::uint32_t>(solution.groups.size()));
    for (const std::string& group : solution.groups) bytes.add_list(group);
    bytes.add(static_cast<std::uint32_t>(solution.degree));
    bytes.add_list(solution.lit_vertices);
    const PackedLight light = pack(solution.terms);
    bytes.add_list(light.exponents);
    bytes.add_list(light.bytes);
    bytes.add(static_cast<std::uint32_t>(solution.replicates.size()));
    for (const std::vector<Half>& shares : solution.replicates) bytes.add_list(shares);
    bytes.add_list(solution.bias);
    return bytes.take();
}

StoredSolution read_contents(ByteReader& bytes) {
    StoredSolution stored;
    stored.version = bytes.take_list<std::string>("Stilb's version");
    stored.scene = bytes.take_list<std::string>("the scene's file");
    stored.light_hash = bytes.take_list<std::string>("the scene's hash");
    stored.seed = bytes.take<std::uint64_t>("the seed");
    stored.steps = bytes.take<std::uint64_t>("the steps");
    stored.attained_error = bytes.take<double>("the error");
    estimators::PatchSolution& solution = stored.solution;
    solution.patches = read_patches(bytes);
    const auto groups = bytes.take<std::uint32_t>("the number of groups of lights");
    if (groups > scene::kMostLightGroups)
        bytes.fail(
            fmt::format("{} groups of lights; at most {} are allowed", groups, scene::kMostLightGroups));
    for (std::uint32_t g = 0; g < groups; ++g)
        solution.groups.push_back(bytes.take_list<std::string>("a group of lights"));
    solution.degree = static_cast<int>(bytes.take<std::uint32_t>("the degree"));
    solution.lit_vertices = bytes.take_list<std::vector<std::uint32_t>>("the vertices with light");
    PackedLight packed;
    packed.exponents = bytes.take_list<std::vector<std::int16_t>>("the steps of the light");
    packed.bytes = bytes.take_list<std::string>("the light");
    auto light = unpack(packed, groups);
    if (!light) bytes.fail("the light and its steps do not fit each other");
    solution.terms = *std::move(light);
    const auto replicates = bytes.take<std::uint32_t>("the number of replicates");
    for (std::uint32_t r = 0; r < replicates; ++r)
        solution.replicates.push_back(bytes.take_list<std::vector<Half>>("the replicates"));
    solution.bias = bytes.take_list<std::vector<Half>>("the bias of the patches");
    bytes.expect_end();
    return stored;
}

std::string header_of(std::string_view body) {
    ByteWriter bytes;
    bytes.add(kVersion);
    bytes.add(static_cast<std::uint64_t>(kHeaderSize + body.size()));
    bytes.add(hash_of(body));
    return std::string(kSolutionBeginning) + bytes.take();
}

/// The contents of a body, whose hash was right.
std::string uncompressed(std::string_view body, const std::string& name) {
    ByteReader bytes(body, kHeaderSize, name, kRemedy);
    const auto size = bytes.take<std::uint64_t>("the size of the contents");
    if (size > estimators::kMostStoredBytes)
        bytes.fail(fmt::format("contents of {} bytes are too large", size));
    auto contents = gunzip(body.substr(sizeof size), static_cast<std::size_t>(size));
    if (!contents) bytes.fail("the contents cannot be decompressed");
    return *std::move(contents);
}

}  // namespace

std::string solution_file_of(std::string_view contents) {
    ByteWriter bytes;
    bytes.add(static_cast<std::uint64_t>(contents.size()));
    const std::string body = bytes.take() + gzip(contents);
    return header_of(body) + body;
}

std::string to_bytes(const StoredSolution& stored) { return solution_file_of(contents_of(stored)); }

StoredSolution read_solution(std::string_view bytes, const std::string& name) {
    const auto fail = [&](const std::string& message) { throw InputError(message, {name}); };
    if (!bytes.starts_with(kSolutionBeginning))
        fail(fmt::format("not a solution: the file does not begin with {}.", kSolutionBeginning));
    constexpr std::size_t begun = kSolutionBeginning.size();
    ByteReader header(bytes.substr(begun), begun, name, kRemedy);
    const auto version = header.take<std::uint32_t>("the version");
    if (version != kVersion) {
        fail(
            fmt::format("the solution is of version {}, but Stilb {} reads version {}. Solve the "
                        "scene again.",
                        version, program_version(), kVersion));
    }
    const auto size = header.take<std::uint64_t>("the size");
    if (size != bytes.size()) {
        fail(
            fmt::format("the file has {} bytes instead of {}: it was cut off or extended. Copy it "
                        "again, or solve the scene again.",
                        bytes.size(), size));
    }
    const auto hash = header.take<std::uint64_t>("the hash");
    const std::string_view body = bytes.substr(kHeaderSize);
    if (hash != hash_of(body)) {
        fail(
            "damaged: the contents do not match the stored hash. Copy the file again, or solve the scene "
            "again.");
    }
    const std::string contents = uncompressed(body, name);
    ByteReader reader(contents, 0, name, kRemedy);
    return read_contents(reader);
}

StoredSolution read_solution_file(const std::filesystem::path& path) {
    return read_solution(read_whole_file(path), path.string());
}

std::size_t write_solution_file(const StoredSolution& stored, const std::filesystem::path& path) {
    const std::string bytes = to_bytes(stored);
    replace_file(path, bytes);
    return bytes.size();
}

StoredSolution stored_solution(const RunSummary& run, estimators::PatchSolution solution,
                               const SceneFile& scene, const std::filesystem::path& path) {
    StoredSolution stored;
    stored.version = program_version();
    const auto folder = std::filesystem::absolute(path).parent_path();
    stored.scene = std::filesystem::proximate(scene.sources.front(), folder).generic_string();
    stored.light_hash = light_hash(scene.sources, scene.overrides);
    stored.seed = run.seed;
    stored.steps = run.samples;
    stored.attained_error = run.attained_error;
    stored.solution = std::move(solution);
    return stored;
}

void require_same_light(const StoredSolution& stored, const SceneFile& scene,
                        const std::string& solution_file) {
    if (light_hash(scene.sources, scene.overrides) == stored.light_hash) return;
    throw InputError(
        fmt::format("materials, objects or lights of '{}', files that it refers to, or values given beside "
                    "it have changed since the scene was solved (only sensors may change). Solve it again.",
                    scene.sources.front().string()),
        {solution_file});
}

}  // namespace stilb::io
