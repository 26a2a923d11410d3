// Elimination of one node after the other from a chain's symmetric block-tridiagonal system, block
// L D L^T: what a sweep over the chain does at each node.
#pragma once

#include "block_tridiagonal.h"

namespace cosserat_cable::rod {

/// Lower triangle of a symmetric 6x6 block. Not initialised.
template <class T>
struct Triangle6 {
  T v[21];

  T& at(int row, int column) { return v[row * (row + 1) / 2 + column]; }
  const T& at(int row, int column) const { return v[row * (row + 1) / 2 + column]; }
};

/// What is kept of a node: S = U D U^T of its own block after elimination of those before, and
/// D^{-1} U^{-1} L^T, L the block that couples the next node to it.
template <class T>
struct NodeFactor {
  T unit[15];    // below the diagonal of U, row by row
  T inverse[6];  // of D
  T gain[6][6];

  const T& u(int row, int column) const { return unit[row * (row - 1) / 2 + column]; }
};

// Everything is computed in local copies and stored once: the compiler cannot know that what is
// read and what is written do not overlap.

/// Factorises `s`; lowers `smallest` to the smallest pivot.
template <class T>
void FactoriseNode(const Triangle6<T>& s, NodeFactor<T>* f, T* smallest) {
  Triangle6<T> a = s;
  T lowest = *smallest;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const T pivot = a.at(k, k), one_over = T(1) / pivot;
    lowest = Min(lowest, pivot);
    f->inverse[k] = one_over;
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) {
      const T factor = a.at(r, k) * one_over;
#pragma GCC unroll 6
      for (int c = k + 1; c <= r; ++c) a.at(r, c) -= factor * a.at(c, k);
      f->unit[r * (r - 1) / 2 + k] = factor;
    }
  }
  *smallest = lowest;
}

/// From `coupling` = L^T: the gain, and the next node's block less what the elimination takes from
/// it.
template <class T>
void CoupleNode(const T coupling[6][6], NodeFactor<T>* f, Triangle6<T>* next) {
  T w[6][6];  // U^{-1} L^T, by columns
#pragma GCC unroll 6
  for (int r = 0; r < 6; ++r) {
    T column[6], gain[6];
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      T x = coupling[k][r];
#pragma GCC unroll 6
      for (int j = 0; j < k; ++j) x -= f->u(k, j) * column[j];
      column[k] = x;
      gain[k] = f->inverse[k] * x;
    }
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      w[r][k] = column[k];
      f->gain[k][r] = gain[k];
    }
#pragma GCC unroll 6
    for (int c = 0; c <= r; ++c) {
      T sum = next->at(r, c);
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) sum -= gain[k] * w[c][k];
      next->at(r, c) = sum;
    }
  }
}

/// Forward substitution within a node, and what it takes from the next node's right-hand side.
template <class T>
void SubstituteNode(const NodeFactor<T>& f, Vec6<T>* rhs, Vec6<T>* next_rhs) {
  Vec6<T> b = *rhs, next = *next_rhs;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) b[r] -= f.u(r, k) * b[k];
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) next[c] -= f.gain[k][c] * b[k];
  }
  *rhs = b;
  *next_rhs = next;
}

/// Solution at a node from its substituted right-hand side and the next node's solution.
template <class T>
Vec6<T> SolveNode(const NodeFactor<T>& f, const Vec6<T>& b, const Vec6<T>& next) {
  Vec6<T> x;
#pragma GCC unroll 6
  for (int r = 0; r < 6; ++r) {
    x[r] = f.inverse[r] * b[r];
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) x[r] -= f.gain[r][c] * next[c];
  }
#pragma GCC unroll 6
  for (int c = 5; c > 0; --c)
#pragma GCC unroll 6
    for (int r = 0; r < c; ++r) x[r] -= f.u(c, r) * x[c];
  return x;
}

}  // namespace cosserat_cable::rod
