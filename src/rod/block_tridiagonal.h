// Direct solver for symmetric block-tridiagonal systems with 6x6 blocks: one per node, position
// then rotation. Block L D L^T, O(N), no pivoting across blocks (none is needed for the positive
// definite systems of a time step; an indefinite one is reported).
#pragma once

#include <vector>

#include "cosserat_cable/math/lanes.h"
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
  explicit BlockTridiagonal(int nodes) : diagonal_(nodes), lower_(nodes), inverse_(nodes) {}

  /// Block (i, i); only its lower triangle is read. Overwritten by Factorise.
  Block6<T>& diagonal(int i) { return diagonal_[i]; }
  /// Block (i + 1, i). Overwritten by Factorise.
  Block6<T>& lower(int i) { return lower_[i]; }

  /// Factorises nodes `first`..`last` (inclusive) in place. Returns the smallest pivot, or
  /// 1 where that is larger: positive exactly where the matrix is positive definite.
  T Factorise(int first, int last) {
    first_ = first;
    last_ = last;
    T smallest = T(1);
    for (int i = first; i <= last; ++i) {
      Block6<T>& s = diagonal_[i];
      if (i > first) SubtractCoupling(lower_[i - 1], inverse_[i - 1], &s);
      FactoriseBlock(&s, &inverse_[i]);
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) smallest = Min(smallest, s[k][k]);
      if (i < last) SolveUnitLower(s, &lower_[i]);
    }
    return smallest;
  }

  /// Overwrites the right-hand side of the nodes factorised with the solution.
  void Solve(Vec6<T>* x) const {
    for (int i = first_; i <= last_; ++i) {
      Vec6<T> b = x[i];
      if (i > first_) {  // b -= W^T z
        const Block6<T>& w = lower_[i - 1];
        const Vec6<T>& z = x[i - 1];
#pragma GCC unroll 6
        for (int c = 0; c < 6; ++c)
          b[c] -= ((w[0][c] * z[0] + w[1][c] * z[1]) + (w[2][c] * z[2] + w[3][c] * z[3])) +
                  (w[4][c] * z[4] + w[5][c] * z[5]);
      }
      const Block6<T>& unit = diagonal_[i];
#pragma GCC unroll 6
      for (int c = 0; c < 5; ++c)
#pragma GCC unroll 6
        for (int r = c + 1; r < 6; ++r) b[r] -= unit[r][c] * b[c];
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) x[i][r] = b[r] * inverse_[i][r];
    }
    for (int i = last_; i >= first_; --i) {
      Vec6<T> b = x[i];
      if (i < last_) {  // b -= D^{-1} W x
        const Block6<T>& w = lower_[i];
        const Vec6<T>& z = x[i + 1];
#pragma GCC unroll 6
        for (int r = 0; r < 6; ++r)
          b[r] -= inverse_[i][r] *
                  (((w[r][0] * z[0] + w[r][1] * z[1]) + (w[r][2] * z[2] + w[r][3] * z[3])) +
                   (w[r][4] * z[4] + w[r][5] * z[5]));
      }
      const Block6<T>& unit = diagonal_[i];
#pragma GCC unroll 6
      for (int c = 5; c > 0; --c)
#pragma GCC unroll 6
        for (int r = 0; r < c; ++r) b[r] -= unit[c][r] * b[c];
      x[i] = b;
    }
  }

 private:
  /// s -= W^T diag(1/d) W, lower triangle.
  static void SubtractCoupling(const Block6<T>& w, const Vec6<T>& inverse, Block6<T>* s) {
    Block6<T> scaled;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k)
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) scaled[k][r] = w[k][r] * inverse[k];
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r)
#pragma GCC unroll 6
      for (int c = 0; c <= r; ++c)
        s->m[r][c] -= ((scaled[0][r] * w[0][c] + scaled[1][r] * w[1][c]) +
                       (scaled[2][r] * w[2][c] + scaled[3][r] * w[3][c])) +
                      (scaled[4][r] * w[4][c] + scaled[5][r] * w[5][c]);
  }

  /// Leaves the unit lower factor below the diagonal and the pivots on it.
  static void FactoriseBlock(Block6<T>* block, Vec6<T>* inverse) {
    Block6<T>& s = *block;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      const T one_over = T(1) / s[k][k];
      (*inverse)[k] = one_over;
      T factor[6];
#pragma GCC unroll 6
      for (int r = k + 1; r < 6; ++r) factor[r] = s[r][k] * one_over;
#pragma GCC unroll 6
      for (int r = k + 1; r < 6; ++r)
#pragma GCC unroll 6
        for (int c = k + 1; c <= r; ++c) s[r][c] -= factor[r] * s[c][k];
#pragma GCC unroll 6
      for (int r = k + 1; r < 6; ++r) s[r][k] = factor[r];
    }
  }

  /// Overwrites the lower block L with W = U^{-1} L^T, U unit lower triangular.
  static void SolveUnitLower(const Block6<T>& unit, Block6<T>* lower) {
    Block6<T> w;
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) {
#pragma GCC unroll 6
      for (int c = 0; c < 6; ++c) w[r][c] = lower->m[c][r];
#pragma GCC unroll 6
      for (int k = 0; k < r; ++k)
#pragma GCC unroll 6
        for (int c = 0; c < 6; ++c) w[r][c] -= unit[r][k] * w[k][c];
    }
    *lower = w;
  }

  int first_ = 0, last_ = -1;
  std::vector<Block6<T>> diagonal_;  // then: unit factors
  std::vector<Block6<T>> lower_;     // then: W_i = U_i^{-1} L_{i+1,i}^T
  std::vector<Vec6<T>> inverse_;     // 1/pivot
};

}  // namespace cosserat_cable::rod
