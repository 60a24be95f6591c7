// Reads containers as the page does: independent of the writer.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/half.h"

namespace stilb::walk {

class ContainerReader {
  public:
    explicit ContainerReader(std::string bytes) : bytes_(std::move(bytes)) {
        if (bytes_.substr(0, 8) != "STILBWLK" || number<std::uint32_t>(8) != 1)
            throw std::runtime_error("not a container");
        const auto size = number<std::uint32_t>(12);
        header = nlohmann::json::parse(bytes_.substr(16, size));
        start_ = (16 + size + 7) / 8 * 8;
    }

    nlohmann::json header;

    const nlohmann::json& info(const std::string& name) const { return header.at("arrays").at(name); }
    std::size_t count(const std::string& name) const { return info(name).at("count"); }

    /// All numbers, element by element.
    std::vector<double> numbers(const std::string& name) const {
        const nlohmann::json& array = info(name);
        const std::size_t components = array.at("components"), elements = array.at("count");
        const std::string type = array.at("type");
        const std::size_t size = type == "u8" ? 1 : type.substr(1) == "16" ? 2 : 4;
        const std::size_t at = start_ + array.at("offset").get<std::size_t>();
        std::vector<double> values;
        for (std::size_t i = 0; i < elements; ++i) {
            for (std::size_t c = 0; c < components; ++c) {
                std::uint32_t bits = 0;
                for (std::size_t b = 0; b < size; ++b) {
                    const std::size_t place = array.at("planes").get<bool>()
                                                  ? (c * size + b) * elements + i
                                                  : (i * components + c) * size + b;
                    bits |= std::uint32_t{static_cast<unsigned char>(bytes_.at(at + place))} << 8 * b;
                }
                values.push_back(value_of(type, bits));
            }
        }
        return values;
    }

  private:
    static double value_of(const std::string& type, std::uint32_t bits) {
        if (type == "f32") return std::bit_cast<float>(bits);
        if (type == "f16") return to_float(static_cast<std::uint16_t>(bits));
        if (type == "s16") return static_cast<std::int16_t>(bits);
        return bits;
    }
    template <typename Number>
    Number number(std::size_t at) const {
        Number result;
        std::memcpy(&result, bytes_.data() + at, sizeof(Number));
        return result;
    }

    std::string bytes_;
    std::size_t start_ = 0;
};

}  // namespace stilb::walk
