#include "geometry/mesh_part.h"

namespace stilb::geometry {
namespace {

/// The elements that some triangles use, numbered in the order of their first use.
class Used {
  public:
    explicit Used(std::size_t count) : new_number_(count, kNoNumber) {}

    Triangle renumbered(const Triangle& triangle) {
        Triangle numbers{};
        for (std::size_t corner = 0; corner < 3; ++corner) numbers[corner] = renumbered(triangle[corner]);
        return numbers;
    }

    std::vector<Vec3> from(const std::vector<Vec3>& all) const {
        std::vector<Vec3> used;
        used.reserve(old_numbers_.size());
        for (const std::uint32_t number : old_numbers_) used.push_back(all[number]);
        return used;
    }

    /// After that, no element is used.
    void restart() {
        for (const std::uint32_t number : old_numbers_) new_number_[number] = kNoNumber;
        old_numbers_.clear();
    }

  private:
    std::uint32_t renumbered(std::uint32_t number) {
        if (number == kNoNormal) return kNoNormal;
        if (new_number_[number] == kNoNumber) {
            new_number_[number] = static_cast<std::uint32_t>(old_numbers_.size());
            old_numbers_.push_back(number);
        }
        return new_number_[number];
    }

    static constexpr std::uint32_t kNoNumber = ~0u;
    std::vector<std::uint32_t> new_number_, old_numbers_;
};

/// Makes one part after the other; the numbering of the whole mesh's elements is made once.
class Divider {
  public:
    explicit Divider(const Mesh& mesh)
        : mesh_(mesh), vertices_(mesh.vertices.size()), normals_(mesh.normals.size()) {}

    Mesh part(std::span<const std::uint32_t> triangles) {
        Mesh part;
        const bool has_corner_normals = !mesh_.corner_normals.empty();
        part.triangles.reserve(triangles.size());
        if (has_corner_normals) part.corner_normals.reserve(triangles.size());
        for (const std::uint32_t t : triangles) {
            part.triangles.push_back(vertices_.renumbered(mesh_.triangles[t]));
            if (has_corner_normals)
                part.corner_normals.push_back(normals_.renumbered(mesh_.corner_normals[t]));
        }
        part.vertices = vertices_.from(mesh_.vertices);
        if (!mesh_.normals.empty())
            part.normals = (has_corner_normals ? normals_ : vertices_).from(mesh_.normals);
        vertices_.restart();
        normals_.restart();
        return part;
    }

  private:
    const Mesh& mesh_;
    Used vertices_, normals_;
};

}  // namespace

Mesh part_of(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
    return Divider(mesh).part(triangles);
}

std::vector<Mesh> parts_of(const Mesh& mesh, std::span<const std::vector<std::uint32_t>> parts) {
    Divider divider(mesh);
    std::vector<Mesh> meshes;
    meshes.reserve(parts.size());
    for (const std::vector<std::uint32_t>& triangles : parts) meshes.push_back(divider.part(triangles));
    return meshes;
}

std::vector<std::uint32_t> others(std::size_t count, std::span<const std::uint32_t> numbers) {
    std::vector<std::uint32_t> rest;
    auto next = numbers.begin();
    for (std::uint32_t i = 0; i < count; ++i) {
        if (next != numbers.end() && *next == i) {
            ++next;
        } else {
            rest.push_back(i);
        }
    }
    return rest;
}

}  // namespace stilb::geometry
