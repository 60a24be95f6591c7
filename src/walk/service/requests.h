// Requests in JSON, from a page that may be anybody's: everything is checked.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::walk {

// All throw InputError with a sentence that the page can show.

/// The JSON object that a request is.
nlohmann::json parse_request(std::string_view text);

/// Refuses members of other names. `of`: the object, for the message.
void require_members(const nlohmann::json& object, std::span<const std::string_view> allowed,
                     std::string_view of);

/// The member of this name, a text.
std::string_view text_of(const nlohmann::json& object, std::string_view name);
/// The member of this name: [x, y, z] in m.
Vec3 position_of(const nlohmann::json& object, std::string_view name);
/// The member of this name, [x, y, z] of any length but 0, as a unit vector.
Vec3 direction_of(const nlohmann::json& object, std::string_view name);
/// A factor of a light: a number, or [r, g, b]. `name`: for the message.
Rgb factor_of(const nlohmann::json& value, std::string_view name);

}  // namespace stilb::walk
