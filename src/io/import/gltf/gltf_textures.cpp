#include "io/import/gltf/gltf_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::gltf {
namespace {

TextureWrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::mirror : TextureWrap::repeat;
}

constexpr std::string_view kLeftOut =
    "it is left out: a colour counts as 0.5 times its factor, another value as its factor";

double component_in(const tinygltf::Value& table, const std::string& key, int index, double otherwise) {
    const tinygltf::Value& list = table.Get(key);
    const bool is_there = list.IsArray() && list.ArrayLen() == 2 && list.Get(index).IsNumber();
    return is_there ? list.Get(index).GetNumberAsDouble() : otherwise;
}

}  // namespace

Uv UvTransform::operator()(const Uv& uv) const {
    const double u = scale_u * uv[0], v = scale_v * uv[1];
    const double c = std::cos(rotation), s = std::sin(rotation);
    return {c * u + s * v + offset_u, -s * u + c * v + offset_v};
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

FacePlace place_of(const PlacedPrimitive& primitive, std::size_t triangle, const UvTransform& transform) {
    if (transform.set >= primitive.uv.size() || primitive.uv[transform.set].empty()) return no_place();
    FacePlace place{};
    for (std::size_t corner = 0; corner < 3; ++corner)
        place[corner] = transform(primitive.uv[transform.set][primitive.mesh.triangles[triangle][corner]]);
    return place;
}

SurfacePoints::SurfacePoints(const std::vector<PlacedPrimitive>& primitives, int material) {
    std::vector<double> areas_m2;
    for (const PlacedPrimitive& primitive : primitives) {
        if (primitive.material != material) continue;
        for (std::uint32_t t = 0; t < primitive.mesh.triangles.size(); ++t) {
            faces_.push_back({&primitive, t});
            areas_m2.push_back(geometry::triangle_area_m2(primitive.mesh, t));
        }
    }
    points_ = points_on_surface(areas_m2);
}

std::vector<Uv> SurfacePoints::uv(const UvTransform& transform) const {
    std::vector<Uv> all;
    for (const auto& [face, barycentric] : points_) {
        const auto& [primitive, triangle] = faces_[face];
        const FacePlace place = place_of(*primitive, triangle, transform);
        if (!has_place(place)) return {};
        all.push_back(uv_at(place, barycentric));
    }
    return all;
}

double SurfacePoints::leave_holes_out(const MaskedTexture& mask, const UvTransform& transform) {
    const std::vector<Uv> places = uv(transform);
    if (places.empty()) return 1;
    std::vector<PointOfTriangle> covered;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!mask.is_hole(mask.map.at(places[i]))) covered.push_back(points_[i]);
    }
    points_ = std::move(covered);
    return static_cast<double>(points_.size()) / static_cast<double>(places.size());
}

std::string Textures::content_of(const tinygltf::Image& image, const std::string& part) {
    if (image.bufferView >= 0) return std::string(file_.bytes_of_view(image.bufferView, part));
    return {image.image.begin(), image.image.end()};  // the parser has read it
}

std::shared_ptr<const Texture> Textures::picture_of(int index, const std::string& part) {
    const tinygltf::Texture& texture = element(file_, file_.model.textures, index, "textures", part);
    if (texture.source < 0) {
        warnings_.add("texture", fmt::format("textures[{}]", index),
                      fmt::format("it has no picture of a format that glTF itself has; {}.", kLeftOut));
        return nullptr;
    }
    const tinygltf::Image& image = element(file_, file_.model.images, texture.source, "images", part);
    const std::string name = fmt::format("images[{}]", texture.source);
    if (const auto known = pictures_.find(texture.source); known != pictures_.end()) return known->second;
    try {
        return pictures_[texture.source] =
                   std::make_shared<const Texture>(read_texture(content_of(image, part), name));
    } catch (const InputError& error) {
        warnings_.add("texture", image.uri.empty() ? name : in_quotes(image.uri.substr(0, 80)),
                      fmt::format("{} ({}).", kLeftOut, error.what()));
        return nullptr;
    }
}

std::optional<TextureMap> Textures::map_of(const tinygltf::TextureInfo& info, const std::string& part) {
    if (info.index < 0) return std::nullopt;
    std::shared_ptr<const Texture> picture = picture_of(info.index, part);
    if (!picture) return std::nullopt;
    const int sampler = file_.model.textures[static_cast<std::size_t>(info.index)].sampler;
    const bool has_sampler = sampler >= 0 && static_cast<std::size_t>(sampler) < file_.model.samplers.size();
    const tinygltf::Sampler wrap =
        has_sampler ? file_.model.samplers[static_cast<std::size_t>(sampler)] : tinygltf::Sampler{};
    return TextureMap{std::move(picture), wrap_of(wrap.wrapS), wrap_of(wrap.wrapT)};
}

std::array<double, 4> Textures::mean(const tinygltf::TextureInfo& info, Texels texels,
                                     const SurfacePoints& surface, const std::string& part,
                                     const std::array<double, 4>& unread) {
    if (info.index < 0) return {1, 1, 1, 1};
    const std::optional<TextureMap> map = map_of(info, part);
    if (!map) return unread;
    // Where the file says nothing about its place, the whole picture counts.
    return mean_of(*map, surface.uv(uv_transform(info)), texels);
}

}  // namespace stilb::io::gltf
