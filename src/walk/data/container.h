// The container of walk-through data: a header in JSON, then arrays of numbers.
//
//     8 bytes "STILBWLK", u32 version, u32 length of the header, the header (UTF-8), zero bytes up to a
//     multiple of 8, the arrays
//
// Numbers are little-endian. Arrays of more than one byte per number are stored in byte planes, because
// neighbouring values share their upper bytes: gzip then needs about two thirds of the space. docs/walk.md
// has the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::walk {

inline constexpr std::uint32_t kContainerVersion = 1;

/// An array of `count` x `components` numbers; `bytes` as they are stored.
struct ContainerArray {
    std::string name;
    std::string_view type;  ///< f32, f16, u32, u16, u8 or s16
    std::size_t components = 1, count = 0;
    bool has_planes = false;
    std::string bytes;
};

/// `values`: the components of the first element, then those of the second one, and so on.
ContainerArray make_array(std::string name, std::size_t components, std::span<const float> values);
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::uint32_t> values);
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::uint16_t> values);
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::int16_t> values);
/// Numbers in half precision (base/half.h).
ContainerArray make_half_array(std::string name, std::size_t components,
                               std::span<const std::uint16_t> halves);

/// The bytes of a container. `header`: an object, to which the list of arrays is added.
std::string container_bytes(nlohmann::ordered_json header, const std::vector<ContainerArray>& arrays);

}  // namespace stilb::walk
