// Errors in the user's input, and interruptions. The library throws them; only the command line prints them
// and exits.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#pragma GCC visibility push(default)

namespace stilb {

/// The position of an error in the user's files. An empty file or line 0 is left out of the message.
struct SourceLocation {
    std::string file;
    std::size_t line = 0;
};

/// An error in the input. The message names the problem, its reason where it is not obvious, and the remedy;
/// what() reads "file:line: message".
class InputError : public std::runtime_error {
  public:
    explicit InputError(const std::string& message, const SourceLocation& where = {});
};

/// Thrown where the user or the time limit ends work before there is any result. what() states the cause, the
/// stage and a remedy.
class Cancelled : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The allowed name nearest to `found` by edit distance; empty where none is near.
std::string nearest_name(std::string_view found, std::span<const std::string_view> allowed);

/// ` Did you mean "wall"?` with the allowed name nearest to `found`, to follow a sentence; empty where none
/// is near.
std::string did_you_mean(std::string_view found, std::span<const std::string_view> allowed);

}  // namespace stilb

#pragma GCC visibility pop
