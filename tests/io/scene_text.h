// Scenes as text for the tests of their reader.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/scene/scene_file.h"
#include "stilb/error.h"

namespace stilb::io {

inline SceneFile read_scene_text(const std::string& toml,
                                 const std::filesystem::path& directory = "no-such-directory") {
    return read_scene(toml, "s.toml", directory);
}

/// The message with which the text is refused; "accepted" where it is not.
inline std::string refusal(const std::string& toml,
                           const std::filesystem::path& directory = "no-such-directory") {
    try {
        read_scene_text(toml, directory);
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// The whole message is tested, and that it names file, line and key.
#define EXPECT_REFUSAL(toml, message) EXPECT_EQ(refusal(toml), message)

}  // namespace stilb::io
