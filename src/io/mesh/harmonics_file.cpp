#include "io/mesh/harmonics_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "base/version.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "math/spherical_harmonics.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

class Reader {
  public:
    explicit Reader(const std::string& name) : name_(name) {}

    [[noreturn]] void fail(const std::string& message, std::size_t line = 0) const {
        throw InputError(message, {name_, line});
    }

    Json parsed(std::string_view content) const {
        try {
            return Json::parse(content);
        } catch (const Json::parse_error& error) {
            const std::size_t end = std::min(error.byte, content.size());
            const auto before = content.substr(0, end);
            fail("not JSON, so not a surface by spherical harmonics.",
                 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')));
        } catch (const Json::out_of_range&) {
            fail("a number is too large for a double");
        }
    }

    const Json& member(const Json& json, const char* key) const {
        const auto found = json.find(key);
        if (found == json.end()) fail(fmt::format("\"{}\" is missing. It should be {}.", key, expected(key)));
        return *found;
    }

    int whole(const Json& json, const char* key) const {
        const Json& value = member(json, key);
        if (!value.is_number_integer() || std::abs(value.get<double>()) > 1e9) {
            fail(fmt::format("\"{}\" is {}. It should be {}.", key, shown(value), expected(key)));
        }
        return value.get<int>();
    }

    std::vector<double> numbers(const Json& json, const char* key, std::size_t count) const {
        const Json& list = member(json, key);
        if (!list.is_array() || list.size() != count) {
            const std::string found =
                list.is_array() ? fmt::format("a list of {}", list.size()) : list.type_name();
            fail(fmt::format("\"{}\" is {}. It should be a list of {} numbers: {}.", key, found, count,
                             expected(key)));
        }
        std::vector<double> values;
        for (const Json& element : list) {
            if (!element.is_number() ||
                !(std::abs(element.get<double>()) <= std::numeric_limits<float>::max())) {
                fail(fmt::format("{}[{}] is {}. It should be a number that single precision can hold.", key,
                                 values.size(), shown(element)));
            }
            values.push_back(element.get<double>());
        }
        return values;
    }

  private:
    static std::string shown(const Json& json) {
        return json.is_primitive() ? in_quotes(json.dump(-1, ' ', true, Json::error_handler_t::replace))
                                   : json.type_name();
    }
    static std::string expected(std::string_view key) {
        if (key == "format") return fmt::format("\"{}\"", kSeriesFormat);
        if (key == "version") return fmt::format("{}", kVersion);
        if (key == "degree") return fmt::format("a whole number from 0 to {}", math::kMostHarmonicDegree);
        if (key == "center") return "x, y and z";
        return "(degree + 1)^2 coefficients, that of Y_lm as number l^2 + l + m";
    }

    const std::string& name_;
};

/// The number in its fewest digits; 0 has no sign, like JSON's integers.
template <typename T>
std::string shortest(T number) {
    return fmt::format("{}", number + T{0});
}

std::string list_text(std::span<const double> values) {
    std::string text;
    for (const double value : values) {
        text += (text.empty() ? "" : ", ") + shortest(static_cast<float>(value));
    }
    return text;
}

}  // namespace

HarmonicsFile parse_harmonics(std::string_view content, const std::string& name) {
    const Reader reader(name);
    const Json json = reader.parsed(content);
    if (!json.is_object() || json.value("format", Json()) != Json(kSeriesFormat)) {
        reader.fail(
            fmt::format("JSON, but not a surface by spherical harmonics: it lacks \"format\": "
                        "\"{}\".",
                        kSeriesFormat));
    }
    const int version = reader.whole(json, "version");
    if (version != kVersion) {
        reader.fail(
            fmt::format("the file has version {} of the format, but Stilb {} reads version {}. Fit "
                        "the mesh again.",
                        version, program_version(), kVersion));
    }
    const int degree = reader.whole(json, "degree");
    if (degree < 0 || degree > math::kMostHarmonicDegree) {
        reader.fail(
            fmt::format("\"degree\" is {}. It should be from 0 to {}.", degree, math::kMostHarmonicDegree));
    }
    HarmonicsFile file;
    const std::vector<double> center = reader.numbers(json, "center", 3);
    file.center = {center[0], center[1], center[2]};
    file.coefficients = reader.numbers(json, "coefficients", math::harmonic_count(degree));
    if (const auto mesh = json.find("mesh"); mesh != json.end() && mesh->is_string()) file.mesh = *mesh;
    if (const auto rms = json.find("rms_error"); rms != json.end() && rms->is_number() && *rms > 0)
        file.rms_error = *rms;
    return file;
}

HarmonicsFile read_harmonics(const std::filesystem::path& path) {
    return parse_harmonics(read_text_file(path), path.string());
}

std::string to_text(const HarmonicsFile& file) {
    const int degree = math::HarmonicSeries<double>(file.coefficients).degree();
    std::string text = fmt::format("{{\n\"format\": \"{}\",\n\"version\": {},\n", kSeriesFormat, kVersion);
    if (!file.mesh.empty()) {
        text += fmt::format("\"mesh\": {},\n",
                            Json(file.mesh).dump(-1, ' ', true, Json::error_handler_t::replace));
    }
    if (file.rms_error) text += fmt::format("\"rms_error\": {:.4g},\n", *file.rms_error);
    text += fmt::format("\"degree\": {},\n\"center\": [{}, {}, {}],\n\"coefficients\": [\n", degree,
                        shortest(file.center.x), shortest(file.center.y), shortest(file.center.z));
    for (int l = 0; l <= degree; ++l) {
        const std::size_t first = math::harmonic_number(l, -l),
                          count = math::harmonic_number(l, l) + 1 - first;
        text += fmt::format("{}{}\n", list_text(std::span(file.coefficients).subspan(first, count)),
                            l < degree ? "," : "");
    }
    return text + "]\n}\n";
}

std::size_t write_harmonics(const HarmonicsFile& file, const std::filesystem::path& path) {
    const std::string text = to_text(file);
    replace_file(path, text);
    return text.size();
}

}  // namespace stilb::io
