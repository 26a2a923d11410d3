// Four doubles side by side as one scalar type. The kernel's templates work on one double, or on
// lanes: four elements of one cable, or four cables.
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
  Lanes(double a, double b, double c, double d) : v{a, b, c, d} {}
  static Lanes Of(const Vector& vector) {
    Lanes lanes;
    lanes.v = vector;
    return lanes;
  }

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

inline Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v + b.v); }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v - b.v); }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v * b.v); }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v / b.v); }
inline Lanes operator-(const Lanes& a) { return Lanes::Of(-a.v); }
inline Lanes sqrt(const Lanes& a) {
  return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

// What a template needs that treats one double as a single lane.

template <class T>
inline constexpr int kLaneCount = 1;
template <>
inline constexpr int kLaneCount<Lanes> = Lanes::kCount;

inline double GetLane(double value, int) { return value; }
inline double GetLane(const Lanes& value, int lane) { return value[lane]; }
inline void SetLane(double* value, int, double x) { *value = x; }
inline void SetLane(Lanes* value, int lane, double x) { value->v[lane] = x; }

inline double Max(double a, double b) { return a > b ? a : b; }
inline Lanes Max(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v > b.v ? a.v : b.v); }
inline double Min(double a, double b) { return a < b ? a : b; }
inline Lanes Min(const Lanes& a, const Lanes& b) { return Lanes::Of(a.v < b.v ? a.v : b.v); }
template <class T>
T Abs(const T& a) {
  return Max(a, -a);
}

}  // namespace cosserat_cable
