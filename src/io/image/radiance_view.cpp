#include "io/image/radiance_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr double kLargestOfView = 1e9;

double read_view_number(std::string_view& words, std::string_view option) {
    const std::string_view word = next_word(words);
    const auto number = parse_number(word);
    if (number && std::abs(*number) <= kLargestOfView) return *number;
    throw InputError(
        fmt::format("the option {} of the view needs a number from -1e9 to 1e9, but {} was found.", option,
                    word.empty() ? "nothing" : in_quotes(word)));
}

Vec3 read_view_vector(std::string_view& words, std::string_view option) {
    const double x = read_view_number(words, option), y = read_view_number(words, option);
    return {x, y, read_view_number(words, option)};
}

void require_angle(double angle_deg, char type) {
    const double most_deg = type == 'v' ? 179.9 : 360;
    if (angle_deg >= 0.001 && angle_deg <= most_deg) return;
    throw InputError(
        fmt::format("the angle of view {} is not allowed for -vt{}. Allowed: from 0.001 to {} degrees.",
                    angle_deg, type, most_deg));
}

}  // namespace

bool RadianceView::read(std::string_view words) {
    bool found = false;
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
        const auto is = [&](std::string_view option) { return word == option; };
        bool is_of_view = true;
        if (word.size() == 4 && word.starts_with("-vt")) {
            type = word[3];
        } else if (is("-vp")) {
            position = read_view_vector(words, word);
        } else if (is("-vd")) {
            direction = read_view_vector(words, word);
        } else if (is("-vu")) {
            up = read_view_vector(words, word);
        } else if (is("-vh")) {
            horizontal_deg = read_view_number(words, word);
        } else if (is("-vv")) {
            vertical_deg = read_view_number(words, word);
        } else if (is("-vs")) {
            shift = read_view_number(words, word);
        } else if (is("-vl")) {
            lift = read_view_number(words, word);
        } else if (is("-vo")) {
            fore_m = read_view_number(words, word);
        } else if (is("-va")) {
            aft_m = read_view_number(words, word);
        } else {
            is_of_view = false;
            if (is("-x") || is("-y")) {
                constexpr auto most = static_cast<double>(Camera::kLimit.most_each);
                const double pixels = std::clamp(read_view_number(words, word), 1.0, most);
                (is("-x") ? width : height) = static_cast<int>(pixels);
            }
        }
        found = found || is_of_view;
    }
    return found;
}

double RadianceView::aspect() const {
    require_angle(vertical_deg, type);
    if (type != 'v') return vertical_deg / horizontal_deg;
    constexpr double half_degree = kPi / 360;
    return std::tan(vertical_deg * half_degree) / std::tan(horizontal_deg * half_degree);
}

std::optional<Camera> RadianceView::camera() const {
    if (type != 'v' && type != 'a') return std::nullopt;
    require_angle(horizontal_deg, type);
    if (!(length(cross(direction, up)) > 1e-9 * length(direction) * length(up)))
        throw InputError("the direction of the view (-vd) is 0 or parallel to its upward direction (-vu).");
    Camera camera;
    camera.projection = type == 'v' ? Projection::perspective : Projection::fisheye;
    camera.position = position;
    camera.target = position + direction;
    camera.up = up;
    camera.fov_deg = horizontal_deg;
    return camera;
}

}  // namespace stilb::io
