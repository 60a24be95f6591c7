#include "io/import/radiance/sky_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "io/import/radiance/xform.h"

namespace stilb::io::radiance {
namespace {

class SkyReader {
  public:
    SkyReader(const Modifier& modifier, const Description& description)
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
        const Vec3 sun{n[first], n[first + 1], n[first + 2]};
        if (!(length(sun) > 0)) fail("the direction of the sun is 0 0 0. Allowed: any other.");
        pattern_.sky.sun = normalized(sun);
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
        pattern_.sky.type = kSkiesOfGensky[static_cast<std::size_t>(n[0]) - 1];
        pattern_.sky.zenith = n[1], pattern_.ground = n[2];
        if (!lights::depends_on_sun(pattern_.sky.type)) return;
        expect_numbers(7);
        if (!(n[3] > 0)) fail("the fourth number, which divides the brightness, is not above 0.");
        pattern_.sky.zenith_value = n[3];
        read_sun(4);
    }
    void read_perez_sky() {
        expect_numbers(10);
        const std::vector<double>& n = modifier_.numbers;
        pattern_.sky.type = lights::SkyType::perez;
        pattern_.sky.zenith = n[0], pattern_.ground = n[1];
        std::copy_n(n.begin() + 2, 5, pattern_.sky.perez.begin());
        read_sun(7);
    }
    void read_axes() {
        Xform own;
        const auto transforms = std::span(modifier_.texts).subspan(2);
        if (read_transforms(transforms, own) != transforms.size())
            fail("the texts behind the file are not all transforms.");
        const geometry::Transform frame = compose(modifier_.frame, own.transform);
        pattern_.axes = {normalized(frame.x_axis), normalized(frame.y_axis), normalized(frame.z_axis)};
    }

    const Modifier& modifier_;
    const Description& description_;
    SkyPattern pattern_;
};

}  // namespace

std::optional<SkyPattern> read_sky_pattern(const Modifier& modifier, const Description& description) {
    return SkyReader(modifier, description).read();
}

double SkyPattern::factor(const Vec3& direction) const {
    const Vec3 w = axes.to_local(direction);
    // Sky and ground melt together within some degrees of the horizon.
    const double weight = std::pow(w.z + 1.01, 10);
    const double value = (weight * sky.towards(w) + ground / weight) / (weight + 1 / weight);
    return std::isfinite(value) ? std::max(value, 0.0) : 0;
}

}  // namespace stilb::io::radiance
