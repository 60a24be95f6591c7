#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "io/image/picture.h"
#include "io/image/picture_file.h"
#include "io/image/tone_curve.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr std::array<const char*, 3> kRgbNames{"R", "G", "B"};
constexpr std::array<const char*, 3> kNormalNames{"N.X", "N.Y", "N.Z"};
constexpr const char* kLuminanceName = "Y";
constexpr const char* kErrorName = "SE.Y";
constexpr const char* kDepthName = "Z";

/// The channels of one file, each with the address of its values.
class Channels {
  public:
    Channels(int width, const Imath::V2i& first) : width_(static_cast<std::size_t>(width)), first_(first) {}

    void add(const std::string& name, const float* values, std::size_t stride = 1) {
        buffer_.insert(name, Imf::Slice::Make(Imf::FLOAT, values, first_, static_cast<std::int64_t>(width_),
                                              0, stride * sizeof(float), stride * sizeof(float) * width_));
    }
    template <typename Name>
    void add(const std::array<Name, 3>& names, const std::vector<std::array<float, 3>>& values) {
        for (std::size_t i = 0; i < 3; ++i) add(names[i], values.front().data() + i, 3);
    }
    const Imf::FrameBuffer& buffer() const { return buffer_; }

  private:
    std::size_t width_;
    Imath::V2i first_;
    Imf::FrameBuffer buffer_;
};

/// "Combined_panel.R" and so on, as Cycles names the layers of light groups. A dot would divide the name.
std::array<std::string, 3> names_of(const PictureLayer& layer) {
    std::string name = "Combined_" + layer.name;
    std::ranges::replace(name, '.', '_');
    return {name + ".R", name + ".G", name + ".B"};
}

Imf::Chromaticities to_chromaticities(const Primaries& primaries) {
    const auto point = [&](std::size_t i) {
        return Imath::V2f(static_cast<float>(primaries[i][0]), static_cast<float>(primaries[i][1]));
    };
    return {point(0), point(1), point(2), point(3)};
}

/// Whole numbers from here on, such as long seeds, are texts: a double would round them.
constexpr double kMostInDouble = 1e15;

Imf::Header header_of(const Picture& picture) {
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::PIZ_COMPRESSION;  // of noise, smaller and sooner than the other ones
    Imf::addWhiteLuminance(header, 1);
    Imf::addChromaticities(header, to_chromaticities(kRec709));
    for (const HeaderField& field : header_fields(picture)) {
        const double number =
            field.is_number ? parse_number(field.text).value_or(kMostInDouble) : kMostInDouble;
        if (number < kMostInDouble)
            header.insert(field.name, Imf::DoubleAttribute(number));
        else
            header.insert(field.name, Imf::StringAttribute(field.text));
    }
    return header;
}

/// True where the primaries differ from Rec. 709 by more than float and decimal rounding.
std::optional<Primaries> other_primaries(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    const Imf::Chromaticities& found = Imf::chromaticities(header);
    Primaries primaries;
    double difference = 0;
    const std::array<Imath::V2f, 4> points{found.red, found.green, found.blue, found.white};
    for (std::size_t i = 0; i < 4; ++i) {
        primaries[i] = {points[i].x, points[i].y};
        difference = std::max({difference, std::abs(primaries[i][0] - kRec709[i][0]),
                               std::abs(primaries[i][1] - kRec709[i][1])});
    }
    // !(<=) treats NaN as different; such primaries then count as unusable.
    return !(difference <= 2e-4) ? std::optional(primaries) : std::nullopt;
}

class ExrReader {
  public:
    ExrReader(const std::string& content, const std::string& name) : name_(name) {
        stream_.str(content);
        file_.emplace(stream_);
    }

    Picture read() {
        const Imath::Box2i window = file_->header().dataWindow();
        const long long width = window.max.x - 1ll * window.min.x + 1;
        const long long height = window.max.y - 1ll * window.min.y + 1;
        if (!is_readable_size(width, height)) fail(too_large_message(width, height));
        picture_.width = static_cast<int>(width);
        picture_.height = static_cast<int>(height);
        read_channels(window.min);
        apply_white_and_primaries();
        const Imf::Header& header = file_->header();
        for (auto it = header.begin(); it != header.end(); ++it) {
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
                read_header_field(picture_, it.name(), text->value());
            if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&it.attribute()))
                read_header_field(picture_, it.name(), fmt::format("{:.15g}", number->value()));
        }
        return std::move(picture_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { throw InputError(message, {name_}); }

    bool has(const char* channel) const {
        const Imf::Channel* found = file_->header().channels().findChannel(channel);
        return found != nullptr && found->xSampling == 1 && found->ySampling == 1;
    }
    bool has(const std::array<const char*, 3>& channels) const {
        return std::all_of(channels.begin(), channels.end(), [&](const char* name) { return has(name); });
    }

    std::string channel_names() const {
        std::string names;
        const Imf::ChannelList& channels = file_->header().channels();
        for (auto it = channels.begin(); it != channels.end(); ++it)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", it.name());
        return names;
    }

    void read_channels(const Imath::V2i& first) {
        const std::size_t count = picture_.pixel_count();
        Channels channels(picture_.width, first);
        picture_.rgb_cd_m2.resize(count);
        const bool is_coloured = has(kRgbNames);
        if (is_coloured) {
            channels.add(kRgbNames, picture_.rgb_cd_m2);
        } else if (has(kLuminanceName)) {
            channels.add(kLuminanceName, picture_.rgb_cd_m2.front().data(), 3);
        } else {
            fail(fmt::format("the channels R, G, B or Y are missing in full resolution (the file has {}).",
                             channel_names()));
        }
        const auto add_optional = [&](const char* name, std::vector<float>& values) {
            if (!has(name)) return;
            values.resize(count);
            channels.add(name, values.data());
        };
        add_optional(kErrorName, picture_.standard_error_cd_m2);
        add_optional(kDepthName, picture_.depth_m);
        if (has(kNormalNames)) {
            picture_.normals.resize(count);
            channels.add(kNormalNames, picture_.normals);
        }
        file_->setFrameBuffer(channels.buffer());
        file_->readPixels(first.y, first.y + picture_.height - 1);
        if (!is_coloured) {
            for (std::array<float, 3>& rgb : picture_.rgb_cd_m2) rgb[1] = rgb[2] = rgb[0];
        }
    }

    void apply_white_and_primaries() {
        const Imf::Header& header = file_->header();
        if (Imf::hasWhiteLuminance(header)) scale_by(Imf::whiteLuminance(header));
        if (const std::optional<Primaries> primaries = other_primaries(header)) {
            if (!are_usable(*primaries)) fail("its chromaticities do not span a colour space.");
            const PrimariesConversion convert(*primaries, kRec709);
            for (std::array<float, 3>& rgb : picture_.rgb_cd_m2) {
                const Triple converted = convert({rgb[0], rgb[1], rgb[2]});
                for (std::size_t i = 0; i < 3; ++i) rgb[i] = static_cast<float>(converted[i]);
            }
        }
    }

    void scale_by(float factor) {
        if (!(factor > 0 && std::isfinite(factor))) fail("its whiteLuminance is not a number above 0.");
        for (std::array<float, 3>& rgb : picture_.rgb_cd_m2) {
            for (float& component : rgb) component *= factor;
        }
        for (float& error : picture_.standard_error_cd_m2) error *= factor;
    }

    const std::string& name_;
    Imf::StdISStream stream_;
    std::optional<Imf::InputFile> file_;
    Picture picture_;
};

}  // namespace

std::string to_exr(const Picture& picture) {
    require_consistency(picture);
    std::vector<float> luminance(picture.pixel_count());
    for (std::size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = static_cast<float>(picture.luminance_cd_m2(i));
    Channels channels(picture.width, {0, 0});
    channels.add(kRgbNames, picture.rgb_cd_m2);
    channels.add(kLuminanceName, luminance.data());
    if (!picture.standard_error_cd_m2.empty()) channels.add(kErrorName, picture.standard_error_cd_m2.data());
    if (!picture.normals.empty()) channels.add(kNormalNames, picture.normals);
    if (!picture.depth_m.empty()) channels.add(kDepthName, picture.depth_m.data());
    for (const PictureLayer& layer : picture.layers) channels.add(names_of(layer), layer.rgb_cd_m2);

    Imf::Header header = header_of(picture);
    for (auto it = channels.buffer().begin(); it != channels.buffer().end(); ++it)
        header.channels().insert(it.name(), Imf::Channel(Imf::FLOAT));
    Imf::StdOSStream stream;
    const auto threads = static_cast<int>(std::thread::hardware_concurrency());
    Imf::setGlobalThreadCount(threads);
    {
        Imf::OutputFile file(stream, header, threads);
        file.setFrameBuffer(channels.buffer());
        file.writePixels(picture.height);
    }  // the destructor completes the stream
    return stream.str();
}

Picture read_exr(std::string_view content, const std::string& name) {
    try {
        return ExrReader(std::string(content), name).read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("not a readable OpenEXR picture, or damaged ({}).", error.what()),
                         {name});
    }
}

}  // namespace stilb::io
