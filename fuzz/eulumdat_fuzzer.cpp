// The reader of EULUMDAT files: any bytes give an InputError, or a file whose distribution works.
#include "photometry_fuzzer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return stilb::fuzz_photometry(stilb::io::read_eulumdat, data, size);
}
