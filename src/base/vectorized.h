// Own hot loops are compiled for several instruction sets; the widest that the processor has is picked at run
// time.
#pragma once

// Sanitizers instrument the code that picks, which runs before they are ready.
#if defined(__SANITIZE_ADDRESS__) || defined(__clang__)
#define STILB_VECTORIZED
#else
#define STILB_VECTORIZED __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
