// Numbers side by side as one scalar type. The kernel's templates work on one double, or on lanes:
// four or eight cables, or the two halves of one.
#pragma once

#include <cmath>
#include <type_traits>

namespace cosserat_cable {

// GCC's vector extension: native where the machine has vectors this wide, else split.
template <int N, class S>
struct VectorOf {
  typedef S Type __attribute__((vector_size(N * sizeof(S))));
};

/// `N` numbers side by side; S: double or float.
template <int N, class S = double>
struct alignas(N * sizeof(S)) BasicLanes {
  static constexpr int kCount = N;
  using Vector = typename VectorOf<N, S>::Type;
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
    v = static_cast<S>(s) - Vector{};
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
  /// `value` where `a` is at least `limit`, else 0.
  friend BasicLanes WhereAtLeast(const BasicLanes& a, double limit, const BasicLanes& value) {
    return Of(a.v >= BasicLanes(limit).v ? value.v : Vector{});
  }
  // One instruction where the code is compiled with -fno-math-errno.
  friend BasicLanes Sqrt(const BasicLanes& a) {
    BasicLanes roots;
    for (int lane = 0; lane < N; ++lane) roots.v[lane] = std::sqrt(a.v[lane]);
    return roots;
  }
  /// 1/sqrt(a) to 1e-14, in a third of the time of both operations: what float makes of it,
  /// refined. `a` within float's range.
  friend BasicLanes InverseSqrt(const BasicLanes& a) {
    if constexpr (N < 4) return 1.0 / Sqrt(a);  // so few are no faster in float
    typename VectorOf<N, float>::Type rough = __builtin_convertvector(a.v, decltype(rough));
    for (int lane = 0; lane < N; ++lane) rough[lane] = 1.0f / std::sqrt(rough[lane]);
    const Vector x = __builtin_convertvector(rough, Vector);
    return Of(x * (1.5 - 0.5 * a.v * x * x));
  }
};

/// Four cables, side by side.
using Lanes = BasicLanes<4>;
/// Eight cables: as many as the widest vectors hold.
using WideLanes = BasicLanes<8>;
/// The two halves of a cable.
using LanePair = BasicLanes<2>;

/// The same numbers, each rounded to the other's precision.
template <class To, class From>
To Converted(const From& from) {
  if constexpr (std::is_same_v<To, From>)
    return from;
  else
    return To::Of(__builtin_convertvector(from.v, typename To::Vector));
}

// What a template needs that treats one double as a single lane.

template <class T>
inline constexpr int kLaneCount = 1;
template <int N, class S>
inline constexpr int kLaneCount<BasicLanes<N, S>> = N;

inline double GetLane(double value, int) { return value; }
template <int N, class S>
double GetLane(const BasicLanes<N, S>& value, int lane) {
  return value[lane];
}
inline void SetLane(double* value, int, double x) { *value = x; }
template <int N, class S>
void SetLane(BasicLanes<N, S>* value, int lane, double x) {
  value->v[lane] = static_cast<S>(x);
}

inline double Max(double a, double b) { return a > b ? a : b; }
inline double Min(double a, double b) { return a < b ? a : b; }
inline double WhereAtLeast(double a, double limit, double value) { return a >= limit ? value : 0; }
inline double Sqrt(double a) { return std::sqrt(a); }
inline double InverseSqrt(double a) { return 1 / std::sqrt(a); }
template <class T>
T Abs(const T& a) {
  return Max(a, -a);
}

}  // namespace cosserat_cable
