#include "cosserat_cable/math/spline_weights.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cassert>

namespace cosserat_cable {
namespace {

// Energy of the Hermite polynomial on [0, 1] that has value, first, ... (m-1)th derivative y_0 at 0
// and y_1 at 1:  integral of (f^(m))^2 = y_0' A y_0 + 2 y_0' B y_1 + y_1' C y_1. Exact integers. C
// is A with the signs of odd rows and columns turned (reflect the interval), so it is not stored.
template <int M>
struct HermiteEnergy;

template <>
struct HermiteEnergy<2> {
  static constexpr double kA[2][2] = {{12, 6}, {6, 4}};
  static constexpr double kB[2][2] = {{-12, 6}, {-6, 2}};
};

template <>
struct HermiteEnergy<4> {
  static constexpr double kA[4][4] = {{100800, 50400, 10080, 840},
                                      {50400, 25920, 5400, 480},
                                      {10080, 5400, 1200, 120},
                                      {840, 480, 120, 16}};
  static constexpr double kB[4][4] = {{-100800, 50400, -10080, 840},
                                      {-50400, 24480, -4680, 360},
                                      {-10080, 4680, -840, 60},
                                      {-840, 360, -60, 4}};
};

template <>
struct HermiteEnergy<5> {
  static constexpr double kA[5][5] = {{25401600, 12700800, 2721600, 302400, 15120},
                                      {12700800, 6451200, 1411200, 161280, 8400},
                                      {2721600, 1411200, 317520, 37800, 2100},
                                      {302400, 161280, 37800, 4800, 300},
                                      {15120, 8400, 2100, 300, 25}};
  static constexpr double kB[5][5] = {{-25401600, 12700800, -2721600, 302400, -15120},
                                      {-12700800, 6249600, -1310400, 141120, -6720},
                                      {-2721600, 1310400, -267120, 27720, -1260},
                                      {-302400, 141120, -27720, 2760, -120},
                                      {-15120, 6720, -1260, 120, -5}};
};

/// The energy of one interval of length r (in units of the window's mean spacing), split into the
/// given values (index 0) and the unknown derivatives (`x`: 1..M-1), at its left and right end.
template <int M>
struct Interval {
  static constexpr int kUnknowns = M - 1;
  using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  Block left_left, left_right, right_right;
  // Columns of the unknowns (rows) with the values at either end.
  Vector left_by_left_value, left_by_right_value, right_by_left_value, right_by_right_value;

  void Set(double r) {
    std::array<double, M> power;  // of r, that make derivatives by r from those by time
    power[0] = 1;
    for (int i = 1; i < M; ++i) power[i] = power[i - 1] * r;
    const double scale = 1 / (power[M - 1] * power[M - 1] * r);
    const auto& a = HermiteEnergy<M>::kA;
    const auto& b = HermiteEnergy<M>::kB;
    for (int i = 1; i < M; ++i) {
      const double row = scale * power[i];
      const double sign = i % 2 == 0 ? 1 : -1;
      left_by_left_value[i - 1] = row * a[i][0];
      left_by_right_value[i - 1] = row * b[i][0];
      right_by_left_value[i - 1] = row * b[0][i];
      right_by_right_value[i - 1] = sign * row * a[i][0];
      for (int j = 1; j < M; ++j) {
        const double entry = row * power[j];
        left_left(i - 1, j - 1) = entry * a[i][j];
        left_right(i - 1, j - 1) = entry * b[i][j];
        right_right(i - 1, j - 1) = (j % 2 == 0 ? sign : -sign) * entry * a[i][j];
      }
    }
  }
};

// The minimum over the unknown derivatives x of all knots solves S x = -V f, S block tridiagonal
// and positive definite. Wanted is g' x at one knot, so we solve S y = g and return -V' y:
// eliminate from both ends towards the knot, then substitute back outwards, for both right hand
// sides at once.
template <int M>
SplineWeights Solve(const double* times, int count, int knot) {
  using Item = Interval<M>;
  using Block = typename Item::Block;
  using Pair = Eigen::Matrix<double, Item::kUnknowns, 2>;  // columns: for f', for f''
  constexpr int kMaxKnots = SplineWeights::kMaxKnots;

  const double spacing = (times[count - 1] - times[0]) / (count - 1);
  std::array<Item, kMaxKnots> interval;
  for (int i = 0; i + 1 < count; ++i) interval[i].Set((times[i + 1] - times[i]) / spacing);

  // toward[i]: y_i = -toward[i] * y_(neighbour nearer to the knot).
  std::array<Block, kMaxKnots> toward;
  Block carried = Block::Zero();
  for (int i = 0; i < knot; ++i) {
    const Block diagonal = carried + interval[i].left_left;
    toward[i] = diagonal.llt().solve(interval[i].left_right);
    carried = interval[i].right_right - interval[i].left_right.transpose() * toward[i];
  }
  Block pivot = carried;
  carried.setZero();
  for (int i = count - 1; i > knot; --i) {
    const Block diagonal = carried + interval[i - 1].right_right;
    toward[i] = diagonal.llt().solve(interval[i - 1].left_right.transpose());
    carried = interval[i - 1].left_left - interval[i - 1].left_right * toward[i];
  }
  pivot += carried;

  std::array<Pair, kMaxKnots> y;
  Pair wanted = Pair::Zero();
  wanted(0, 0) = 1 / spacing;
  if constexpr (M > 2) wanted(1, 1) = 1 / (spacing * spacing);
  y[knot] = pivot.llt().solve(wanted);
  for (int i = knot - 1; i >= 0; --i) y[i] = -toward[i] * y[i + 1];
  for (int i = knot + 1; i < count; ++i) y[i] = -toward[i] * y[i - 1];

  SplineWeights weights;
  const auto add = [&weights](int k, const Eigen::Matrix<double, 1, 2>& value) {
    weights.first[k] -= value[0];
    weights.second[k] -= value[1];
  };
  for (int i = 0; i + 1 < count; ++i) {
    add(i, interval[i].left_by_left_value.transpose() * y[i] +
               interval[i].right_by_left_value.transpose() * y[i + 1]);
    add(i + 1, interval[i].left_by_right_value.transpose() * y[i] +
                   interval[i].right_by_right_value.transpose() * y[i + 1]);
  }
  return weights;
}

/// A cubic spline's unknowns are the slopes alone: its second derivative follows from the
/// polynomial of one interval beside the knot.
SplineWeights SolveCubic(const double* times, int count, int knot) {
  SplineWeights weights = Solve<2>(times, count, knot);
  const bool last = knot == count - 1;
  const int other = last ? knot - 1 : knot + 1;
  const SplineWeights beside = Solve<2>(times, count, other);
  const double h = times[other] - times[knot];  // negative on the left: the formula holds for both
  for (int k = 0; k < count; ++k) {
    weights.second[k] = -(4 * weights.first[k] + 2 * beside.first[k]) / h;
  }
  weights.second[other] += 6 / (h * h);
  weights.second[knot] -= 6 / (h * h);
  return weights;
}

}  // namespace

SplineWeights NaturalSplineWeights(const double* times, int count, int knot, SplineDegree degree) {
  assert(count >= 1 && count <= SplineWeights::kMaxKnots && knot >= 0 && knot < count);
  if (count == 1) return {};
  switch (degree) {
    case SplineDegree::kCubic:
      return SolveCubic(times, count, knot);
    case SplineDegree::kSeven:
      assert(count >= 4);
      return Solve<4>(times, count, knot);
    case SplineDegree::kNine:
      assert(count >= 5);
      return Solve<5>(times, count, knot);
  }
  return {};
}

}  // namespace cosserat_cable
