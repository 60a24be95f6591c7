#include "io/text/unread_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw InputError("cannot be read, because it is a folder. Name a file.", {path.string()});
    size_ = std::filesystem::file_size(path, error);
    if (error) throw InputError(fmt::format("cannot be read: {}", error.message()), {path.string()});
    stream_.open(path, std::ios::binary);
}

void InputFile::read(char* bytes, std::size_t count) {
    if (stream_.read(bytes, static_cast<std::streamsize>(count))) return;
    throw InputError(
        "cannot be read completely. Check its permissions, and that no other program writes to it.",
        {path_.string()});
}

std::string reading_stage(const std::filesystem::path& path) {
    return fmt::format("reading {}", path == "-" ? "standard input" : path.filename().string());
}

FilePieces::FilePieces(const std::filesystem::path& path, const Monitor& monitor, std::size_t piece_size)
    : file_(path), monitor_(monitor), stage_(reading_stage(path)), piece_size_(piece_size) {}

std::string_view FilePieces::extended(std::string_view rest) {
    if (left() == 0) return rest;
    // A line that is longer than a piece doubles the buffer, so that it is not moved again for every piece.
    const auto count =
        static_cast<std::size_t>(std::min<std::uintmax_t>(left(), std::max(piece_size_, rest.size())));
    const std::size_t needed = rest.size() + count;
    if (buffer_.size() < needed) {
        std::vector<char> larger(needed);
        std::ranges::copy(rest, larger.begin());
        buffer_ = std::move(larger);
    } else if (!rest.empty()) {
        std::memmove(buffer_.data(), rest.data(), rest.size());
    }
    file_.read(buffer_.data() + rest.size(), count);
    read_ += count;
    monitor_.report(stage_, static_cast<double>(read_) / static_cast<double>(file_.size()));
    return {buffer_.data(), needed};
}

UnreadBytes::UnreadBytes(FilePieces& file)
    : file_(&file), in_memory_(text_of(file.extended({}), file.path().string())) {}

bool UnreadBytes::extend() {
    if (file_ == nullptr || file_->left() == 0) return false;
    in_memory_ = file_->extended(in_memory_);
    return true;
}

}  // namespace stilb::io
