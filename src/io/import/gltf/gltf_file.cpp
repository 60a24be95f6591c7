#include "io/import/gltf/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::gltf {
namespace {

namespace fs = std::filesystem;

/// The data that parse() and the parser's callbacks share. The callbacks must not throw, because the parser
/// cannot pass exceptions on.
struct FileAccess {
    fs::path folder;
    std::vector<fs::path> read;
    std::string refused;  ///< a path outside of the folder
};

/// Whether a path leads to a place in the folder, by its text.
bool is_within(const fs::path& folder, const fs::path& path) {
    const fs::path relative = path.lexically_normal().lexically_relative(folder.lexically_normal());
    return !relative.empty() && *relative.begin() != "..";
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// The data URI in a path that the parser has made of one whose header it does not know; else empty.
std::string_view data_uri_in(std::string_view path, const FileAccess& access) {
    const std::string folder = access.folder.string();
    if (!path.starts_with(folder)) return {};
    path.remove_prefix(folder.size());
    if (path.starts_with('/')) path.remove_prefix(1);
    return is_data_uri(path) ? path : std::string_view{};
}

bool file_exists(const std::string& path, void* data) {
    auto& access = *static_cast<FileAccess*>(data);
    if (!data_uri_in(path, access).empty()) return true;
    std::error_code error;
    if (!is_within(access.folder, path)) {
        // The parser also looks in the folder of the process; only names beside the scene are the file's own.
        const bool is_beside = path.starts_with(access.folder.string() + "/");
        if (is_beside && access.refused.empty()) access.refused = path;
        return false;
    }
    return fs::is_regular_file(path, error);
}

std::string same_path(const std::string& path, void*) { return path; }

bool read_file(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* data) {
    auto& access = *static_cast<FileAccess*>(data);
    try {
        if (std::string uri(data_uri_in(path, access)); !uri.empty()) {
            std::ranges::replace(uri, ' ', '+');  // the parser decodes paths, in which + is a blank
            const auto content = data_of_uri(uri);
            if (content) bytes->assign(content->begin(), content->end());
            return content.has_value();
        }
        const std::string content = read_whole_file(path);
        bytes->assign(content.begin(), content.end());
        access.read.emplace_back(path);
        return true;
    } catch (const std::exception& failure) {
        *error = failure.what();
        return false;
    }
}

bool write_no_file(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

/// Keeps an image as it is: only textures that matter are decoded, later. Those in buffers stay there,
/// because the parser has not checked their ranges.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

/// The JSON of a file, whichever of its two forms it has.
std::string_view json_of(std::string_view content) {
    constexpr std::size_t kHeader = 20, kLengthAt = 12;
    if (!content.starts_with("glTF") || content.size() < kHeader) return content;
    std::uint32_t length = 0;
    std::memcpy(&length, content.data() + kLengthAt, sizeof length);
    return content.substr(kHeader, length);
}

/// The deepest nesting of arrays and objects: the parser follows it by recursion.
std::size_t nesting_of(std::string_view json) {
    std::size_t depth = 0, deepest = 0;
    bool is_in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_in_text) {
            if (c == '\\') ++i;
            is_in_text = c != '"';
        } else if (c == '"') {
            is_in_text = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
    return deepest;
}

/// The parser's messages as one line. Long words, such as the data in a file, are shortened.
std::string one_line(std::string_view messages) {
    constexpr std::size_t kLongest = 80;
    std::string text(messages), line;
    std::ranges::replace(text, '\n', ' ');
    std::string_view rest = text;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
        line += line.empty() ? "" : " ";
        line += word.substr(0, kLongest);
        if (word.size() > kLongest) line += "...";
    }
    return line;
}

/// Whether a file is of version 1: it says so, or it cannot be read and its list of meshes is a table.
bool is_version_1(std::string_view content, const tinygltf::Model& model, bool is_read) {
    constexpr std::size_t kVersionAt = 4;
    if (content.starts_with("glTF")) return content.size() > kVersionAt && content[kVersionAt] == 1;
    constexpr std::string_view kMeshes = "\"meshes\"", kBlanks = " \t\r\n:";
    const std::size_t meshes = content.find(kMeshes);
    const std::size_t value =
        meshes == content.npos ? meshes : content.find_first_not_of(kBlanks, meshes + kMeshes.size());
    return model.asset.version.starts_with("1.") ||
           (!is_read && value != content.npos && content[value] == '{');
}

}  // namespace

void File::fail(std::string_view part, std::string_view message) const {
    throw InputError(part.empty() ? std::string(message) : fmt::format("{}: {}", part, message),
                     {path.string()});
}

void File::fail_for_extension(const std::string& extension) const {
    fail("", fmt::format("it needs the extension {}, which Stilb does not read. Export the scene without it "
                         "(compression of meshes and textures is usually an option of the exporter).",
                         in_quotes(extension)));
}

std::string File::read_beside(const std::string& uri, std::string_view part) {
    const fs::path place = folder_of(path) / uri;
    if (!is_within(folder_of(path), place)) {
        fail(part,
             fmt::format("the file {} lies outside of the scene's folder. Allowed: files in the folder of "
                         "the scene and below it.",
                         in_quotes(uri)));
    }
    std::error_code error;
    if (!fs::is_regular_file(place, error))
        fail(part, fmt::format("there is no file {}.", in_quotes(place.string())));
    std::string content = read_whole_file(place);
    sources.push_back(place);
    return content;
}

std::string_view File::bytes_of_view(int index, std::string_view part) const {
    const tinygltf::BufferView& view = element(*this, model.bufferViews, index, "bufferViews", part);
    const auto& data =
        element(*this, model.buffers, view.buffer, "buffers", fmt::format("bufferViews[{}]", index)).data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        fail(fmt::format("bufferViews[{}]", index),
             fmt::format("it has {} bytes from byte {} on, but its buffer has {} bytes.", view.byteLength,
                         view.byteOffset, data.size()));
    }
    return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
}

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<std::string> data_of_uri(std::string_view uri) {
    constexpr std::string_view kBase64 = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos || !uri.substr(0, comma).ends_with(kBase64)) return std::nullopt;
    return from_base64(uri.substr(comma + 1));
}

File parse(std::string_view content, const fs::path& path) {
    File file;
    file.path = path;
    if (content.size() > std::numeric_limits<unsigned>::max())
        file.fail("", "the file is larger than 4 GB, the limit of glTF.");
    constexpr std::size_t kMostNesting = 256;
    if (nesting_of(json_of(content)) > kMostNesting)
        file.fail("", fmt::format("its JSON is nested more than {} levels deep.", kMostNesting));
    FileAccess access{folder_of(path), {}, ""};
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_image, nullptr);
    parser.SetFsCallbacks({file_exists, same_path, read_file, write_no_file, &access});
    std::string error, warning;
    const auto size = static_cast<unsigned>(content.size());
    bool is_read = false;
    try {
        is_read = content.starts_with("glTF")
                      ? parser.LoadBinaryFromMemory(&file.model, &error, &warning,
                                                    reinterpret_cast<const unsigned char*>(content.data()),
                                                    size, access.folder.string())
                      : parser.LoadASCIIFromString(&file.model, &error, &warning, content.data(), size,
                                                   access.folder.string());
    } catch (const std::exception& failure) {  // of its JSON parser, at values of unexpected types
        error += failure.what();
    }
    if (!access.refused.empty()) {
        file.fail("",
                  fmt::format("the file {} lies outside of the scene's folder. Allowed: files in the folder "
                              "of the scene and below it.",
                              in_quotes(access.refused)));
    }
    if (is_version_1(content, file.model, is_read)) {
        file.fail("",
                  "this is glTF 1.0, which differs from glTF 2.0, the version that is read. Export the scene "
                  "as glTF 2.0.");
    }
    if (!is_read) {
        // Without the data of such an extension the parser finds accessors without a buffer.
        for (const std::string& extension : file.model.extensionsRequired) {
            if (extension.ends_with("compression")) file.fail_for_extension(extension);
        }
        file.fail("", "no glTF 2.0 that can be read: " + one_line(error));
    }
    file.sources = std::move(access.read);
    return file;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number_in(const tinygltf::Value& table, const std::string& key, double otherwise) {
    const tinygltf::Value& value = table.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

int index_in(const tinygltf::Value& table, const std::string& key) {
    const double number = number_in(table, key, -1);
    const bool is_index = number >= 0 && number <= std::numeric_limits<int>::max();
    return is_index ? static_cast<int>(number) : -1;
}

tinygltf::TextureInfo texture_in(const tinygltf::Value& table, const std::string& key) {
    tinygltf::TextureInfo info;
    const tinygltf::Value& value = table.Get(key);
    if (!value.IsObject()) return info;
    info.index = index_in(value, "index");
    info.texCoord = std::max(0, index_in(value, "texCoord"));
    const tinygltf::Value& extensions = value.Get("extensions");
    if (extensions.IsObject()) info.extensions = extensions.Get<tinygltf::Value::Object>();
    return info;
}

Rgb rgb_of(const std::vector<double>& numbers, const Rgb& otherwise) {
    return numbers.size() < kBands ? otherwise : Rgb{{numbers[0], numbers[1], numbers[2]}};
}

std::vector<double> numbers_in(const tinygltf::Value& table, const std::string& key) {
    const tinygltf::Value& value = table.Get(key);
    std::vector<double> numbers;
    for (std::size_t i = 0; value.IsArray() && i < value.ArrayLen(); ++i) {
        const tinygltf::Value& component = value.Get(static_cast<int>(i));
        if (component.IsNumber()) numbers.push_back(component.GetNumberAsDouble());
    }
    return numbers;
}

Rgb rgb_in(const tinygltf::Value& table, const std::string& key, const Rgb& otherwise) {
    return rgb_of(numbers_in(table, key), otherwise);
}

}  // namespace stilb::io::gltf
