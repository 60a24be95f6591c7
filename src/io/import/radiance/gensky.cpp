// The formulas are those of gensky: zenith luminances after Karayel et al. (clear) and Krochmann (overcast),
// the declination and the equation of time in the simple forms of its manual.
#include "io/import/radiance/gensky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/vec.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io::radiance {
namespace {

constexpr double kRadians = kPi / 180;
constexpr double kSkyEfficacy_lm_w = 203, kSunEfficacy_lm_w = 208;
constexpr double kSun_sr = 5.98e-5;  // of half a degree, for -R
constexpr double kSunOnGround_sr = 6e-5;
constexpr double kHighestSun = 87;  // degrees, of the formulas of skies with a sun
constexpr std::string_view kUsage =
    "Needed: gensky MONTH DAY TIME, or gensky -ang ALTITUDE AZIMUTH, then the options.";

enum class Sky { clear = 1, overcast = 2, uniform = 3, intermediate = 4 };

/// The arguments. Angles in radians; west is positive, as in gensky.
struct SkyRequest {
    Sky sky = Sky::clear;
    bool has_sun = true;
    double altitude = 0, azimuth = 0;
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
            request_.altitude = kRadians * number();
            request_.azimuth = kRadians * number();
        } else {
            month_ = whole(1, 12), day_ = whole(1, 31);
            read_time();
        }
        while (next_ < arguments_.size()) read_option();
        if (!by_angles) place_sun();
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
            choose(Sky::clear, option[0] == '+');
        } else if (option == "-i" || option == "+i") {
            choose(Sky::intermediate, option[0] == '+');
        } else if (option == "-c") {
            choose(Sky::overcast, false);
        } else if (option == "-u") {
            choose(Sky::uniform, false);
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
            latitude_ = kRadians * number();
        } else if (option == "-o") {
            longitude_ = kRadians * number();
        } else if (option == "-m") {
            meridian_ = kRadians * number();
        } else {
            throw InputError(
                fmt::format("the option {} of gensky is not supported. Allowed: -s, +s, -i, +i, -c, -u, -g, "
                            "-t, -b, -B, -r, -R, -a, -o, -m.",
                            in_quotes(option)));
        }
    }
    void choose(Sky sky, bool has_sun) {
        request_.sky = sky;
        request_.has_sun = has_sun;
    }

    void place_sun() {
        constexpr std::array<int, 12> days_before{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
        const double day = days_before[static_cast<std::size_t>(month_ - 1)] + day_;
        const double declination = 0.4093 * std::sin(2 * kPi / 365 * (day - 81));
        double solar_hour = hour_;
        if (!is_solar_time_) {
            solar_hour += 0.170 * std::sin(4 * kPi / 373 * (day - 80)) -
                          0.129 * std::sin(2 * kPi / 355 * (day - 8)) + 12 * (meridian_ - longitude_) / kPi;
        }
        const double turn = solar_hour * kPi / 12;
        request_.altitude = std::asin(std::sin(latitude_) * std::sin(declination) -
                                      std::cos(latitude_) * std::cos(declination) * std::cos(turn));
        request_.azimuth = -std::atan2(std::cos(declination) * std::sin(turn),
                                       -std::cos(latitude_) * std::sin(declination) -
                                           std::sin(latitude_) * std::cos(declination) * std::cos(turn));
    }

    const std::vector<std::string>& arguments_;
    std::size_t next_ = 0;
    int month_ = 1, day_ = 1;
    double hour_ = 12;
    bool is_solar_time_ = false;
    double latitude_ = 0.66, longitude_ = 2.13, meridian_ = 120 * kRadians;
    SkyRequest request_;
};

double zenith_radiance(const SkyRequest& request, double sine) {
    const double overcast = 8.6 * sine + 0.123;
    const double clear = (1.376 * request.turbidity - 1.81) * std::tan(request.altitude) + 0.38;
    double kcd_m2 = overcast;
    if (request.sky == Sky::clear) kcd_m2 = clear;
    if (request.sky == Sky::intermediate) kcd_m2 = (clear + overcast) / 2;
    return std::max(kcd_m2, 0.0) * 1000 / kSkyEfficacy_lm_w;
}

/// The brightness towards the zenith by the formula of the sky that skybright.cal divides by.
double zenith_factor(const SkyRequest& request, double sine) {
    const double from_zenith = kPi / 2 - request.altitude;
    if (request.sky == Sky::clear)
        return 0.274 * (0.91 + 10 * std::exp(-3 * from_zenith) + 0.45 * sine * sine);
    return (2.739 + 0.9891 * std::sin(0.3119 + 2.6 * request.altitude)) *
           std::exp(-from_zenith * (0.4441 + 1.48 * request.altitude));
}

/// The horizontal irradiance by the sky over that of a uniform sky of the zenith's radiance.
double mean_factor(const SkyRequest& request, double zenith_factor) {
    constexpr std::array clear{2.766521, 0.547665, -0.369832, 0.009237, 0.059229};
    constexpr std::array intermediate{3.5556, -2.7152, -1.3081, 1.0660, 0.60227};
    if (request.sky == Sky::uniform) return 1;
    if (request.sky == Sky::overcast) return 7.0 / 9;
    const auto& coefficients = request.sky == Sky::clear ? clear : intermediate;
    const double x = (request.altitude - kPi / 4) / (kPi / 4);
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum / zenith_factor / kPi;
}

}  // namespace

std::string gensky(const std::vector<std::string>& arguments) {
    SkyRequest request = SkyArguments(arguments).read();
    const bool has_sunny_formula = request.sky == Sky::clear || request.sky == Sky::intermediate;
    if (has_sunny_formula) request.altitude = std::min(request.altitude, kHighestSun * kRadians);
    const double sine = std::sin(request.altitude), cosine = std::cos(request.altitude);
    const Vec3 sun{-std::sin(request.azimuth) * cosine, -std::cos(request.azimuth) * cosine, sine};
    const double factor = has_sunny_formula ? zenith_factor(request, sine) : 1;
    const double mean = mean_factor(request, factor);
    double zenith = zenith_radiance(request, sine);
    if (request.zenith) zenith = *request.zenith;
    if (request.horizontal) zenith = *request.horizontal / (mean * kPi);
    double ground = zenith * mean;
    std::string text;
    if (request.has_sun && sine > 0) {
        double solar = 1.5e9 / kSunEfficacy_lm_w * (1.147 - 0.147 / std::max(sine, 0.16));
        if (request.sky == Sky::intermediate) solar *= 0.15;
        if (request.solar) solar = *request.solar;
        if (request.horizontal_solar) solar = *request.horizontal_solar / (kSun_sr * sine);
        ground += kSunOnGround_sr / kPi * solar * sine;
        if (solar > 0) {
            text +=
                fmt::format("void light solar 0 0 3 {0} {0} {0}\nsolar source sun 0 0 4 {1} {2} {3} 0.5\n",
                            solar, sun.x, sun.y, sun.z);
        }
    }
    ground *= request.ground_reflectance;
    text += fmt::format("void brightfunc skyfunc 2 skybr skybright.cal 0 {} {} {} {}",
                        has_sunny_formula ? 7 : 3, static_cast<int>(request.sky), zenith, ground);
    if (has_sunny_formula) text += fmt::format(" {} {} {} {}", factor, sun.x, sun.y, sun.z);
    return text + "\n";
}

}  // namespace stilb::io::radiance
