#include "papers/head_in_room.h"

#include <utility>

#include "base/vec.h"
#include "io/scene/scene_file.h"
#include "materials/diffuse.h"
#include "papers/paper_room.h"
#include "rays/ray_caster.h"

namespace stilb::papers {
namespace {

constexpr double kSize_m = 1.2;
constexpr Vec3 kMiddle_m{2, 4.2, 1.35};  // of the head's box
constexpr Vec3 kEye_m{0.9, 2.1, 1.45};
constexpr double kFov_deg = 26;
constexpr double kReflectance = 0.6;

io::SceneFile paper_room() { return io::read_scene(kPaperRoom, "scenes/paper/room.toml", {}); }

/// Of each vertex: the sum of its triangles' normals, weighted by area.
std::vector<Vec3> vertex_normals(const Mesh& mesh) {
    std::vector<Vec3> normals(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        for (const std::uint32_t corner : {a, b, c}) normals[corner] += normal;
    }
    for (Vec3& normal : normals) normal = normalized(normal);
    return normals;
}

Vec3 smooth_normal_at(const rays::Hit& hit, const Mesh& mesh, const std::vector<Vec3>& normals) {
    const Triangle& corners = mesh.triangles[hit.triangle];
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 to_next = mesh.vertices[corners[(k + 1) % 3]] - hit.position;
        const Vec3 to_last = mesh.vertices[corners[(k + 2) % 3]] - hit.position;
        sum += length(cross(to_next, to_last)) * normals[corners[k]];
    }
    return normalized(sum);
}

}  // namespace

Mesh placed_in_room(Mesh head) {
    const Bounds bounds = bounds_of(head);
    const Vec3 middle = 0.5 * (bounds.min + bounds.max);
    const double scale = kSize_m / (2 * bounds.half_extent());
    for (Vec3& vertex : head.vertices) {
        const Vec3 own = scale * (vertex - middle);
        vertex = kMiddle_m + Vec3{own.x, -own.z, own.y};
    }
    return head;
}

Scene room_with(Shape head) {
    Scene scene = paper_room().scene;
    const MaterialId clay{static_cast<std::uint32_t>(scene.materials.size())};
    scene.materials.push_back({"clay", Diffuse{Rgb::grey(kReflectance)}});
    scene.objects.push_back({"head", std::move(head), {clay}});
    return scene;
}

Sensor view_of_room(const std::array<int, 2>& resolution) {
    Sensor view = paper_room().sensors.front();
    std::get<Camera>(view.kind).resolution = resolution;
    return view;
}

Sensor view_of_head(const std::array<int, 2>& resolution) {
    Sensor view = view_of_room(resolution);
    view.name = "head";
    auto& camera = std::get<Camera>(view.kind);
    camera.position = kEye_m;
    camera.target = kMiddle_m;
    camera.fov_deg = kFov_deg;
    return view;
}

std::vector<HeadPoint> visible_points(const Scene& room_with_mesh, const Camera& camera) {
    const rays::RayCaster caster(room_with_mesh);
    const sensors::CameraView view(camera);
    const auto& mesh = std::get<Mesh>(room_with_mesh.objects.back().shape);
    const std::vector<Vec3> normals = vertex_normals(mesh);
    const auto [width, height] = camera.resolution;
    std::vector<HeadPoint> points;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto hit = caster.closest(view.position(), *view.direction_at(x + 0.5, y + 0.5));
            if (!hit || index_of(hit->object) + 1 != room_with_mesh.objects.size()) continue;
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            points.push_back({pixel, hit->position, smooth_normal_at(*hit, mesh, normals)});
        }
    }
    return points;
}

}  // namespace stilb::papers
