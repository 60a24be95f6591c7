// Accessors of glTF: typed numbers in buffers.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/import/gltf/gltf_file.h"

namespace stilb::io::gltf {
namespace {

/// The limit of elements that no buffer confirms: accessors without a bufferView are zero.
constexpr std::size_t kMostZeros = 1 << 20;

/// Elements one after another at a distance in bytes.
struct Elements {
    std::string_view bytes;
    std::size_t stride = 0;
    int component_type = 0;
    std::size_t components = 0;
    bool is_normalized = false;

    std::size_t size() const {
        return components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                static_cast<std::uint32_t>(component_type)));
    }
};

template <typename T>
double stored_number(const char* bytes, bool is_normalized) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    const auto number = static_cast<double>(value);
    if constexpr (std::numeric_limits<T>::is_integer) {
        if (is_normalized) return std::max(number / std::numeric_limits<T>::max(), -1.0);
    }
    return number;
}

double number_at(const Elements& elements, std::size_t index, std::size_t component) {
    const auto size = elements.size() / elements.components;
    const char* const bytes = elements.bytes.data() + index * elements.stride + component * size;
    const bool n = elements.is_normalized;
    switch (elements.component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return stored_number<std::int8_t>(bytes, n);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return stored_number<std::uint8_t>(bytes, n);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return stored_number<std::int16_t>(bytes, n);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return stored_number<std::uint16_t>(bytes, n);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return stored_number<std::uint32_t>(bytes, n);
        default:
            return stored_number<float>(bytes, n);
    }
}

void expect_component_type(const File& file, int type, std::string_view where) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return;
        default:
            file.fail(
                where,
                fmt::format("componentType {} is not allowed. Allowed: 5120 to 5123, 5125 and 5126.", type));
    }
}

/// Throws where `count` elements reach beyond their bytes.
void expect_room(const File& file, const Elements& elements, std::size_t count, std::string_view where) {
    const std::size_t size = elements.size(), room = elements.bytes.size();
    if (elements.stride >= size && size <= room && (count - 1) <= (room - size) / elements.stride) return;
    file.fail(where, fmt::format("its {} elements of {} bytes do not fit into its bufferView of {} bytes.",
                                 count, size, room));
}

Elements elements_of(const File& file, int view, std::size_t offset, const Elements& form, std::size_t count,
                     std::string_view where) {
    Elements elements = form;
    elements.bytes = file.bytes_of_view(view, where);
    if (offset > elements.bytes.size())
        file.fail(where, fmt::format("byteOffset {} lies beyond its bufferView.", offset));
    elements.bytes.remove_prefix(offset);
    const std::size_t stride = file.model.bufferViews[static_cast<std::size_t>(view)].byteStride;
    elements.stride = stride == 0 ? elements.size() : stride;
    expect_room(file, elements, count, where);
    return elements;
}

/// Replaces some of the elements, as sparse accessors do.
void put_sparse(const File& file, const tinygltf::Accessor& accessor, const Elements& form,
                const std::string& where, std::vector<double>& numbers) {
    const auto& sparse = accessor.sparse;
    if (sparse.count <= 0) return;
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::string of = where + ".sparse";
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        file.fail(of, "a byteOffset is negative.");
    expect_component_type(file, sparse.indices.componentType, of);
    const Elements indices =
        elements_of(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                    {{}, 0, sparse.indices.componentType, 1, false}, count, of);
    const Elements values = elements_of(file, sparse.values.bufferView,
                                        static_cast<std::size_t>(sparse.values.byteOffset), form, count, of);
    for (std::size_t i = 0; i < count; ++i) {
        const double index = number_at(indices, i, 0);
        if (!(index >= 0 && index < static_cast<double>(accessor.count)))
            file.fail(of, fmt::format("index {} of its {} elements.", index, accessor.count));
        for (std::size_t c = 0; c < form.components; ++c)
            numbers[static_cast<std::size_t>(index) * form.components + c] = number_at(values, i, c);
    }
}

std::vector<double> read_numbers(const File& file, const tinygltf::Accessor& accessor, const Elements& form,
                                 const std::string& where) {
    std::vector<double> numbers;
    if (accessor.count == 0) return numbers;
    if (accessor.bufferView >= 0) {
        const Elements elements =
            elements_of(file, accessor.bufferView, accessor.byteOffset, form, accessor.count, where);
        numbers.reserve(accessor.count * form.components);
        for (std::size_t i = 0; i < accessor.count; ++i) {
            for (std::size_t c = 0; c < form.components; ++c) numbers.push_back(number_at(elements, i, c));
        }
    } else {
        if (accessor.count > kMostZeros)
            file.fail(where, "it has no bufferView, so that all of its many elements are 0.");
        numbers.resize(accessor.count * form.components);
    }
    if (accessor.sparse.isSparse) put_sparse(file, accessor, form, where, numbers);
    return numbers;
}

}  // namespace

std::vector<double> read_vectors(const File& file, int index, int components, std::string_view part,
                                 NotFinite others) {
    const tinygltf::Accessor& accessor = element(file, file.model.accessors, index, "accessors", part);
    const std::string where = fmt::format("accessors[{}] ({})", index, part);
    expect_component_type(file, accessor.componentType, where);
    const int own = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (own != components) {
        file.fail(where, fmt::format("its elements have {} components. Needed: {}.", own, components));
    }
    const Elements form{
        {}, 0, accessor.componentType, static_cast<std::size_t>(components), accessor.normalized};
    std::vector<double> numbers = read_numbers(file, accessor, form, where);
    if (others == NotFinite::kept) return numbers;
    const auto wrong = std::ranges::find_if_not(numbers, [](double n) { return std::isfinite(n); });
    if (wrong != numbers.end()) {
        const auto element = (wrong - numbers.begin()) / components;
        file.fail(where, fmt::format("element {} is not a finite number.", element));
    }
    return numbers;
}

std::vector<std::uint32_t> read_indices(const File& file, int index, std::size_t limit,
                                        std::string_view part) {
    const std::vector<double> numbers = read_vectors(file, index, 1, part);
    std::vector<std::uint32_t> indices;
    indices.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!(numbers[i] >= 0 && numbers[i] < static_cast<double>(limit)) ||
            numbers[i] != std::floor(numbers[i])) {
            file.fail(fmt::format("accessors[{}] ({})", index, part),
                      fmt::format("element {} is {}, but there are {} vertices.", i, numbers[i], limit));
        }
        indices.push_back(static_cast<std::uint32_t>(numbers[i]));
    }
    return indices;
}

}  // namespace stilb::io::gltf
