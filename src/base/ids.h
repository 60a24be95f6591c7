// Typed indices: a MaterialId cannot be passed as an ObjectId.
#pragma once

#include <cstdint>

namespace stilb {

enum class MaterialId : std::uint32_t {};
enum class ObjectId : std::uint32_t {};
enum class LightId : std::uint32_t {};
enum class SolidId : std::uint32_t {};

/// The index into the vector of the id's elements.
template <typename Id>
constexpr std::uint32_t index_of(Id id) {
    return static_cast<std::uint32_t>(id);
}

}  // namespace stilb
