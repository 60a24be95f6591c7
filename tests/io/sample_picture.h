// A small picture with all channels, for tests of picture files.
#pragma once

#include <cmath>

#include "io/image/picture.h"

namespace stilb::io {

inline Camera sample_camera(Projection projection) {
    Camera camera;
    camera.position = {0.3, 0.25, 1.6};
    camera.target = {3, 2.75, 1.1};
    camera.up = {0, 0, 1};
    camera.fov_deg = 70;
    camera.projection = projection;
    return camera;
}

/// Grey growing from 0.01 to 10 000 cd/m2 from left to right, redder downwards.
inline Picture sample_picture(int width = 40, int height = 20) {
    Picture picture;
    picture.width = width;
    picture.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto grey = static_cast<float>(std::pow(10.0, -2 + 6 * (x + 0.5) / width));
            const float red = static_cast<float>(y) / static_cast<float>(height);
            picture.rgb_cd_m2.push_back({grey * (1 + red), grey, grey * (1 - red)});
            picture.standard_error_cd_m2.push_back(grey / 100);
            picture.normals.push_back({0, 0.6f, -0.8f});
            picture.depth_m.push_back(static_cast<float>(1 + x + width * y));
        }
    }
    picture.camera = sample_camera(Projection::perspective);
    picture.camera->resolution = {width, height};
    picture.origin = {"office.toml",
                      "0123abcd",
                      "main",
                      "auto",
                      "light-paths",
                      "stilb render office.toml -o a.exr",
                      "9.8.7",
                      17,
                      4096,
                      32,
                      12.5,
                      10'080,
                      0.25,
                      "incoming",
                      "Two-desk office"};
    return picture;
}

/// Of one row.
inline Picture picture_of(std::vector<std::array<float, 3>> rgb_cd_m2) {
    Picture picture;
    picture.width = static_cast<int>(rgb_cd_m2.size());
    picture.height = 1;
    picture.rgb_cd_m2 = std::move(rgb_cd_m2);
    return picture;
}

}  // namespace stilb::io
