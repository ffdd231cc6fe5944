// One function, several instruction sets: the loader picks the clone the processor can run, so that a binary built for any
// x86-64 uses wide vectors where there are some. Off under sanitizers, whose runtime is not up when the loader asks.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define EDGESCOUT_SIMD_CLONES __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define EDGESCOUT_SIMD_CLONES
#endif
