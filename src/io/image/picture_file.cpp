#include "io/image/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "io/image/exr_file.h"
#include "io/image/hdr_file.h"
#include "io/image/png_picture.h"
#include "io/text/text.h"
#include "io/text/write_file.h"

namespace stilb::io {
namespace {

constexpr std::string_view kExrBeginning = "\x76\x2f\x31\x01";
constexpr std::string_view kHdrBeginning = "#?";

/// The extension in lower case; InputError where no luminance picture can have it.
std::string luminance_picture_extension(const std::filesystem::path& path) {
    std::string extension = extension_of(path);
    if (extension != ".exr" && extension != ".hdr" && extension != ".png") {
        throw InputError(fmt::format(
            "cannot tell the kind of picture from '{}'. End the name in .exr, .hdr or .png.", path.string()));
    }
    return extension;
}

}  // namespace

void require_luminance_picture_path(const std::filesystem::path& path) {
    luminance_picture_extension(path);
    require_folder_of(path);
}

std::optional<ToneCurve> write_picture(const Picture& picture, const std::filesystem::path& path,
                                       const ToneOptions& tone) {
    const std::string extension = luminance_picture_extension(path);
    if (extension == ".png") {
        const ToneCurve curve(tone.exposure ? *tone.exposure : automatic_exposure(picture));
        replace_file(path, to_png(picture, curve));
        return curve;
    }
    replace_file(path, extension == ".exr" ? to_exr(picture) : to_hdr(picture));
    return std::nullopt;
}

bool is_picture_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string beginning(kExrBeginning.size(), '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    if (!file.is_open() || file.bad()) throw InputError("cannot be read. Does it exist?", {path.string()});
    return beginning == kExrBeginning || beginning.starts_with(kHdrBeginning);
}

Picture read_picture(const std::filesystem::path& path) {
    const std::string content = read_whole_file(path);
    if (content.starts_with(kExrBeginning)) return read_exr(content, path.string());
    if (content.starts_with(kHdrBeginning)) return read_hdr(content, path.string());
    throw InputError("neither an OpenEXR (.exr) nor a Radiance picture (.hdr). Only these can be read.",
                     {path.string()});
}

}  // namespace stilb::io
