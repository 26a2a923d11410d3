// Doubles side by side as one scalar type. The kernel's templates work on one double, or on lanes:
// four or eight cables, or the two halves of one.
#pragma once

#include <cmath>

namespace cosserat_cable {

// GCC's vector extension: native where the machine has vectors this wide, else split.
template <int N>
struct VectorOf;
template <>
struct VectorOf<2> {
  typedef double Type __attribute__((vector_size(16)));
};
template <>
struct VectorOf<4> {
  typedef double Type __attribute__((vector_size(32)));
};

template <>
struct VectorOf<8> {
  typedef double Type __attribute__((vector_size(64)));
};

template <int N>
struct alignas(8 * N) BasicLanes {
  static constexpr int kCount = N;
  using Vector = typename VectorOf<N>::Type;
  Vector v;

  BasicLanes() = default;
  // Copied as a vector: GCC takes apart the bytes of a struct that is wider than the vectors of the
  // oldest machine it compiles for.
  BasicLanes(const BasicLanes& b) : v(b.v) {}
  BasicLanes& operator=(const BasicLanes& b) {
    v = b.v;
    return *this;
  }
  BasicLanes(double s) {  // NOLINT: a number stands for itself in every lane
    v = s - Vector{};
  }
  static BasicLanes Of(const Vector& vector) {
    BasicLanes lanes;
    lanes.v = vector;
    return lanes;
  }

  double operator[](int lane) const { return v[lane]; }

  BasicLanes& operator+=(const BasicLanes& b) {
    v += b.v;
    return *this;
  }
  BasicLanes& operator-=(const BasicLanes& b) {
    v -= b.v;
    return *this;
  }

  // Friends, so that a double on one side is taken for lanes.
  friend BasicLanes operator+(const BasicLanes& a, const BasicLanes& b) { return Of(a.v + b.v); }
  friend BasicLanes operator-(const BasicLanes& a, const BasicLanes& b) { return Of(a.v - b.v); }
  friend BasicLanes operator*(const BasicLanes& a, const BasicLanes& b) { return Of(a.v * b.v); }
  friend BasicLanes operator/(const BasicLanes& a, const BasicLanes& b) { return Of(a.v / b.v); }
  friend BasicLanes operator-(const BasicLanes& a) { return Of(-a.v); }
  friend BasicLanes Max(const BasicLanes& a, const BasicLanes& b) {
    return Of(a.v > b.v ? a.v : b.v);
  }
  friend BasicLanes Min(const BasicLanes& a, const BasicLanes& b) {
    return Of(a.v < b.v ? a.v : b.v);
  }
};

/// Four cables, side by side.
using Lanes = BasicLanes<4>;
/// Eight cables: as many as the widest vectors hold.
using WideLanes = BasicLanes<8>;
/// The two halves of a cable.
using LanePair = BasicLanes<2>;

// What a template needs that treats one double as a single lane.

template <class T>
inline constexpr int kLaneCount = 1;
template <int N>
inline constexpr int kLaneCount<BasicLanes<N>> = N;

inline double GetLane(double value, int) { return value; }
template <int N>
double GetLane(const BasicLanes<N>& value, int lane) {
  return value[lane];
}
inline void SetLane(double* value, int, double x) { *value = x; }
template <int N>
void SetLane(BasicLanes<N>* value, int lane, double x) {
  value->v[lane] = x;
}

inline double Max(double a, double b) { return a > b ? a : b; }
inline double Min(double a, double b) { return a < b ? a : b; }
template <class T>
T Abs(const T& a) {
  return Max(a, -a);
}

}  // namespace cosserat_cable
