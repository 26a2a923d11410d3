// Numbers below 2.2e-308 count as zero in a hot loop.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace cosserat_cable {

/// While one lives, this thread takes subnormal numbers for zero, as operands and as results; then
/// the thread's own mode is back. The velocities of a cable that comes to rest decay through these
/// numbers, and a processor needs some hundred cycles for each operation on them: a step at rest
/// took twenty times as long as one in motion. No effect where the processor has no such mode.
class FlushSubnormals {
 public:
  FlushSubnormals() : mode_(Get()) { Set(mode_ | kFlush); }
  ~FlushSubnormals() { Set(mode_); }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
#if defined(__SSE2__)
  using Mode = unsigned;
  static constexpr Mode kFlush = 0x8040;  // MXCSR: flush to zero, denormals are zero
  static Mode Get() { return _mm_getcsr(); }
  static void Set(Mode mode) { _mm_setcsr(mode); }
#elif defined(__aarch64__)
  using Mode = std::uint64_t;
  static constexpr Mode kFlush = Mode{1} << 24;  // FPCR: flush to zero
  static Mode Get() {
    Mode mode;
    asm volatile("mrs %0, fpcr" : "=r"(mode));
    return mode;
  }
  static void Set(Mode mode) { asm volatile("msr fpcr, %0" ::"r"(mode)); }
#else
  using Mode = int;
  static constexpr Mode kFlush = 0;
  static Mode Get() { return 0; }
  static void Set(Mode) {}
#endif

  Mode mode_;
};

}  // namespace cosserat_cable
