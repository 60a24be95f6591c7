// The words of a Radiance scene file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::io::radiance {

/// Reads words one after another. Words are separated by white space; those in quotes may contain it.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    /// Moves to the next word, behind blanks, empty lines and comments ("#" to the end of the line). False at
    /// the end.
    bool skip_to_word();
    /// The next word, which may be in quotes; nothing at the end of the text. Comments before it are skipped.
    std::optional<std::string_view> next();
    /// Whether the next character begins a command.
    bool at_command() const { return position_ < text_.size() && text_[position_] == '!'; }
    /// The rest of the line without the "!"; lines that end with a backslash are continued.
    std::string take_command();
    /// The line of the next character, from 1.
    std::uint32_t line() const { return line_; }

  private:
    std::string_view text_;
    std::size_t position_ = 0;
    std::uint32_t line_ = 1;
};

/// The arguments of the programs of a pipeline "genbox wall b 1 2 3 | xform -t 1 0 0". Throws InputError
/// (without a place) for everything else that a shell would interpret.
std::vector<std::vector<std::string>> split_command(std::string_view command);
/// The words of a line of an argument file of xform.
std::vector<std::string> split_arguments(std::string_view line);

}  // namespace stilb::io::radiance
