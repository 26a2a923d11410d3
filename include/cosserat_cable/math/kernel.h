// How hot loops are compiled: for the machine's own vector units, chosen when the program
// starts.
#pragma once

// One binary runs on any x86-64: the functions marked exist twice, with and without AVX2 and FMA.
// Sanitizers instrument the resolver that chooses, before they are set up themselves: not with
// them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
#define COSSERAT_CABLE_KERNEL __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define COSSERAT_CABLE_KERNEL
#endif
