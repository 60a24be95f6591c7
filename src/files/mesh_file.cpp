#include "files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "files/text.h"

namespace stilb {

MeshFile read_mesh_file(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (extension == ".obj") return read_obj(read_whole_file(path), path.string());
    if (extension == ".ply") return read_ply(read_whole_file(path), path.string());
    throw InputError(fmt::format("the extension {} names no mesh format that is read: use .obj or .ply",
                                 in_quotes(extension)),
                     {path.string()});
}

}  // namespace stilb
