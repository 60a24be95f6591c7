#include "walk/data/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace stilb::walk {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::size_t kAlignment = 8;

std::size_t aligned(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

/// Byte planes, one component after the other.
template <typename Number>
std::string planes_of(std::span<const Number> values, std::size_t components) {
    std::string planes;
    planes.reserve(values.size_bytes());
    for (std::size_t component = 0; component < components; ++component) {
        for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
            for (std::size_t i = component; i < values.size(); i += components) {
                planes.push_back(std::bit_cast<std::array<char, sizeof(Number)>>(values[i])[byte]);
            }
        }
    }
    return planes;
}

template <typename Number>
ContainerArray array_of(std::string name, std::string_view type, std::size_t components,
                        std::span<const Number> values) {
    return {
        std::move(name), type, components, values.size() / components, true, planes_of(values, components)};
}

void append_number(std::string& bytes, std::uint32_t number) {
    const auto four = std::bit_cast<std::array<char, 4>>(number);
    bytes.append(four.begin(), four.end());
}

}  // namespace

ContainerArray make_array(std::string name, std::size_t components, std::span<const float> values) {
    return array_of(std::move(name), "f32", components, values);
}
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::uint32_t> values) {
    return array_of(std::move(name), "u32", components, values);
}
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::uint16_t> values) {
    return array_of(std::move(name), "u16", components, values);
}
ContainerArray make_array(std::string name, std::size_t components, std::span<const std::int16_t> values) {
    return array_of(std::move(name), "s16", components, values);
}
ContainerArray make_half_array(std::string name, std::size_t components,
                               std::span<const std::uint16_t> halves) {
    return array_of(std::move(name), "f16", components, halves);
}

std::string container_bytes(nlohmann::ordered_json header, const std::vector<ContainerArray>& arrays) {
    nlohmann::ordered_json list = nlohmann::ordered_json::object();
    std::size_t offset = 0;
    for (const ContainerArray& array : arrays) {
        list[array.name] = {{"type", array.type},
                            {"components", array.components},
                            {"count", array.count},
                            {"offset", offset},
                            {"planes", array.has_planes}};
        offset = aligned(offset + array.bytes.size());
    }
    header["arrays"] = std::move(list);
    // Names that are no UTF-8 shall not keep anyone from walking.
    const std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string bytes = "STILBWLK";
    append_number(bytes, kContainerVersion);
    append_number(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
    bytes.resize(aligned(bytes.size()));
    bytes.reserve(bytes.size() + offset);
    for (const ContainerArray& array : arrays) {
        bytes += array.bytes;
        bytes.resize(aligned(bytes.size()));
    }
    return bytes;
}

}  // namespace stilb::walk
