#include "io/import/radiance/sky_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "io/import/radiance/xform.h"

namespace stilb::io::radiance {
namespace {

/// Sky and ground melt together within some degrees of the horizon.
double blended(double z, double sky, double ground) {
    const double weight = std::pow(z + 1.01, 10);
    return (weight * sky + ground / weight) / (weight + 1 / weight);
}

double angle_of_cosine(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

}  // namespace

class SkyPattern::Reader {
  public:
    Reader(const Modifier& modifier, const Description& description)
        : modifier_(modifier), description_(description) {}

    std::optional<SkyPattern> read() && {
        if (modifier_.type != "brightfunc" || modifier_.texts.size() < 2) return std::nullopt;
        const std::string& function = modifier_.texts[0];
        const std::string file = std::filesystem::path(modifier_.texts[1]).filename().string();
        if (function == "skybr" && file == "skybright.cal") {
            read_cie_sky();
        } else if (function == "skybright" && file == "perezlum.cal") {
            read_perez_sky();
        } else {
            return std::nullopt;
        }
        read_axes();
        return pattern_;
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("brightfunc {}: {}", modifier_.name, message),
                         description_.where(modifier_.place));
    }
    void expect_numbers(std::size_t count) const {
        if (modifier_.numbers.size() < count) {
            fail(fmt::format("{} needs {} numbers here, but {} were found.", modifier_.texts[0], count,
                             modifier_.numbers.size()));
        }
    }
    void read_sun(std::size_t first) {
        const std::vector<double>& n = modifier_.numbers;
        pattern_.sun_ = {n[first], n[first + 1], n[first + 2]};
        if (!(length(pattern_.sun_) > 0)) fail("the direction of the sun is 0 0 0. Allowed: any other.");
        pattern_.sun_ = normalized(pattern_.sun_);
    }
    void read_cie_sky() {
        expect_numbers(3);
        const std::vector<double>& n = modifier_.numbers;
        if (n[0] != 1 && n[0] != 2 && n[0] != 3 && n[0] != 4) {
            fail(fmt::format(
                "the kind of sky {} is not allowed. Allowed: 1 (clear), 2 (overcast), 3 (uniform), 4 "
                "(intermediate).",
                n[0]));
        }
        pattern_.sky_ = static_cast<Sky>(static_cast<int>(n[0]) - 1);
        pattern_.zenith_ = n[1], pattern_.ground_ = n[2];
        if (pattern_.sky_ == Sky::overcast || pattern_.sky_ == Sky::uniform) return;
        expect_numbers(7);
        pattern_.normalization_ = n[3];
        if (!(n[3] > 0)) fail("the fourth number, which divides the brightness, is not above 0.");
        read_sun(4);
    }
    void read_perez_sky() {
        expect_numbers(10);
        const std::vector<double>& n = modifier_.numbers;
        pattern_.sky_ = Sky::perez;
        pattern_.zenith_ = n[0], pattern_.ground_ = n[1];
        std::copy_n(n.begin() + 2, 5, pattern_.coefficients_.begin());
        read_sun(7);
    }
    void read_axes() {
        Xform own;
        const auto transforms = std::span(modifier_.texts).subspan(2);
        if (read_transforms(transforms, own) != transforms.size())
            fail("the texts behind the file are not all transforms.");
        const geometry::Transform frame = compose(modifier_.frame, own.transform);
        pattern_.x_axis_ = normalized(frame.x_axis);
        pattern_.y_axis_ = normalized(frame.y_axis);
        pattern_.z_axis_ = normalized(frame.z_axis);
    }

    const Modifier& modifier_;
    const Description& description_;
    SkyPattern pattern_;
};

std::optional<SkyPattern> SkyPattern::read(const Modifier& modifier, const Description& description) {
    return Reader(modifier, description).read();
}

double SkyPattern::above_horizon(double z, double to_sun_cosine) const {
    const double to_sun = angle_of_cosine(to_sun_cosine);
    switch (sky_) {
        case Sky::clear: {  // CIE, after Kittler
            const double circumsolar =
                0.91 + 10 * std::exp(-3 * to_sun) + 0.45 * to_sun_cosine * to_sun_cosine;
            return zenith_ * circumsolar * (z > 0.01 ? 1 - std::exp(-0.32 / z) : 1) / normalization_;
        }
        case Sky::overcast:  // CIE, after Moon and Spencer
            return zenith_ * (1 + 2 * z) / 3;
        case Sky::uniform:
            return zenith_;
        case Sky::intermediate: {  // after Matsuura
            const double from_zenith = angle_of_cosine(z), of_sun = angle_of_cosine(sun_.z);
            const double height =
                (1.35 * std::sin(5.631 - 3.59 * from_zenith) + 3.12) * std::sin(4.396 - 2.6 * of_sun) + 6.37 -
                from_zenith;
            return zenith_ * height / 2.326 *
                   std::exp(-0.563 * to_sun * ((2.629 - from_zenith) * (1.562 - of_sun) + 0.812)) /
                   normalization_;
        }
        case Sky::perez:
            break;
    }
    const auto& [a, b, c, d, e] = coefficients_;
    return zenith_ * (1 + a * std::exp(b / std::max(z, 0.01))) *
           (1 + c * std::exp(d * to_sun) + e * to_sun_cosine * to_sun_cosine);
}

double SkyPattern::factor(const Vec3& direction) const {
    const Vec3 w{dot(direction, x_axis_), dot(direction, y_axis_), dot(direction, z_axis_)};
    const double value = blended(w.z, above_horizon(w.z, dot(w, sun_)), ground_);
    return std::isfinite(value) ? std::max(value, 0.0) : 0;
}

}  // namespace stilb::io::radiance
