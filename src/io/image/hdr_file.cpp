#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/image/picture.h"
#include "io/image/picture_file.h"
#include "io/image/tone_curve.h"
#include "io/text/radiance_units.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr Triple kWeights = kRadianceWeights;
constexpr double kLumenPerWatt = kRadianceEfficacy_lm_w;
/// The largest storable value [cd/m2]: it fits a float and RGBE.
constexpr double kLargest = 3e38;
constexpr int kExponentBias = 128;
/// Other widths are stored flat: the marker of a run-length encoded scanline has 15 bits for the width.
constexpr int kLeastEncoded = 8, kMostEncoded = 32767;
constexpr std::size_t kShortestRun = 4, kLongestRun = 127, kLongestLiteral = 128;
constexpr std::string_view kPixelFormat = "32-bit_rle_rgbe";

using Rgbe = std::array<std::uint8_t, 4>;

Rgbe to_rgbe(const Triple& rgb) {
    const double largest = std::max({rgb[0], rgb[1], rgb[2]});
    int exponent = 0;
    std::frexp(largest, &exponent);
    if (!(largest > 0) || exponent < 1 - kExponentBias) return {};
    // Radiance cuts mantissas off and adds one half when it reads them. Rounding errors below a whole number
    // must not make equal components differ.
    constexpr double kRounding = 1e-6;
    const auto mantissa = [&](double component) {
        return static_cast<std::uint8_t>(
            std::clamp(std::ldexp(component, 8 - exponent) + kRounding, 0.0, 255.0));
    };
    return {mantissa(rgb[0]), mantissa(rgb[1]), mantissa(rgb[2]),
            static_cast<std::uint8_t>(exponent + kExponentBias)};
}

Triple from_rgbe(const Rgbe& rgbe) {
    if (rgbe[3] == 0) return {};
    const double unit = std::ldexp(1.0, rgbe[3] - kExponentBias - 8);
    return {(rgbe[0] + 0.5) * unit, (rgbe[1] + 0.5) * unit, (rgbe[2] + 0.5) * unit};
}

/// A pixel in Radiance's unit and primaries.
Triple to_radiance(const PrimariesConversion& convert, const std::array<float, 3>& rgb_cd_m2) {
    Rgb wanted;
    for (std::size_t b = 0; b < kBands; ++b)
        wanted[b] = std::clamp(double(rgb_cd_m2[b]), -kLargest, kLargest);
    const double luminance = wanted.luminance();
    if (!(luminance > 0)) return {};
    Triple rgb = convert(wanted.band);
    for (double& component : rgb) component = std::max(component, 0.0);
    // Components below 0 cannot be stored. The luminance that clamping them adds is subtracted again.
    const double stored = kWeights[0] * rgb[0] + kWeights[1] * rgb[1] + kWeights[2] * rgb[2];
    for (double& component : rgb) component *= luminance / stored / kLumenPerWatt;
    return rgb;
}

/// A pixel in Radiance's unit, its bands as they are.
Triple unconverted(const std::array<float, 3>& rgb_cd_m2) {
    Triple rgb{};
    for (std::size_t b = 0; b < kBands; ++b)
        rgb[b] = std::clamp(double(rgb_cd_m2[b]), 0.0, kLargest) / kLumenPerWatt;
    return rgb;
}

std::string to_header(const Picture& picture, const Primaries& primaries) {
    std::string header = "#?RADIANCE\n";
    for (const HeaderField& field : header_fields(picture)) {
        std::string name = field.name;
        std::transform(name.begin(), name.end(), name.begin(),
                       [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
        header += fmt::format("{}= {}\n", name, field.text);
    }
    header += "EXPOSURE= 1\nPRIMARIES=";
    for (const auto& [x, y] : primaries) header += fmt::format(" {:.4f} {:.4f}", x, y);
    return header + fmt::format("\nFORMAT={}\n\n-Y {} +X {}\n", kPixelFormat, picture.height, picture.width);
}

std::size_t run_length(const std::vector<Rgbe>& pixels, std::size_t channel, std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < pixels.size() && end - begin < kLongestRun && pixels[end][channel] == pixels[begin][channel])
        ++end;
    return end - begin;
}

void append_encoded(const std::vector<Rgbe>& pixels, std::size_t channel, std::string& content) {
    std::size_t at = 0;
    while (at < pixels.size()) {
        const std::size_t run = run_length(pixels, channel, at);
        if (run >= kShortestRun) {
            content += static_cast<char>(128 + run);
            content += static_cast<char>(pixels[at][channel]);
            at += run;
            continue;
        }
        std::size_t end = at;
        while (end < pixels.size() && end - at < kLongestLiteral &&
               run_length(pixels, channel, end) < kShortestRun)
            ++end;
        content += static_cast<char>(end - at);
        for (; at < end; ++at) content += static_cast<char>(pixels[at][channel]);
    }
}

void append_scanline(const std::vector<Rgbe>& pixels, std::string& content) {
    const int width = static_cast<int>(pixels.size());
    if (width < kLeastEncoded || width > kMostEncoded) {
        for (const Rgbe& pixel : pixels) content.append(pixel.begin(), pixel.end());
        return;
    }
    content += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)};
    for (std::size_t channel = 0; channel < 4; ++channel) append_encoded(pixels, channel, content);
}

class HdrReader {
  public:
    HdrReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

    Picture read() && {
        read_header();
        read_resolution();
        for (const HeaderField& field : fields_) read_header_field(picture_, field.name, field.text);
        bytes_ = lines_.rest().in_memory();
        const PrimariesConversion convert(primaries_, kRec709);
        std::vector<Rgbe> scanline(static_cast<std::size_t>(picture_.width));
        for (row_ = 0; row_ < picture_.height; ++row_) {
            read_scanline(scanline);
            for (const Rgbe& pixel : scanline) {
                const Triple rgb = convert(from_rgbe(pixel));
                picture_.rgb_cd_m2.push_back({to_cd_m2(rgb[0]), to_cd_m2(rgb[1]), to_cd_m2(rgb[2])});
            }
        }
        return std::move(picture_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {name_, row_ < 0 ? lines_.number() : 0});
    }

    void read_header() {
        if (!lines_.next() || !lines_.line().starts_with("#?"))
            fail("not a Radiance picture: it does not begin with \"#?RADIANCE\".");
        while (lines_.next() && !lines_.line().empty()) {
            const std::string_view line = lines_.line();
            const std::size_t equals = line.find('=');
            if (equals == line.npos) continue;
            read_variable(line.substr(0, equals), trimmed(line.substr(equals + 1)));
        }
    }

    void read_variable(std::string_view variable, std::string_view text) {
        if (variable == "FORMAT" && text != kPixelFormat) {
            fail(fmt::format("FORMAT={} cannot be read. Only {} can.", in_quotes(text), kPixelFormat));
        } else if (variable == "EXPOSURE") {
            exposure_ *= parse_number(text).value_or(0);
            if (!(exposure_ > 1e-30 && exposure_ < 1e30))
                fail(fmt::format("EXPOSURE={} is not a usable number above 0.", in_quotes(text)));
        } else if (variable == "PRIMARIES") {
            for (auto& chromaticity : primaries_) {
                for (double& coordinate : chromaticity)
                    coordinate = parse_number(next_word(text)).value_or(0);
            }
            if (!are_usable(primaries_)) fail("PRIMARIES are not eight usable chromaticity coordinates.");
        } else {
            fields_.push_back({std::string(variable), std::string(text)});
        }
    }

    void read_resolution() {
        if (!lines_.next()) fail("the file ends within its header.");
        std::string_view words = lines_.line();
        const std::string_view first = next_word(words);
        const long long height = parse_integer(next_word(words)).value_or(0);
        const std::string_view second = next_word(words);
        const long long width = parse_integer(next_word(words)).value_or(0);
        if (first != "-Y" || second != "+X" || height <= 0 || width <= 0) {
            fail(
                fmt::format("the resolution {} cannot be read. Only \"-Y height +X width\" can (rows from "
                            "the top, pixels from left to right).",
                            in_quotes(lines_.line())));
        }
        if (!is_readable_size(width, height)) fail(too_large_message(width, height));
        picture_.width = static_cast<int>(width);
        picture_.height = static_cast<int>(height);
    }

    std::uint8_t next_byte() {
        if (bytes_.empty())
            fail(fmt::format("the file ends within row {} of {}.", row_ + 1, picture_.height));
        const auto byte = static_cast<std::uint8_t>(bytes_.front());
        bytes_.remove_prefix(1);
        return byte;
    }

    Rgbe next_pixel() {
        Rgbe pixel;
        for (std::uint8_t& byte : pixel) byte = next_byte();
        return pixel;
    }

    bool is_encoded() const {
        const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes_[i]); };
        return picture_.width >= kLeastEncoded && picture_.width <= kMostEncoded && bytes_.size() >= 4 &&
               byte(0) == 2 && byte(1) == 2 && byte(2) < 128;
    }

    void read_scanline(std::vector<Rgbe>& scanline) {
        if (!is_encoded()) return read_flat(scanline);
        const Rgbe marker = next_pixel();
        if ((marker[2] << 8 | marker[3]) != picture_.width) fail_row("is encoded with another width");
        for (std::size_t channel = 0; channel < 4; ++channel) {
            for (std::size_t at = 0; at < scanline.size();) {
                const std::uint8_t code = next_byte();
                const bool is_run = code > 128;
                const std::size_t count = is_run ? code - 128u : code;
                if (count == 0 || count > scanline.size() - at) fail_row("has a run that does not fit it");
                const std::uint8_t value = is_run ? next_byte() : std::uint8_t{0};
                for (const std::size_t end = at + count; at < end; ++at)
                    scanline[at][channel] = is_run ? value : next_byte();
            }
        }
    }

    /// Uncompressed pixels. (1, 1, 1, n) repeats the last pixel n times; n counts 256 times more with each
    /// such pixel in succession.
    void read_flat(std::vector<Rgbe>& scanline) {
        int shift = 0;
        for (std::size_t at = 0; at < scanline.size();) {
            const Rgbe pixel = next_pixel();
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                scanline[at++] = pixel;
                shift = 0;
                continue;
            }
            const std::size_t count = std::size_t{pixel[3]} << shift;
            if (at == 0 || shift > 24 || count > scanline.size() - at)
                fail_row("has a run that does not fit it");
            std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(at), count, scanline[at - 1]);
            at += count;
            shift += 8;
        }
    }

    [[noreturn]] void fail_row(std::string_view what) const {
        fail(fmt::format("row {} of {} {} (the file is damaged).", row_ + 1, picture_.height, what));
    }

    float to_cd_m2(double component) const {
        return static_cast<float>(std::clamp(component * kLumenPerWatt / exposure_, -kLargest, kLargest));
    }

    TextLines lines_;
    const std::string& name_;
    Picture picture_;
    std::vector<HeaderField> fields_;  ///< until the resolution line is read
    double exposure_ = 1;
    Primaries primaries_ = kRadiance;
    std::string_view bytes_;
    int row_ = -1;
};

}  // namespace

std::string to_hdr(const Picture& picture, HdrBands bands) {
    require_consistency(picture);
    const PrimariesConversion convert(kRec709, kRadiance);
    const auto stored = [&](const std::array<float, 3>& rgb) {
        return bands == HdrBands::radiance ? to_radiance(convert, rgb) : unconverted(rgb);
    };
    std::string content = to_header(picture, bands == HdrBands::radiance ? kRadiance : kRec709);
    const auto width = static_cast<std::size_t>(picture.width);
    std::vector<Rgbe> scanline(width);
    for (std::size_t first = 0; first < picture.pixel_count(); first += width) {
        for (std::size_t x = 0; x < width; ++x) scanline[x] = to_rgbe(stored(picture.rgb_cd_m2[first + x]));
        append_scanline(scanline, content);
    }
    return content;
}

Picture read_hdr(std::string_view content, const std::string& name) {
    return HdrReader(content, name).read();
}

}  // namespace stilb::io
