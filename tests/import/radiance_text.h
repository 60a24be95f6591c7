// Radiance scenes as text, for the tests of their reader.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/import/radiance/radiance_scene_file.h"
#include "stilb/error.h"
#include "support/source_directory.h"

namespace stilb::io {

inline const std::filesystem::path kRadianceData = source_directory() / "tests/data/radiance";

inline SceneFile read_rad(const std::string& text,
                          const std::filesystem::path& folder = "no-such-directory") {
    return read_radiance_scene(text, "r.rad", folder);
}
inline radiance::Description describe_rad(const std::string& text) {
    return radiance::read_description(text, "r.rad", "no-such-directory");
}

/// The warnings of a scene, all of which name its file in front.
inline std::vector<std::string> warnings_of(const SceneFile& file) {
    std::vector<std::string> texts = texts_of(file.warnings);
    for (std::string& text : texts) {
        const std::string name = "r.rad: ";
        EXPECT_TRUE(text.starts_with(name)) << text;
        text.erase(0, name.size());
    }
    return texts;
}

/// The message with which the text is refused; "accepted" where it is not.
inline std::string refusal_of_rad(const std::string& text) {
    try {
        read_rad(text);
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// A material "m" before the text, in one line.
inline std::string with_material(const std::string& text) {
    return "void plastic m 0 0 5 .5 .5 .5 0 0\n" + text;
}

inline std::vector<double> numbers_of(const radiance::Description& description, std::size_t surface) {
    const radiance::Surface& of = description.surfaces.at(surface);
    const auto begin = description.numbers.begin() + static_cast<std::ptrdiff_t>(of.first);
    return {begin, begin + static_cast<std::ptrdiff_t>(of.count)};
}

inline void expect_numbers(const radiance::Description& description, std::size_t surface,
                           const std::vector<double>& expected) {
    const std::vector<double> found = numbers_of(description, surface);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

}  // namespace stilb::io
