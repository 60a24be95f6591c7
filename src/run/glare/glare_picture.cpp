#include "run/glare/glare_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "run/pictures/passes.h"
#include "sensors/camera.h"

namespace stilb::run {
namespace {

constexpr int kWidth = 256;
constexpr int kPasses = 2 * kGlareReplicates;

Camera fisheye_at(const MeasuringPoint& eye) {
    return {.position = eye.position,
            .target = eye.position + eye.normal,
            .fov_deg = 180,
            .resolution = {kWidth, kWidth},
            .projection = Projection::fisheye};
}

/// Whether one of 3 x 3 rays through a pixel meets a lamp, perhaps through panes.
class LampFinder {
  public:
    LampFinder(const sensors::CameraView& view, const PictureSetting& setting)
        : view_(view), caster_(setting.caster), is_lamp_(setting.scene.objects.size()) {
        for (const Light& light : setting.scene.lights) {
            if (const auto object = lights::emitting_object(light)) is_lamp_[index_of(*object)] = true;
        }
    }

    bool sees_lamp(int x, int y) const {
        constexpr std::array places{1.0 / 6, 0.5, 5.0 / 6};
        for (const double v : places) {
            for (const double u : places) {
                const auto direction = view_.direction_at(x + u, y + v);
                if (!direction) continue;
                const auto hit = caster_.seen({view_.position(), *direction}).hit;
                if (hit && is_lamp_[index_of(hit->object)]) return true;
            }
        }
        return false;
    }

  private:
    const sensors::CameraView& view_;
    const rays::RayCaster& caster_;
    std::vector<bool> is_lamp_;  ///< by object
};

void add_weights(const MeasuringPoint& eye, const Camera& camera, const PictureSetting& setting,
                 EyePicture& picture) {
    const sensors::CameraView view(camera);
    const LampFinder lamps(view, setting);
    const double side_rad = kPi / kWidth;
    parallel_for(kWidth, [&](std::size_t y) {
        for (std::size_t x = 0; x < kWidth; ++x) {
            const std::size_t pixel = y * kWidth + x;
            const auto direction =
                view.direction_at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            if (!direction) continue;
            const double cosine = std::min(dot(*direction, eye.normal), 1.0), angle = std::acos(cosine);
            const double solid_angle_sr = side_rad * side_rad * (angle > 0 ? std::sin(angle) / angle : 1);
            picture.solid_angles_sr[pixel] = solid_angle_sr;
            if (lamps.sees_lamp(static_cast<int>(x), static_cast<int>(y))) continue;
            const double index = transport::position_index(*direction, eye.normal);
            picture.weights_sr[pixel] = solid_angle_sr / (index * index);
        }
    });
}

/// The replicates that count: of a half, without one that is left out.
std::vector<std::size_t> replicates_of(std::size_t half, std::optional<std::size_t> left_out) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < kGlareReplicates / 2; ++i) {
        const std::size_t r = half * kGlareReplicates / 2 + i;
        if (r != left_out) all.push_back(r);
    }
    return all;
}

/// The mean luminance of each pixel and its neighbours that see no lamp, by some replicates.
std::vector<float> smoothed(const EyePicture& picture, const std::vector<std::size_t>& replicates) {
    const int width = picture.width;
    const auto index_of = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    std::vector<float> result(picture.weights_sr.size());
    for (int y = 0; y < width; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0, count = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, width - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                    const std::size_t pixel = index_of(u, v);
                    if (!(picture.weights_sr[pixel] > 0)) continue;
                    for (const std::size_t r : replicates) sum += picture.luminances_cd_m2[pixel][r];
                    count += static_cast<float>(replicates.size());
                }
            }
            if (count > 0) result[index_of(x, y)] = sum / count;
        }
    }
    return result;
}

/// The mean product of two different replicates.
double mean_square(const std::array<float, kGlareReplicates>& luminances,
                   const std::vector<std::size_t>& replicates) {
    double sum = 0, squares = 0;
    for (const std::size_t r : replicates) {
        sum += luminances[r];
        squares += double{luminances[r]} * luminances[r];
    }
    const auto count = static_cast<double>(replicates.size());
    return (sum * sum - squares) / (count * (count - 1));
}

double sum_above(const EyePicture& picture, double threshold_cd_m2, std::optional<std::size_t> left_out) {
    double sum = 0;
    for (const std::size_t half : {0, 1}) {
        const std::vector<float> selecting = smoothed(picture, replicates_of(1 - half, left_out));
        const std::vector<std::size_t> replicates = replicates_of(half, left_out);
        for (std::size_t i = 0; i < selecting.size(); ++i) {
            if (double{selecting[i]} < threshold_cd_m2 || !(picture.weights_sr[i] > 0)) continue;
            sum += picture.weights_sr[i] * mean_square(picture.luminances_cd_m2[i], replicates) / 2;
        }
    }
    return sum;
}

}  // namespace

double EyePicture::mean_luminance_cd_m2() const {
    double sum = 0, solid_angle_sr = 0;
    for (std::size_t i = 0; i < solid_angles_sr.size(); ++i) {
        for (const float luminance : luminances_cd_m2[i])
            sum += solid_angles_sr[i] * double{luminance} / kGlareReplicates;
        solid_angle_sr += solid_angles_sr[i];
    }
    return sum / solid_angle_sr;
}

EyePicture picture_at(const MeasuringPoint& eye, const PictureSetting& setting) {
    const Camera camera = fisheye_at(eye);
    EyePicture picture{kWidth, {}, {}, {}};
    const std::size_t pixels = std::size_t{kWidth} * kWidth;
    picture.solid_angles_sr.resize(pixels);
    picture.weights_sr.resize(pixels);
    add_weights(eye, camera, setting, picture);
    const auto estimator = estimators::make_auto({.scene = setting.scene,
                                                  .caster = setting.caster,
                                                  .max_reflections = setting.max_reflections,
                                                  .camera = camera,
                                                  .monitor = setting.monitor});
    const std::vector<bool> blind = sensors::blind_pixels(camera);
    PictureSums sums(camera.resolution,
                     {std::string(estimator->technique()), setting.seed, kGlareReplicates});
    Passes passes(*estimator, blind, sums, nullptr, setting.monitor, nullptr);
    Stage stage(setting.monitor, "picture at an eye", kPasses);
    for (int pass = 0; pass < kPasses; ++pass) {
        passes.advance(1);
        stage.advance();
    }
    picture.luminances_cd_m2.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t r = 0; r < kGlareReplicates; ++r)
            picture.luminances_cd_m2[i][r] = static_cast<float>(sums.luminance_of_replicate_cd_m2(r, i));
    }
    return picture;
}

std::array<double, kGlareReplicates> glare_above(const EyePicture& picture, double threshold_cd_m2) {
    const double all = sum_above(picture, threshold_cd_m2, std::nullopt);
    std::array<double, kGlareReplicates> pseudo_values;
    for (std::size_t r = 0; r < kGlareReplicates; ++r)
        pseudo_values[r] =
            kGlareReplicates * all - (kGlareReplicates - 1) * sum_above(picture, threshold_cd_m2, r);
    return pseudo_values;
}

}  // namespace stilb::run
