// How hot loops are compiled: for the machine's own vector units, chosen when the program
// starts.
#pragma once

// One binary runs on any x86-64: the functions marked exist twice, with and without AVX2 and FMA;
// those that work on lanes as wide as AVX-512's, also with that. Sanitizers instrument the resolver
// that chooses, before they are set up themselves: not with them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
#define COSSERAT_CABLE_KERNEL __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#define COSSERAT_CABLE_WIDE_KERNEL \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#else
#define COSSERAT_CABLE_KERNEL
#define COSSERAT_CABLE_WIDE_KERNEL
#endif

namespace cosserat_cable {

/// Whether this machine's vectors hold eight doubles.
inline bool HasWideVectors() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#else
  return false;
#endif
}

}  // namespace cosserat_cable
