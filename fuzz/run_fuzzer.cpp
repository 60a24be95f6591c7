// The reader of state files: any contents give an InputError, or sums that stay the same when they are
// written and read again.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/results/run_file.h"
#include "run/pictures/picture_sums.h"
#include "run/plan.h"
#include "stilb/error.h"

namespace {

/// The sums as they were read, or the error; twice the same.
template <typename Sums>
void read_twice(const stilb::io::StoredRun& stored) {
    try {
        const auto sums = stilb::io::read_sums<Sums>(stored, "sums", "fuzzed");
        const std::string bytes = stilb::io::sums_of(sums);
        const stilb::io::StoredRun again{{}, {{"sums", bytes}}};
        if (stilb::io::sums_of(stilb::io::read_sums<Sums>(again, "sums", "fuzzed")) != bytes) std::abort();
    } catch (const stilb::InputError& error) {
        if (!std::string_view(error.what()).starts_with("fuzzed:")) std::abort();
    }
}

}  // namespace

/// The input is a whole file, whose hashes are seldom right, and the bytes of sums.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const stilb::io::StoredRun stored = stilb::io::read_run(bytes, "fuzzed");
        if (stilb::io::to_bytes(stilb::io::read_run(stilb::io::to_bytes(stored), "")) != to_bytes(stored))
            std::abort();
    } catch (const stilb::InputError& error) {
        if (!std::string_view(error.what()).starts_with("fuzzed:")) std::abort();
    }
    const stilb::io::StoredRun sums{{}, {{"sums", std::string(bytes)}}};
    read_twice<stilb::run::RunState>(sums);
    read_twice<stilb::run::PictureSums>(sums);
    return 0;
}
