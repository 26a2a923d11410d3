#include "undamped_modes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace cosserat_cable::rod {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 200;
constexpr int kMaxShifts = 60;
// Relative change of w^2 in one iteration; another one follows, because shapes converge as its
// root.
constexpr double kTolerance = 1e-9;
constexpr double kRounding = 1e-15;  // of w^2, relative to the stiffest unknown's
constexpr int kGuard = 8;  // columns beyond those wanted: they set the rate of convergence

/// (K + shift M)^-1 with a shift that makes it positive definite.
class ShiftedInverse {
 public:
  ShiftedInverse(const LinearisedRod& rod, const SymmetricBands& stiffness, double scale)
      : system_(stiffness.nodes()), column_(stiffness.nodes()), shift_(scale) {
    for (int attempt = 0; attempt < kMaxShifts; ++attempt, shift_ *= 4)
      if (Factorise(rod, stiffness)) return;
    throw std::runtime_error("modes: the stiffness matrix is not finite");
  }

  double shift() const { return shift_; }

  void Solve(MatrixXd* x) {
    for (int c = 0; c < x->cols(); ++c) {
      for (std::size_t i = 0; i < column_.size(); ++i)
        for (int k = 0; k < 6; ++k) column_[i][k] = (*x)(6 * i + k, c);
      system_.Solve(column_.data());
      for (std::size_t i = 0; i < column_.size(); ++i)
        for (int k = 0; k < 6; ++k) (*x)(6 * i + k, c) = column_[i][k];
    }
  }

 private:
  bool Factorise(const LinearisedRod& rod, const SymmetricBands& stiffness) {
    const int nodes = stiffness.nodes();
    for (int i = 0; i < nodes; ++i)
      for (int r = 0; r < 6; ++r) {
        for (int c = 0; c < 6; ++c) {
          system_.diagonal(i)[r][c] = stiffness.diagonal[i](r, c);
          if (i + 1 < nodes) system_.lower(i)[r][c] = stiffness.lower[i](r, c);
        }
        system_.diagonal(i)[r][r] += rod.held[6 * i + r] ? 1.0 : shift_ * rod.mass[6 * i + r];
      }
    return system_.Factorise(0, nodes - 1) > 0;
  }

  BlockTridiagonal<double> system_;
  std::vector<Vec6<double>> column_;
  double shift_;
};

}  // namespace

UndampedModes FindUndampedModes(const LinearisedRod& rod, int count, int accurate, double scale) {
  const SymmetricBands stiffness = rod.Stiffness();
  ShiftedInverse inverse(rod, stiffness, scale);
  const VectorXd root_mass = rod.mass.cwiseSqrt();
  const int moving = static_cast<int>((rod.mass.array() > 0).count());
  const int columns = std::min(moving, count + kGuard);
  count = std::min(count, columns);
  accurate = std::min(accurate, columns);

  double stiffest = 0;
  for (int k = 0; k < rod.unknowns(); ++k)
    if (rod.mass[k] > 0)
      stiffest = std::max(stiffest, stiffness.diagonal[k / 6](k % 6, k % 6) / rod.mass[k]);

  std::mt19937_64 random(1);
  MatrixXd x(rod.unknowns(), columns);
  // Not a distribution of the library's: those may differ between compilers.
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < rod.unknowns(); ++r)
      x(r, c) = root_mass[r] > 0 ? std::ldexp(static_cast<double>(random() >> 11), -53) - 0.5 : 0.0;
  VectorXd values = VectorXd::Zero(columns);
  bool converged = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    // The first time these are forces, then shapes.
    if (iteration > 0) x = rod.mass.asDiagonal() * x;
    inverse.Solve(&x);
    // Twice: after the first time, columns that were nearly parallel are so to rounding only.
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::HouseholderQR<MatrixXd> qr(root_mass.asDiagonal() * x);
      x = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(x);
    }
    const MatrixXd projected = x.transpose() * (stiffness * x);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(0.5 * (projected + projected.transpose()));
    if (ritz.info() != Eigen::Success || !ritz.eigenvalues().allFinite())
      throw std::runtime_error("modes: the stiffness matrix is not finite");
    x = x * ritz.eigenvectors();
    const bool done = converged;
    converged = ((ritz.eigenvalues() - values).head(accurate).array().abs() <=
                 kTolerance * (ritz.eigenvalues().head(accurate).array().abs() + inverse.shift()) +
                     kRounding * stiffest)
                    .all();
    values = ritz.eigenvalues();
    if (done) return {values.head(count), x.leftCols(count)};
  }
  throw std::runtime_error("modes: the search for the undamped modes does not converge");
}

}  // namespace cosserat_cable::rod
