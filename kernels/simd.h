// One function, several instruction sets: the loader picks the clone the processor can run, so that
// a binary built for any x86-64 uses wide vectors where there are some. Levels, not processors: a
// name fits neither another maker's nor a newer one. Off under sanitizers, whose runtime is not up
// when the loader asks.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define EDGESCOUT_SIMD_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define EDGESCOUT_SIMD_CLONES
#endif
