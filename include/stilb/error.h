// Errors that a user can mend, and interruptions. The library throws them; only the command line prints and
// exits.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stilb {

/// Where in the user's files something is wrong. An empty file or line 0 is left out of the message.
struct SourceLocation {
    std::string file;
    std::size_t line = 0;
};

/// Wrong input: what is wrong (why it matters), then what would be right. what() reads "file:line: message".
class InputError : public std::runtime_error {
  public:
    explicit InputError(const std::string& message, const SourceLocation& where = {});
};

/// Thrown out of work that ended before there was any result: the user or the time limit ended it. what()
/// says why and where, and what would help.
class Cancelled : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The allowed name nearest to `found` by edit distance; empty where none is near.
std::string nearest_name(std::string_view found, std::span<const std::string_view> allowed);

}  // namespace stilb
