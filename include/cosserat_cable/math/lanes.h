// Four doubles side by side as one scalar type: the kernel's templates work on one element or on
// four.
#pragma once

#include <cmath>

namespace cosserat_cable {

struct alignas(32) Lanes {
  static constexpr int kCount = 4;
  // GCC's vector extension: native with AVX2, split in two with SSE2 or NEON.
  typedef double Vector __attribute__((vector_size(8 * kCount)));
  Vector v;

  Lanes() = default;
  Lanes(double s) : v{s, s, s, s} {}  // NOLINT: a number stands for itself in every lane
  explicit Lanes(Vector vector) : v(vector) {}
  Lanes(double a, double b, double c, double d) : v{a, b, c, d} {}

  double operator[](int lane) const { return v[lane]; }

  Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    v -= b.v;
    return *this;
  }
};

inline Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v + b.v); }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v - b.v); }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v * b.v); }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v / b.v); }
inline Lanes operator-(const Lanes& a) { return Lanes(-a.v); }
inline Lanes sqrt(const Lanes& a) {
  return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

}  // namespace cosserat_cable
