// Symmetric block-tridiagonal matrices as they are, to be added and multiplied: six unknowns per
// node, position then rotation.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "block_tridiagonal.h"

namespace cosserat_cable::rod {

struct SymmetricBands {
  using Block = Eigen::Matrix<double, 6, 6>;

  explicit SymmetricBands(int nodes)
      : diagonal(nodes, Block::Zero()), lower(nodes - 1, Block::Zero()) {}

  /// What was assembled for a solver, before it factorises.
  static SymmetricBands Of(BlockTridiagonal<double>* system, int nodes) {
    SymmetricBands bands(nodes);
    for (int i = 0; i < nodes; ++i)
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c <= r; ++c)
          bands.diagonal[i](r, c) = bands.diagonal[i](c, r) = system->diagonal(i)[r][c];
    for (int i = 0; i + 1 < nodes; ++i)
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) bands.lower[i](r, c) = system->lower(i)[r][c];
    return bands;
  }

  int nodes() const { return static_cast<int>(diagonal.size()); }

  SymmetricBands& Add(double factor, const SymmetricBands& other) {
    for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] += factor * other.diagonal[i];
    for (std::size_t i = 0; i < lower.size(); ++i) lower[i] += factor * other.lower[i];
    return *this;
  }

  /// Clears the rows and columns of an unknown.
  void Clear(int unknown) {
    const int node = unknown / 6, k = unknown % 6;
    diagonal[node].row(k).setZero();
    diagonal[node].col(k).setZero();
    if (node > 0) lower[node - 1].row(k).setZero();
    if (node + 1 < nodes()) lower[node].col(k).setZero();
  }

  /// Takes for a node unknowns y with x = S y in place of x.
  void Substitute(int node, const Block& S) {
    diagonal[node] = (S.transpose() * diagonal[node] * S).eval();
    if (node > 0) lower[node - 1] = (S.transpose() * lower[node - 1]).eval();
    if (node + 1 < nodes()) lower[node] = (lower[node] * S).eval();
  }

  /// The matrix times columns of any scalar.
  template <class Matrix>
  Matrix operator*(const Matrix& x) const {
    Matrix y = Matrix::Zero(x.rows(), x.cols());
    for (int i = 0; i < nodes(); ++i) {
      y.middleRows(6 * i, 6) += diagonal[i] * x.middleRows(6 * i, 6);
      if (i + 1 == nodes()) break;
      y.middleRows(6 * i + 6, 6) += lower[i] * x.middleRows(6 * i, 6);
      y.middleRows(6 * i, 6) += lower[i].transpose() * x.middleRows(6 * i + 6, 6);
    }
    return y;
  }

  std::vector<Block> diagonal;  ///< block (i, i)
  std::vector<Block> lower;     ///< block (i + 1, i)
};

}  // namespace cosserat_cable::rod
