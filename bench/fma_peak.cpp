#include "fma_peak.h"

namespace cosserat_cable::bench {
namespace {

constexpr int kRounds = 20000;
// Latency times ports of every core made so far is 10 or less; 16 registers hold them and both
// factors.
constexpr int kChains = 12;

volatile double seen = 0.999;  // what nobody sees would not be computed

// Vectors of a size that depends on a template's parameter lose it in an array: GCC wants names.
struct Narrow {
  typedef double Vector __attribute__((vector_size(16)));
};
struct Avx2 {
  typedef double Vector __attribute__((vector_size(32)));
};
struct Avx512 {
  typedef double Vector __attribute__((vector_size(64)));
};

template <class Width>
[[gnu::always_inline]] inline double Chains() {
  using Vector = typename Width::Vector;
  constexpr int kLanes = sizeof(Vector) / sizeof(double);
  Vector x[kChains];
  for (int i = 0; i < kChains; ++i) x[i] = Vector{} + i * seen;
  const Vector factor = Vector{} + seen, summand = Vector{} + 1e-3;
  for (int round = 0; round < kRounds; ++round) {
#pragma GCC unroll 12
    for (int i = 0; i < kChains; ++i) x[i] = x[i] * factor + summand;
  }
  Vector sum = x[0];
  for (int i = 1; i < kChains; ++i) sum += x[i];
  for (int lane = 0; lane < kLanes; ++lane)
    if (sum[lane] > 1e300) seen = 0;  // it never is; nobody else knows
  return 2.0 * kChains * kLanes * kRounds;
}

#if defined(__x86_64__)
[[gnu::target("avx512f")]] double WithAvx512() { return Chains<Avx512>(); }
[[gnu::target("avx2,fma")]] double WithAvx2() { return Chains<Avx2>(); }
#endif

}  // namespace

double RunFma() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return WithAvx512();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return WithAvx2();
#endif
  return Chains<Narrow>();
}

}  // namespace cosserat_cable::bench
