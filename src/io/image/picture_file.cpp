
#include "io/image/picture_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/image/picture.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

/// The kind of picture that the extension stands for. Throws InputError where it belongs to no format of
/// luminance pictures. Standard output gets OpenEXR.
FileKind luminance_picture_kind(const std::filesystem::path& path) {
    if (is_standard_output(path)) return FileKind::exr_picture;
    const FileKind kind = kind_of_name(path);
    if (!is_luminance_picture(kind) && kind != FileKind::png_picture) {
        throw InputError(fmt::format(
            "cannot tell the kind of picture from '{}'. End the name in .exr, .hdr or .png.", path.string()));
    }
    return kind;
}

}  // namespace

void require_luminance_picture_path(const std::filesystem::path& path,
                                    std::span<const std::filesystem::path> inputs) {
    require_output(path, luminance_picture_kind(path), inputs);
}

std::optional<ToneCurve> write_picture(const Picture& picture, const std::filesystem::path& path,
                                       const ToneOptions& tone) {
    const FileKind kind = luminance_picture_kind(path);
    if (kind == FileKind::png_picture) {
        const ToneCurve curve = tone_curve_for(picture, tone);
        replace_file(path, to_png(picture, curve));
        return curve;
    }
    replace_file(path, kind == FileKind::exr_picture ? to_exr(picture) : to_hdr(picture));
    return std::nullopt;
}

bool is_picture_file(const std::filesystem::path& path) {
    return is_luminance_picture(kind_of_content_of(path));
}

Picture read_picture(const std::filesystem::path& path) {
    const std::string content = read_whole_file(path);
    const FileKind kind = kind_of_content(content);
    if (kind == FileKind::exr_picture) return read_exr(content, path.string());
    if (kind == FileKind::hdr_picture) return read_hdr(content, path.string());
    throw InputError("neither an OpenEXR (.exr) nor a Radiance picture (.hdr). Only these can be read.",
                     {path.string()});
}

namespace {

/// The output of libpng, a std::string that collects the file.
void append(png_structp png, png_bytep data, std::size_t length) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), length);
}

void flush(png_structp) {}

std::vector<HeaderField> texts_of(const Picture& picture, const ToneCurve& curve) {
    std::vector<HeaderField> texts{{"Exposure", fmt::format("{} per cd/m2", curve.exposure())},
                                   {"Tone curve", curve.description()},
                                   {"White", fmt::format("{:.0f} K", curve.white_k())}};
    for (HeaderField& field : header_fields(picture)) texts.push_back(std::move(field));
    return texts;
}

/// PNG's plain texts are Latin-1, its international ones UTF-8. The result refers to `texts`.
std::vector<png_text> to_png_texts(std::vector<HeaderField>& texts) {
    std::vector<png_text> result;
    for (HeaderField& field : texts) {
        const bool is_ascii = std::all_of(field.text.begin(), field.text.end(),
                                          [](char c) { return static_cast<unsigned char>(c) < 128; });
        png_text& text = result.emplace_back(png_text{});
        text.compression = is_ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = field.name.data();
        text.text = field.text.data();
        (is_ascii ? text.text_length : text.itxt_length) = field.text.size();
    }
    return result;
}

std::vector<png_byte> pixels_of(const Picture& picture, const ToneCurve& curve) {
    std::vector<png_byte> pixels;
    pixels.reserve(3 * picture.pixel_count());
    for (const std::array<float, 3>& rgb : picture.rgb_cd_m2) {
        const std::array<std::uint8_t, 3> shown = curve.srgb(rgb);
        pixels.insert(pixels.end(), shown.begin(), shown.end());
    }
    return pixels;
}

/// The writing state of libpng; its structs are destroyed with it.
struct Writer {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

/// Returns false where libpng fails: it returns by longjmp, past no object that has a destructor.
bool write(const Writer& writer, int width, int height, const png_text* texts, int text_count,
           const png_byte* pixels) {
    if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(writer.png, writer.info, texts, text_count);
    png_write_info(writer.png, writer.info);
    for (int y = 0; y < height; ++y) png_write_row(writer.png, pixels + 3 * std::ptrdiff_t{width} * y);
    png_write_end(writer.png, nullptr);
    return true;
}

}  // namespace

std::string to_png(const Picture& picture, const ToneCurve& curve) {
    require_consistency(picture);
    std::vector<HeaderField> texts = texts_of(picture, curve);
    const std::vector<png_text> png_texts = to_png_texts(texts);
    const std::vector<png_byte> pixels = pixels_of(picture, curve);
    std::string content;
    const Writer writer;
    if (writer.info == nullptr) throw std::runtime_error("libpng cannot create a picture");
    png_set_write_fn(writer.png, &content, append, flush);
    if (!write(writer, picture.width, picture.height, png_texts.data(), static_cast<int>(png_texts.size()),
               pixels.data()))
        throw std::runtime_error("libpng cannot write the picture");
    return content;
}

}  // namespace stilb::io
