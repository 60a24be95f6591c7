#include "io/import/radiance/gensky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/import/radiance/sky_pattern.h"
#include "io/text/text.h"
#include "lights/sky/sky_luminance.h"
#include "lights/sky/sun_position.h"
#include "stilb/error.h"

namespace stilb::io::radiance {
namespace {

constexpr double kRadians = kPi / 180;
constexpr double kSkyEfficacy_lm_w = 203, kSunEfficacy_lm_w = 208;
constexpr double kSun_sr = 5.98e-5;  // of half a degree, for -R
constexpr double kSunOnGround_sr = 6e-5;
constexpr double kHighestSun = 87 * kRadians;  // of the formulas of skies with a sun
constexpr std::string_view kUsage =
    "Needed: gensky MONTH DAY TIME, or gensky -ang ALTITUDE AZIMUTH, then the options.";

using lights::SkyType, lights::SunPosition;

/// The arguments.
struct SkyRequest {
    SkyType type = SkyType::clear;
    bool has_sun = true;
    SunPosition sun;
    double ground_reflectance = 0.2, turbidity = 2.45;
    std::optional<double> zenith, horizontal, solar, horizontal_solar;
};

class SkyArguments {
  public:
    explicit SkyArguments(const std::vector<std::string>& arguments) : arguments_(arguments) {}

    SkyRequest read() && {
        const bool by_angles = !arguments_.empty() && arguments_[0] == "-ang";
        if (by_angles) {
            next_ = 1;
            request_.sun.altitude = kRadians * number();
            request_.sun.azimuth = kRadians * number();
        } else {
            month_ = whole(1, 12), day_ = whole(1, 31);
            read_time();
        }
        while (next_ < arguments_.size()) read_option();
        if (!by_angles) request_.sun = sun_of_time();
        return request_;
    }

  private:
    double number() {
        if (next_ >= arguments_.size())
            throw InputError(fmt::format("arguments of gensky are missing. {}", kUsage));
        const std::string& word = arguments_[next_++];
        const auto value = parse_number(word);
        if (!value || std::abs(*value) > 1e9)
            throw InputError(fmt::format("gensky: found {} where a number is needed.", in_quotes(word)));
        return *value;
    }
    int whole(int least, int most) {
        const double value = number();
        if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
        throw InputError(fmt::format("gensky: {} is not allowed. Allowed: whole numbers from {} to {}. {}",
                                     value, least, most, kUsage));
    }
    /// "12.5", "12:30", with a plus sign for solar time.
    void read_time() {
        if (next_ >= arguments_.size())
            throw InputError(fmt::format("arguments of gensky are missing. {}", kUsage));
        const std::string& word = arguments_[next_++];
        std::string_view text = word;
        is_solar_time_ = text.starts_with('+');
        if (is_solar_time_) text.remove_prefix(1);
        const std::size_t colon = std::min(text.find(':'), text.size());
        const auto hours = parse_number(text.substr(0, colon));
        const auto minutes =
            colon < text.size() ? parse_number(text.substr(colon + 1)) : std::optional<double>(0);
        if (!hours || !minutes || !(*hours >= 0 && *hours <= 24 && *minutes >= 0 && *minutes < 60)) {
            throw InputError(
                fmt::format("gensky: {} is no time. Allowed: hours such as 9.5 or 9:30, with a plus sign "
                            "for solar time; time zones are given by -m.",
                            in_quotes(word)));
        }
        hour_ = *hours + *minutes / 60;
    }
    void read_option() {
        const std::string& option = arguments_[next_++];
        if (option == "-s" || option == "+s") {
            choose(SkyType::clear, option[0] == '+');
        } else if (option == "-i" || option == "+i") {
            choose(SkyType::intermediate, option[0] == '+');
        } else if (option == "-c") {
            choose(SkyType::overcast, false);
        } else if (option == "-u") {
            choose(SkyType::uniform, false);
        } else if (option == "-g") {
            request_.ground_reflectance = number();
        } else if (option == "-t") {
            request_.turbidity = number();
        } else if (option == "-b") {
            request_.zenith = number();
        } else if (option == "-B") {
            request_.horizontal = number();
        } else if (option == "-r") {
            request_.solar = number();
        } else if (option == "-R") {
            request_.horizontal_solar = number();
        } else if (option == "-a") {
            site_.latitude = kRadians * number();
        } else if (option == "-o") {
            site_.longitude = kRadians * number();
        } else if (option == "-m") {
            site_.meridian = kRadians * number();
        } else {
            throw InputError(
                fmt::format("the option {} of gensky is not supported. Allowed: -s, +s, -i, +i, -c, -u, -g, "
                            "-t, -b, -B, -r, -R, -a, -o, -m.",
                            in_quotes(option)));
        }
    }
    void choose(SkyType type, bool has_sun) {
        request_.type = type;
        request_.has_sun = has_sun;
    }

    SunPosition sun_of_time() const {
        const int day = lights::day_of_year(month_, day_);
        const double hour = is_solar_time_ ? hour_ : lights::solar_hour(day, hour_, site_);
        return lights::sun_position(day, hour, site_.latitude);
    }

    const std::vector<std::string>& arguments_;
    std::size_t next_ = 0;
    int month_ = 1, day_ = 1;
    double hour_ = 12;
    bool is_solar_time_ = false;
    lights::Site site_{0.66, 2.13, 120 * kRadians};  // Berkeley, as in gensky
    SkyRequest request_;
};

}  // namespace

std::string gensky(const std::vector<std::string>& arguments) {
    SkyRequest request = SkyArguments(arguments).read();
    const bool has_sunny_formula = lights::depends_on_sun(request.type);
    double& altitude = request.sun.altitude;
    if (has_sunny_formula) altitude = std::min(altitude, kHighestSun);
    const Vec3 sun = request.sun.direction();
    const double mean = lights::mean_over_zenith(request.type, altitude);
    double zenith = request.zenith.value_or(
        lights::zenith_luminance_cd_m2(request.type, altitude, request.turbidity) / kSkyEfficacy_lm_w);
    if (request.horizontal) zenith = *request.horizontal / (mean * kPi);
    double ground = zenith * mean;
    std::string text;
    if (request.has_sun && sun.z > 0) {
        double solar =
            request.solar.value_or(lights::sun_luminance_cd_m2(request.type, altitude) / kSunEfficacy_lm_w);
        if (request.horizontal_solar) solar = *request.horizontal_solar / (kSun_sr * sun.z);
        ground += kSunOnGround_sr / kPi * solar * sun.z;
        if (solar > 0) {
            text +=
                fmt::format("void light solar 0 0 3 {0} {0} {0}\nsolar source sun 0 0 4 {1} {2} {3} 0.5\n",
                            solar, sun.x, sun.y, sun.z);
        }
    }
    ground *= request.ground_reflectance;
    const auto number = std::ranges::find(kSkiesOfGensky, request.type) - kSkiesOfGensky.begin() + 1;
    text += fmt::format("void brightfunc skyfunc 2 skybr skybright.cal 0 {} {} {} {}",
                        has_sunny_formula ? 7 : 3, number, zenith, ground);
    if (has_sunny_formula) {
        text +=
            fmt::format(" {} {} {} {}", lights::zenith_value(request.type, altitude), sun.x, sun.y, sun.z);
    }
    return text + "\n";
}

}  // namespace stilb::io::radiance
