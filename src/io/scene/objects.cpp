// [objects.NAME]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/harmonics/surface.h"
#include "io/mesh/harmonics_file.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/mesh_objects.h"
#include "io/scene/sections.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

// scale, rotate, translate or transform of an object

namespace {

constexpr Range kScale{1e-9, 1e9, "a factor above 0 (from 1e-9 to 1e9)"};
/// The least sine between axes: below it too few digits are left to distinguish front and back.
constexpr double kLeastRegularity = 1e-6;

geometry::Transform read_matrix(const TomlItem& item) {
    const std::vector<double> m = item.numbers(16, kCoordinate);
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        item.fail(
            "the last row is not [0, 0, 0, 1]. Allowed: 16 numbers row by row; the translation is the "
            "fourth of each of the first three rows.");
    }
    const geometry::Transform transform{
        {m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
    if (transform.regularity() < kLeastRegularity) {
        item.fail("the matrix is singular: it flattens the object. Allowed: any invertible matrix.");
    }
    return transform;
}

geometry::Transform read_rotation(const TomlItem& item) {
    const std::vector<double> parts = item.numbers(4, kCoordinate);
    return geometry::Transform::rotation(item.made_unit({parts[0], parts[1], parts[2]}), parts[3]);
}

}  // namespace

geometry::Transform read_transform(const TomlTable& object) {
    for (const std::string_view key : {"scale", "rotate", "translate"})
        object.expect_not_both(key, "transform");
    if (const auto matrix = object.find("transform")) return read_matrix(*matrix);
    geometry::Transform transform;
    if (const auto scale = object.find("scale"))
        transform = geometry::Transform::scaling(scale->number(kScale));
    if (const auto rotation = object.find("rotate")) transform = compose(read_rotation(*rotation), transform);
    if (const auto translation = object.find("translate")) transform.translation = translation->vector();
    return transform;
}

// shape = "harmonics" of an object

namespace {

constexpr Range kCoefficient{-1e9, 1e9, "a number from -1e9 to 1e9"};
constexpr std::array<std::string_view, 3> kMethods{"cells", "roots", "march"};

int degree_of(const TomlItem& item, std::size_t count) {
    for (int degree = 0; degree <= math::kMostHarmonicDegree; ++degree) {
        if (math::harmonic_count(degree) == count) return degree;
    }
    item.fail(
        fmt::format("found {} coefficients. Allowed: (degree + 1)^2 of them for a degree from 0 to {}: "
                    "1, 4, 9, 16 ...",
                    count, math::kMostHarmonicDegree));
}

HarmonicsFile read_series(const TomlTable& table, const std::filesystem::path& directory, SceneFile& file) {
    const auto [key, item] = table.one_of({"file", "coefficients"});
    if (key == "file") {
        file.sources.push_back(item.existing_file(directory));
        return read_harmonics(file.sources.back());
    }
    HarmonicsFile series;
    for (const TomlItem& element : item.elements())
        series.coefficients.push_back(element.number(kCoefficient));
    degree_of(item, series.coefficients.size());
    return series;
}

void truncate(const TomlTable& table, std::vector<double>& coefficients) {
    const auto item = table.find("degree");
    if (!item) return;
    const auto largest = degree_of(*item, coefficients.size());
    coefficients.resize(math::harmonic_count(static_cast<int>(item->integer(0, largest))));
}

Harmonics harmonics_of(const HarmonicsFile& series, const TomlTable& table) {
    try {
        return Harmonics(geometry::HarmonicSurface(math::HarmonicSeries<double>(series.coefficients)));
    } catch (const InputError& error) {
        table.fail(error.what());
    }
}

}  // namespace

Harmonics read_harmonic_shape(const TomlTable& table, const std::filesystem::path& directory,
                              SceneFile& file) {
    HarmonicsFile series = read_series(table, directory, file);
    truncate(table, series.coefficients);
    Harmonics harmonics = harmonics_of(series, table);
    if (!table.has("center")) harmonics.center = series.center;
    if (const auto method = table.find("intersection"))
        harmonics.method = static_cast<HarmonicMethod>(method->index_in(kMethods, "intersection"));
    if (const auto detail = table.find("lod")) harmonics.has_levels_of_detail = detail->boolean();
    return harmonics;
}

namespace {

using Names = std::vector<std::string_view>;

/// A shape, and the keys that it has besides those of all objects.
struct ShapeKeys {
    std::string_view shape;
    std::array<std::string_view, 6> keys;  ///< then empty ones
};
constexpr std::array kShapes{
    ShapeKeys{"mesh", {"file", "materials"}},
    ShapeKeys{"rectangle", {"corner", "edge_u", "edge_v"}},
    ShapeKeys{"box", {"min", "max"}},
    ShapeKeys{"sphere", {"center", "radius"}},
    ShapeKeys{"disk", {"center", "normal", "radius"}},
    ShapeKeys{"polygons", {"vertices", "faces"}},
    ShapeKeys{"harmonics", {"file", "coefficients", "center", "degree", "intersection", "lod"}},
};

/// The keys of the shape, and those that every object has.
Names keys_of(const ShapeKeys& shape) {
    Names keys(shape.keys.begin(), std::ranges::find(shape.keys, ""));
    for (const std::string_view key : {"shape", "material", "scale", "rotate", "translate", "transform"}) {
        keys.push_back(key);
    }
    return keys;
}

/// The shape of an object, whose keys are checked.
std::string_view read_shape_name(TomlTable& table) {
    std::array<std::string_view, kShapes.size()> names;
    std::ranges::transform(kShapes, names.begin(), &ShapeKeys::shape);
    const std::string_view shape = table.choose("shape", names);
    table.expect_keys(keys_of(*std::ranges::find(kShapes, shape, &ShapeKeys::shape)),
                      fmt::format("shape {}", in_quotes(shape)));
    return shape;
}

Box read_box(const TomlTable& table) {
    const Box box{table.at("min").vector(), table.at("max").vector()};
    const Vec3 size = box.max - box.min;
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
        table.fail("max is not above min. Allowed: a max that is larger than min in x, y and z.");
    }
    return box;
}

Sphere read_sphere(const TomlTable& table) {
    return {table.at("center").vector(), table.at("radius").number(kRadius)};
}

Disk read_disk(const TomlTable& table, SceneFile& file) {
    return {table.at("center").vector(), read_direction(table.at("normal"), file.warnings),
            table.at("radius").number(kRadius)};
}

void add_face(const TomlItem& face, MeshBuilder& builder) {
    const auto last_vertex = static_cast<std::int64_t>(builder.vertex_count()) - 1;
    std::vector<std::uint32_t> corners;
    for (const TomlItem& corner : face.elements()) {
        corners.push_back(static_cast<std::uint32_t>(corner.integer(0, last_vertex)));
    }
    if (corners.size() < 3) {
        face.fail(fmt::format("found a face of {} corners. Allowed: 3 or more indices of vertices.",
                              corners.size()));
    }
    builder.add_polygon(corners);
}

void add_vertices(const TomlItem& item, MeshBuilder& builder) {
    if (const auto* vertices = item.vertices()) {
        builder.reserve_vertices(vertices->size());
        for (const Vec3& vertex : *vertices) {
            for (const double coordinate : {vertex.x, vertex.y, vertex.z}) {
                if (!kCoordinate.contains(coordinate))
                    item.fail(fmt::format("vertex {}: {}", builder.vertex_count(),
                                          refusal(coordinate, kCoordinate)));
            }
            builder.add_vertex(vertex);
        }
    } else {
        for (const TomlItem& vertex : item.elements()) builder.add_vertex(vertex.vector());
    }
    if (builder.vertex_count() < 3) item.fail("found fewer than 3 vertices. Allowed: 3 or more.");
}

void add_faces(const TomlItem& item, MeshBuilder& builder) {
    const auto* const triangles = item.triangles();
    if (!triangles) {
        for (const TomlItem& face : item.elements()) add_face(face, builder);
        return;
    }
    for (const std::array<std::uint32_t, 3>& triangle : *triangles) {
        const std::uint32_t largest = std::ranges::max(triangle);
        if (largest >= builder.vertex_count()) {
            item.fail(fmt::format("a triangle has the vertex {}. Allowed: a whole number from 0 to {}.",
                                  largest, builder.vertex_count() - 1));
        }
        builder.add_triangle(triangle);
    }
}

Mesh read_polygons(const TomlTable& table, SceneFile& file) {
    MeshBuilder builder;
    add_vertices(table.at("vertices"), builder);
    add_faces(table.at("faces"), builder);
    MeshFile mesh = std::move(builder).finish(table.where(), "give a face that has an area");
    add_mesh_warnings(table.where(), mesh, file);
    return std::move(mesh.mesh);
}

Shape read_simple_shape(const TomlTable& table, std::string_view shape, SceneFile& file) {
    if (shape == "rectangle") return read_rectangle(table);
    if (shape == "box") return read_box(table);
    if (shape == "sphere") return read_sphere(table);
    if (shape == "disk") return read_disk(table, file);
    return read_polygons(table, file);
}

/// `parts` is filled if the object is a mesh from a file.
Object read_untransformed(TomlTable& table, const std::filesystem::path& directory, SceneFile& file,
                          MeshFiles& meshes, MeshParts& parts) {
    const std::string_view shape = read_shape_name(table);
    if (shape == "mesh") return meshes.read(table, parts);
    const auto of_one_material = [&](Shape geometry) {
        return Object{"", std::move(geometry), {read_material(table.at("material"), file.scene)}};
    };
    if (shape == "harmonics") return of_one_material(read_harmonic_shape(table, directory, file));
    return of_one_material(read_simple_shape(table, shape, file));
}

void expect_possible(const geometry::Transform& transform, const Shape& shape, const TomlTable& table) {
    const bool is_round = std::holds_alternative<Sphere>(shape) || std::holds_alternative<Disk>(shape);
    const bool is_harmonic = std::holds_alternative<Harmonics>(shape);
    if ((is_round || is_harmonic) && !transform.is_similarity()) {
        table.at("transform")
            .fail(
                "stretches or shears a curved shape. Allowed for spheres, disks and harmonics: "
                "transformations that keep "
                "angles (translation, rotation, reflection, one scale for all axes).");
    }
}

/// Scales and rotates a series about its centre, if it has one.
geometry::Transform transform_of(const Shape& shape, const TomlTable& table) {
    geometry::Transform transform = read_transform(table);
    if (std::holds_alternative<Harmonics>(shape)) {
        if (const auto center = table.find("center")) transform.translation += center->vector();
    }
    return transform;
}

}  // namespace

std::vector<TypeKeys> object_shapes() {
    std::vector<TypeKeys> shapes;
    for (const ShapeKeys& shape : kShapes) shapes.push_back({shape.shape, keys_of(shape)});
    return shapes;
}

PartsOfObjects read_objects(const TomlTable& section, const std::filesystem::path& directory, SceneFile& file,
                            const Monitor& monitor) {
    PartsOfObjects parts;
    std::vector<NamedTable> tables = named_tables(section);
    MeshFiles meshes(tables, directory, file, monitor);
    for (auto& [name, table] : tables) {
        const ObjectId id{static_cast<std::uint32_t>(file.scene.objects.size())};
        Object object = read_untransformed(table, directory, file, meshes, parts[id]);
        object.name = name;
        const geometry::Transform transform = transform_of(object.shape, table);
        expect_possible(transform, object.shape, table);
        if (transform != geometry::Transform{})
            object.shape = transformed(std::move(object.shape), transform);
        file.scene.objects.push_back(std::move(object));
    }
    return parts;
}

}  // namespace stilb::io
