// The files that a command writes at its end.
#pragma once

#include <exception>
#include <string>
#include <vector>

namespace stilb::cli {

/// The disk may be full by the end of a long run. A file that cannot be written then costs neither the other
/// files nor what the command prints; the command fails after all of these.
class Outputs {
  public:
    /// Calls `write_file`, which may throw. Returns whether it was written.
    template <typename WriteFile>
    bool write(const WriteFile& write_file) try {
        write_file();
        return true;
    } catch (const std::exception& error) {
        failures_.emplace_back(error.what());
        return false;
    }

    /// Names the files that could not be written, on stderr. Returns the command's exit code: that of a
    /// failure where there is such a file, or else `otherwise`.
    int conclude(int otherwise) const;

  private:
    std::vector<std::string> failures_;
};

}  // namespace stilb::cli
