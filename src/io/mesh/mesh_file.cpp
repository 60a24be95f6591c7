#include "io/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "io/text/text.h"

namespace stilb::io {

MeshFile read_mesh_file(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (extension == ".obj") return read_obj(read_whole_file(path), path.string());
    if (extension == ".ply") return read_ply(read_whole_file(path), path.string());
    throw InputError(fmt::format("the extension {} names no mesh format that is read: use .obj or .ply",
                                 in_quotes(extension)),
                     {path.string()});
}

}  // namespace stilb::io
