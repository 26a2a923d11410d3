// How hot loops are compiled: for the machine's own vector units, chosen when the program
// starts.
#pragma once

// One binary runs on any x86-64: the functions marked exist three times, with AVX-512, with AVX2
// and FMA, and without. Lanes of four gain by AVX-512 as well: it has twice the registers.
// Sanitizers instrument the resolver that chooses, before they are set up themselves: not with
// them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
// For one of them alone, "x86-64-v3": what another machine computes, on this one.
#ifdef COSSERAT_CABLE_VECTOR_UNIT
#define COSSERAT_CABLE_KERNEL __attribute__((target("arch=" COSSERAT_CABLE_VECTOR_UNIT), flatten))
#else
#define COSSERAT_CABLE_KERNEL \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#endif
#else
#define COSSERAT_CABLE_KERNEL
#endif

namespace cosserat_cable {

/// The one that is in use: "x86-64-v4", "x86-64-v3" or "x86-64"; "" where there is no choice.
inline const char* VectorUnit() {
#if defined(COSSERAT_CABLE_VECTOR_UNIT)
  return COSSERAT_CABLE_VECTOR_UNIT;
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__)
  return __builtin_cpu_supports("x86-64-v4")   ? "x86-64-v4"
         : __builtin_cpu_supports("x86-64-v3") ? "x86-64-v3"
                                               : "x86-64";
#else
  return "";
#endif
}

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
