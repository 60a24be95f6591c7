// Typed indices: a MaterialId cannot be passed where an ObjectId is meant.
#pragma once

#include <cstdint>

namespace stilb {

enum class MaterialId : std::uint32_t {};
enum class ObjectId : std::uint32_t {};
enum class LightId : std::uint32_t {};
enum class SolidId : std::uint32_t {};

/// The position in the vector that the id belongs to.
template <typename Id>
constexpr std::uint32_t index_of(Id id) {
    return static_cast<std::uint32_t>(id);
}

}  // namespace stilb
