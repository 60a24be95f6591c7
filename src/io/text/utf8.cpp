#include "io/text/utf8.h"

#include <algorithm>
#include <cstddef>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length of the UTF-8 sequence at the start of `text`; 0 for an invalid one, or a control character of two
/// bytes.
std::size_t utf8_length(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return 1;
    const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (length == 0 || length > text.size()) return 0;
    const std::string_view rest = text.substr(1, length - 1);
    if (!std::all_of(rest.begin(), rest.end(), is_continuation)) return 0;
    const auto second = static_cast<unsigned char>(text[1]);
    const bool below_range = (lead == 0xC2 || lead == 0xE0) ? second < 0xA0 : lead == 0xF0 && second < 0x90;
    const bool above_range = lead == 0xED ? second >= 0xA0 : lead == 0xF4 && second >= 0x90;
    return below_range || above_range ? 0 : length;
}

/// Whether it is UTF-16 in either order of bytes: by its mark, or by zeros beside the first two letters.
bool is_utf16(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
    if (text.size() < 4) return false;
    const bool first = text[0] == 0, second = text[1] == 0;
    return first != second && (text[2] == 0) == first && (text[3] == 0) == second;
}

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    return text;
}

std::string_view text_of(std::string_view content, const std::string& name) {
    if (is_utf16(content)) throw InputError("is text in UTF-16. Save it as UTF-8.", {name});
    return without_byte_order_mark(content);
}

std::string read_text_file(const std::filesystem::path& path) {
    std::string content = read_whole_file(path);
    content.erase(0, content.size() - text_of(content, path.string()).size());
    return content;
}

std::string as_utf8(std::string_view bytes) {
    std::string result;
    for (std::size_t i = 0; i < bytes.size();) {
        const auto byte = static_cast<unsigned char>(bytes[i]);
        const std::size_t length = utf8_length(bytes.substr(i));
        if (length == 1 || (length == 0 && byte < 0xA0)) {
            result += byte < 0x20 || byte >= 0x7F ? ' ' : bytes[i];
        } else if (length == 0) {
            result += {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
        } else {
            result += bytes.substr(i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    return result;
}

std::string printable(std::string_view bytes) { return std::string(trimmed(as_utf8(bytes))); }

}  // namespace stilb::io
