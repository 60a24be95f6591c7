#include "io/import/gltf/gltf_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::gltf {
namespace {

constexpr std::size_t kPoints = 16384;
/// Irrational steps that fill the unit square evenly (Roberts, the R2 sequence).
constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;

double triangle_area_m2(const Mesh& mesh, std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
}

double fraction(double value) { return value - std::floor(value); }

/// The position in the picture that the sampler takes for a coordinate.
double wrapped(double coordinate, int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return std::clamp(coordinate, 0.0, 1.0);
    if (mode != TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return fraction(coordinate);
    const double turn = fraction(coordinate / 2) * 2;
    return turn <= 1 ? turn : 2 - turn;
}

/// KHR_texture_transform.
struct UvTransform {
    double offset_u = 0, offset_v = 0, scale_u = 1, scale_v = 1, rotation = 0;
    std::size_t set = 0;

    std::array<double, 2> operator()(const std::array<double, 2>& uv) const {
        const double u = scale_u * uv[0], v = scale_v * uv[1];
        const double c = std::cos(rotation), s = std::sin(rotation);
        return {c * u + s * v + offset_u, -s * u + c * v + offset_v};
    }
};

double component_in(const tinygltf::Value& table, const std::string& key, int index, double otherwise) {
    const tinygltf::Value& list = table.Get(key);
    const bool is_there = list.IsArray() && list.ArrayLen() == 2 && list.Get(index).IsNumber();
    return is_there ? list.Get(index).GetNumberAsDouble() : otherwise;
}

UvTransform uv_transform(const tinygltf::TextureInfo& info) {
    UvTransform transform;
    transform.set = static_cast<std::size_t>(std::max(info.texCoord, 0));
    const tinygltf::Value* const table = find_extension(info.extensions, "KHR_texture_transform");
    if (table == nullptr) return transform;
    transform.offset_u = component_in(*table, "offset", 0, 0);
    transform.offset_v = component_in(*table, "offset", 1, 0);
    transform.scale_u = component_in(*table, "scale", 0, 1);
    transform.scale_v = component_in(*table, "scale", 1, 1);
    transform.rotation = number_in(*table, "rotation", 0);
    if (const int set = index_in(*table, "texCoord"); set >= 0) transform.set = static_cast<std::size_t>(set);
    return transform;
}

}  // namespace

SurfacePoints::SurfacePoints(const std::vector<PlacedPrimitive>& primitives, int material) {
    std::vector<Point> triangles;
    std::vector<double> area_until;
    double total = 0;
    for (const PlacedPrimitive& primitive : primitives) {
        if (primitive.material != material) continue;
        for (std::uint32_t t = 0; t < primitive.mesh.triangles.size(); ++t) {
            triangles.push_back({&primitive, t, {}});
            area_until.push_back(total += triangle_area_m2(primitive.mesh, t));
        }
    }
    for (std::size_t i = 0; i < kPoints && !triangles.empty(); ++i) {
        const double at = total * (static_cast<double>(i) + 0.5) / kPoints;
        const auto found = std::ranges::lower_bound(area_until, at) - area_until.begin();
        Point point = triangles[std::min(static_cast<std::size_t>(found), triangles.size() - 1)];
        double u = fraction(kStepU * static_cast<double>(i)), v = fraction(kStepV * static_cast<double>(i));
        if (u + v > 1) u = 1 - u, v = 1 - v;
        point.weights = {1 - u - v, u, v};
        points_.push_back(point);
    }
}

std::vector<std::array<double, 2>> SurfacePoints::uv(std::size_t set) const {
    std::vector<std::array<double, 2>> all;
    for (const auto& [primitive, triangle, weights] : points_) {
        if (set >= primitive->uv.size() || primitive->uv[set].empty()) return {};
        std::array<double, 2> uv{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto& at = primitive->uv[set][primitive->mesh.triangles[triangle][corner]];
            for (std::size_t i = 0; i < 2; ++i) uv[i] += weights[corner] * at[i];
        }
        all.push_back(uv);
    }
    return all;
}

std::string Textures::content_of(const tinygltf::Image& image, const std::string& part) {
    if (image.bufferView >= 0) return std::string(file_.bytes_of_view(image.bufferView, part));
    return {image.image.begin(), image.image.end()};  // the parser has read it
}

const Texture* Textures::texture_of(int index, const std::string& part) {
    const tinygltf::Texture& texture = element(file_, file_.model.textures, index, "textures", part);
    if (texture.source < 0) {
        warnings_.add("texture", fmt::format("textures[{}]", index),
                      "it has no picture of a format that glTF itself has; it is left out.");
        return nullptr;
    }
    const tinygltf::Image& image = element(file_, file_.model.images, texture.source, "images", part);
    const std::string name = fmt::format("images[{}]", texture.source);
    if (const auto known = textures_.find(texture.source); known != textures_.end()) return &known->second;
    try {
        return &textures_.try_emplace(texture.source, read_texture(content_of(image, part), name))
                    .first->second;
    } catch (const InputError& error) {
        warnings_.add("texture", image.uri.empty() ? name : in_quotes(image.uri.substr(0, 80)),
                      fmt::format("it is left out ({}).", error.what()));
        return nullptr;
    }
}

std::array<double, 4> Textures::mean(const tinygltf::TextureInfo& info, bool is_colour,
                                     const SurfacePoints& surface, const std::string& part) {
    constexpr std::array<double, 4> ones{1, 1, 1, 1};
    if (info.index < 0) return ones;
    const Texture* const texture = texture_of(info.index, part);
    if (texture == nullptr) return ones;
    const UvTransform transform = uv_transform(info);
    std::vector<std::array<double, 2>> uv = surface.uv(transform.set);
    if (uv.empty()) {  // the file says nothing about its place: the whole picture counts
        for (std::size_t i = 0; i < kPoints; ++i)
            uv.push_back(
                {fraction(kStepU * static_cast<double>(i)), fraction(kStepV * static_cast<double>(i))});
    }
    const int sampler = file_.model.textures[static_cast<std::size_t>(info.index)].sampler;
    const bool has_sampler = sampler >= 0 && static_cast<std::size_t>(sampler) < file_.model.samplers.size();
    const tinygltf::Sampler wrap =
        has_sampler ? file_.model.samplers[static_cast<std::size_t>(sampler)] : tinygltf::Sampler{};
    std::array<double, 4> sum{};
    for (const auto& at : uv) {
        const auto [u, v] = transform(at);
        if (!std::isfinite(u) || !std::isfinite(v)) return ones;
        const auto& texel = texture->at(wrapped(u, wrap.wrapS), wrapped(v, wrap.wrapT));
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += is_colour && c < 3 ? linear_of_srgb(texel[c]) : texel[c] / 255.0;
    }
    for (double& value : sum) value /= static_cast<double>(uv.size());
    return sum;
}

}  // namespace stilb::io::gltf
