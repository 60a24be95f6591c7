// Numbers as the bytes of a file, little-endian, and back.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "stilb/error.h"

namespace stilb {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

/// Numbers, or structs of numbers of one size, which have no gaps.
template <typename T>
constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && sizeof(T) % 2 == 0;

class ByteWriter {
  public:
    template <typename T>
    void add(const T& number) {
        static_assert(kIsPlain<T>);
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    template <typename List>
    void add_list(const List& list) {
        using T = std::remove_cvref_t<decltype(*std::data(list))>;
        static_assert(kIsPlain<T> || std::is_same_v<T, char>);
        add(static_cast<std::uint64_t>(std::size(list)));
        bytes_.append(reinterpret_cast<const char*>(std::data(list)), std::size(list) * sizeof(T));
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class ByteReader {
  public:
    /// `first`: the offset of the first byte in the file `name`, for messages; `remedy` ends them. Keeps
    /// references to the texts.
    ByteReader(std::string_view bytes, std::size_t first, const std::string& name, std::string_view remedy)
        : rest_(bytes), position_(first), name_(name), remedy_(remedy) {}

    template <typename T>
    T take(std::string_view what) {
        static_assert(kIsPlain<T>);
        if (rest_.size() < sizeof(T)) fail(fmt::format("the file ends before {}", what));
        T number;
        std::memcpy(&number, rest_.data(), sizeof number);
        skip(sizeof number);
        return number;
    }
    /// Allocates memory only after checking the remaining size of the file.
    template <typename List>
    List take_list(std::string_view what) {
        using T = typename List::value_type;
        static_assert(kIsPlain<T> || std::is_same_v<T, char>);
        const auto count = take<std::uint64_t>(what);
        if (count > rest_.size() / sizeof(T)) {
            fail(fmt::format("{}: {} entries are expected, but only {} bytes are left", what, count,
                             rest_.size()));
        }
        List list(static_cast<std::size_t>(count), T{});
        if (count > 0) std::memcpy(list.data(), rest_.data(), list.size() * sizeof(T));
        skip(list.size() * sizeof(T));
        return list;
    }
    /// Replaces the entries of a list, whose number stays.
    template <typename List>
    void take_same_size(List& list, std::string_view what) {
        auto taken = take_list<List>(what);
        if (taken.size() != list.size())
            fail(fmt::format("{}: {} entries are expected, but there are {}", what, list.size(),
                             taken.size()));
        list = std::move(taken);
    }
    void expect_end() const {
        if (!rest_.empty()) fail(fmt::format("{} surplus bytes", rest_.size()));
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(
            fmt::format("damaged at byte {} of its contents: {}. {}", position_, message, remedy_), {name_});
    }

  private:
    void skip(std::size_t count) {
        rest_.remove_prefix(count);
        position_ += count;
    }

    std::string_view rest_;
    std::size_t position_;
    const std::string& name_;
    std::string_view remedy_;
};

}  // namespace stilb
