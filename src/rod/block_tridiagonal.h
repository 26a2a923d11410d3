// Direct solver for symmetric block-tridiagonal systems with 6x6 blocks: one per node, position
// then rotation. Block L D L^T, O(N), no pivoting across blocks (none is needed for the positive
// definite systems of a time step; an indefinite one is reported).
#pragma once

#include <vector>

#include "cosserat_cable/math/small.h"

namespace cosserat_cable::rod {

template <class T>
struct Vec6 {
  T v[6];

  T& operator[](int i) { return v[i]; }
  const T& operator[](int i) const { return v[i]; }
};

/// Not initialised: it is always written before it is read.
/// Not initialised: it is always written before it is read.
template <class T>
struct Block6 {
  T m[6][6];

  T* operator[](int i) { return m[i]; }
  const T* operator[](int i) const { return m[i]; }

  /// Sets one of the four 3x3 quarters: rows `i`, columns `j` in {0: position, 1: rotation}.
  void SetQuarter(int i, int j, const Mat3<T>& a) {
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) m[3 * i + r][3 * j + c] = a[r][c];
  }
  void AddQuarter(int i, int j, const Mat3<T>& a) {
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) m[3 * i + r][3 * j + c] += a[r][c];
  }
};

template <class T>
class BlockTridiagonal {
 public:
  explicit BlockTridiagonal(int nodes)
      : diagonal_(nodes), lower_(nodes), unit_(nodes), inverse_(nodes), coupling_(nodes) {}

  /// Block (i, i); only its lower triangle is read.
  Block6<T>& diagonal(int i) { return diagonal_[i]; }
  /// Block (i + 1, i).
  Block6<T>& lower(int i) { return lower_[i]; }

  /// Factorises nodes `first`..`last` (inclusive); returns the smallest pivot relative to its
  /// diagonal entry: positive exactly where the matrix is positive definite.
  T Factorise(int first, int last) {
    first_ = first;
    last_ = last;
    T smallest = T(1);
    for (int i = first; i <= last; ++i) {
      Block6<T> s = diagonal_[i];
      if (i > first) SubtractCoupling(coupling_[i - 1], inverse_[i - 1], &s);
      smallest = Min(smallest, FactoriseBlock(s, diagonal_[i], &unit_[i], &inverse_[i]));
      if (i < last) coupling_[i] = SolveUnitLower(unit_[i], lower_[i]);
    }
    return smallest;
  }

  /// Overwrites the right-hand side of the nodes factorised with the solution.
  void Solve(Vec6<T>* x) const {
    for (int i = first_; i <= last_; ++i) {
      Vec6<T> b = x[i];
      if (i > first_)  // b -= W^T z, W = coupling
#pragma GCC unroll 6
        for (int k = 0; k < 6; ++k)
#pragma GCC unroll 6
          for (int c = 0; c < 6; ++c) b[c] -= coupling_[i - 1][k][c] * x[i - 1][k];
#pragma GCC unroll 6
      for (int r = 1; r < 6; ++r)
#pragma GCC unroll 6
        for (int c = 0; c < r; ++c) b[r] -= unit_[i][r][c] * b[c];
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) x[i][r] = b[r] * inverse_[i][r];
    }
    for (int i = last_; i >= first_; --i) {
      Vec6<T> b = x[i];
      if (i < last_)
#pragma GCC unroll 6
        for (int r = 0; r < 6; ++r) {
          T sum = T(0);
#pragma GCC unroll 6
          for (int c = 0; c < 6; ++c) sum += coupling_[i][r][c] * x[i + 1][c];
          b[r] -= sum * inverse_[i][r];
        }
#pragma GCC unroll 6
      for (int r = 4; r >= 0; --r)
#pragma GCC unroll 6
        for (int c = r + 1; c < 6; ++c) b[r] -= unit_[i][c][r] * b[c];
      x[i] = b;
    }
  }

 private:
  static T Min(const T& a, const T& b) { return b < a ? b : a; }

  /// s -= W^T diag(1/d) W, lower triangle.
  static void SubtractCoupling(const Block6<T>& w, const Vec6<T>& inverse, Block6<T>* s) {
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k)
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) {
        const T scaled = w[k][r] * inverse[k];
#pragma GCC unroll 6
        for (int c = 0; c <= r; ++c) s->m[r][c] -= scaled * w[k][c];
      }
  }

  static T FactoriseBlock(Block6<T>& s, const Block6<T>& original, Block6<T>* unit,
                          Vec6<T>* inverse) {
    T smallest = T(1);
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      const T pivot = s[k][k];
      smallest = Min(smallest, pivot / original[k][k]);
      (*inverse)[k] = T(1) / pivot;
#pragma GCC unroll 6
      for (int r = k + 1; r < 6; ++r) {
        const T factor = s[r][k] * (*inverse)[k];
#pragma GCC unroll 6
        for (int c = k + 1; c <= r; ++c) s[r][c] -= factor * s[c][k];
        (*unit)[r][k] = factor;
      }
    }
    return smallest;
  }

  /// W = U^{-1} L^T with U unit lower triangular.
  static Block6<T> SolveUnitLower(const Block6<T>& unit, const Block6<T>& lower) {
    Block6<T> w;
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) {
#pragma GCC unroll 6
      for (int c = 0; c < 6; ++c) w[r][c] = lower[c][r];
#pragma GCC unroll 6
      for (int k = 0; k < r; ++k) {
        const T factor = unit[r][k];
#pragma GCC unroll 6
        for (int c = 0; c < 6; ++c) w[r][c] -= factor * w[k][c];
      }
    }
    return w;
  }

  int first_ = 0, last_ = -1;
  std::vector<Block6<T>> diagonal_, lower_;
  std::vector<Block6<T>> unit_;      // strictly lower triangles of the blocks' unit factors
  std::vector<Vec6<T>> inverse_;     // 1/pivot
  std::vector<Block6<T>> coupling_;  // W_i
};

}  // namespace cosserat_cable::rod
