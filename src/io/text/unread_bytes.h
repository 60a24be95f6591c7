// Files that are read from front to back, a piece at a time, so that a large one takes little memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"

namespace stilb::io {

/// A file that is open for reading.
class InputFile {
  public:
    /// Throws InputError where it cannot be read.
    explicit InputFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    /// Of the whole file, in bytes.
    std::uintmax_t size() const { return size_; }
    /// The next bytes. Throws InputError where the file has become shorter, or cannot be read.
    void read(char* bytes, std::size_t count);

  private:
    std::filesystem::path path_;
    std::ifstream stream_;
    std::uintmax_t size_ = 0;
};

/// How a monitor is told that a file is being read.
std::string reading_stage(const std::filesystem::path& path);

/// The pieces of a file.
class FilePieces {
  public:
    static constexpr std::size_t kPieceSize = std::size_t{1} << 18;

    /// `monitor`: takes the share of the file that is read, and may interrupt; must outlive the pieces.
    /// `piece_size`: as many bytes are read at a time. Throws as InputFile does.
    explicit FilePieces(const std::filesystem::path& path, const Monitor& monitor = Monitor::none(),
                        std::size_t piece_size = kPieceSize);
    FilePieces(const FilePieces&) = delete;
    FilePieces& operator=(const FilePieces&) = delete;

    const std::filesystem::path& path() const { return file_.path(); }
    /// Bytes of the file that are in no piece yet.
    std::uintmax_t left() const { return file_.size() - read_; }
    /// `rest`, the end of the view that the last call returned (or nothing), and the next piece behind it;
    /// the same bytes alone at the end of the file. Earlier views become invalid.
    std::string_view extended(std::string_view rest);

  private:
    InputFile file_;
    const Monitor& monitor_;
    std::string stage_;
    std::size_t piece_size_;
    std::vector<char> buffer_;
    std::uintmax_t read_ = 0;
};

/// The bytes that a reader has not read yet: of a text in memory, or of a file. Does not own them.
class UnreadBytes {
  public:
    UnreadBytes(std::string_view text) : in_memory_(text) {}
    UnreadBytes(const std::string& text) : in_memory_(text) {}
    /// Without a byte-order mark. Throws InputError where the file is text in UTF-16.
    UnreadBytes(FilePieces& file);

    /// The first of them, as many as are in memory.
    std::string_view in_memory() const { return in_memory_; }
    /// Their number.
    std::uintmax_t size() const { return in_memory_.size() + (file_ ? file_->left() : 0); }
    /// Leaves out the first of those in memory.
    void remove_prefix(std::size_t count) { in_memory_.remove_prefix(count); }
    /// Adds to those in memory, which makes earlier views invalid; false where there is nothing to add.
    bool extend();

  private:
    FilePieces* file_ = nullptr;
    std::string_view in_memory_;
};

}  // namespace stilb::io
