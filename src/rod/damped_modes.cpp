#include "damped_modes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable::rod {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 40;
constexpr double kTolerance = 1e-10;  // last relative change of lambda
// Beside a double root (critical damping) lambda is known to the square root of rounding only.
constexpr double kNearlyConverged = 1e-5;
constexpr double kReal = 1e-7;  // imaginary parts below, relative, are rounding
// Two roots nearer than this, relative, are one; apart by kApart before refinement, they were two.
constexpr double kSame = 1e-7, kApart = 1e-3;

/// A root of the projected system with its vector, in modal coordinates.
struct Candidate {
  Complex lambda;
  VectorXcd modal;
  /// Of each mode: this root's part in what follows a blow, relative to the mode without damping,
  /// and in what follows a release at rest from a pull; both roots of a pair together.
  VectorXd after_blow, after_release;
};

/// First values: the system projected on a basis of undamped modes, where M is the identity.
///
/// With v = lambda x and, for each relaxation rate r of the section's laws, z = lambda/(lambda + r)
/// x, K(lambda) is linear, and all roots come at once:
///     lambda x = v,  lambda v = -K(0) x - D v - sum_r G_r z_r,  lambda z_r = v - r z_r.
///
/// Roots slower than `rigid` [1/s] are left out.
std::vector<Candidate> ProjectedRoots(const LinearisedRod& rod, const UndampedModes& basis,
                                      double rigid) {
  const int m = static_cast<int>(basis.w_squared.size());
  const auto project = [&basis](const SymmetricBands& a) -> MatrixXd {
    return basis.shapes.transpose() * (a * basis.shapes);
  };
  MatrixXd damping = project(rod.load_damping);
  std::vector<double> rates;
  std::vector<MatrixXd> relaxing;
  for (int i = 0; i < LinearisedRod::kComponents; ++i) {
    const DynamicModulus& modulus = rod.moduli[i];
    const MatrixXd stiffness = project(rod.material[i]) / modulus.C;
    damping += modulus.V * stiffness;
    for (const DynamicModulus::Branch& branch : modulus.branches) {
      if (branch.G == 0) continue;
      const auto same = std::find(rates.begin(), rates.end(), branch.rate);
      if (same == rates.end()) {
        rates.push_back(branch.rate);
        relaxing.emplace_back(branch.G * stiffness);
      } else {
        relaxing[same - rates.begin()] += branch.G * stiffness;
      }
    }
  }

  // v in units of `unit`, so that the entries are of like size.
  const double unit = std::sqrt(std::max(basis.w_squared.cwiseAbs().maxCoeff(), 1e-300));
  const int size = m * (2 + static_cast<int>(rates.size()));
  MatrixXd a = MatrixXd::Zero(size, size);
  a.block(0, m, m, m).diagonal().setConstant(unit);
  a.block(m, 0, m, m).diagonal() = -basis.w_squared / unit;
  a.block(m, m, m, m) = -damping;
  for (std::size_t b = 0; b < rates.size(); ++b) {
    const int row = m * (2 + static_cast<int>(b));
    a.block(m, row, m, m) = -relaxing[b] / unit;
    a.block(row, m, m, m).diagonal().setConstant(unit);
    a.block(row, row, m, m).diagonal().setConstant(-rates[b]);
  }
  const Eigen::EigenSolver<MatrixXd> solver(a);
  std::vector<Candidate> candidates;
  if (solver.info() != Eigen::Success) return candidates;
  for (int k = 0; k < size; ++k) {
    Candidate c;
    c.lambda = solver.eigenvalues()[k];
    if (std::abs(c.lambda) < rigid) continue;
    if (c.lambda.imag() < 0) continue;  // its conjugate stands for both
    c.modal = solver.eigenvectors().col(k).head(m);
    // The receptance of mode n, e_n^T T(lambda)^-1 e_n, has the residue x_n^2/(x^T T' x).
    VectorXcd slope = 2.0 * c.lambda * c.modal + damping * c.modal;
    for (std::size_t b = 0; b < rates.size(); ++b) {
      const Complex by_rate = c.lambda + rates[b];
      slope += rates[b] / (by_rate * by_rate) * (relaxing[b] * c.modal);
    }
    const double norm = std::abs((c.modal.transpose() * slope).value());
    const VectorXd residue = (c.lambda.imag() > 0 ? 2.0 : 1.0) * c.modal.cwiseAbs2() /
                             std::max(norm, std::numeric_limits<double>::min());
    c.after_blow = basis.w_squared.cwiseAbs().cwiseSqrt().cwiseProduct(residue);
    c.after_release = basis.w_squared.cwiseAbs().cwiseProduct(residue) /
                      std::max(std::abs(c.lambda), std::numeric_limits<double>::min());
    if (c.after_blow.allFinite() && c.after_release.allFinite()) candidates.push_back(c);
  }
  return candidates;
}

/// For each mode the conjugate pair that it oscillates as, the clearest cases first, or -1 where a
/// real root carries more of its motion after a release. No pair serves twice.
std::vector<int> AssignPairs(const std::vector<Candidate>& candidates, int modes) {
  struct Claim {
    double part;
    int mode, candidate;
  };
  std::vector<Claim> claims;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c)
    for (int n = 0; n < modes; ++n) claims.push_back({candidates[c].after_release[n], n, c});
  std::stable_sort(claims.begin(), claims.end(),
                   [](const Claim& a, const Claim& b) { return a.part > b.part; });
  std::vector<int> pair(modes, -1);
  std::vector<bool> decided(modes, false), taken(candidates.size(), false);
  for (const Claim& claim : claims) {
    if (decided[claim.mode] || taken[claim.candidate]) continue;
    decided[claim.mode] = true;
    if (candidates[claim.candidate].lambda.imag() <= 0) continue;
    pair[claim.mode] = claim.candidate;
    taken[claim.candidate] = true;
  }
  return pair;
}

/// T(lambda) = lambda^2 M + K(lambda) of the whole rod.
class DynamicStiffness {
 public:
  explicit DynamicStiffness(const LinearisedRod& rod) : rod_(rod) {}

  /// The root near `lambda` and its vector near `x`, by inverse iteration: O(elements) each.
  bool Refine(Complex* lambda, VectorXcd* x) {
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      if (!Factorise(*lambda)) return last < kNearlyConverged;
      const VectorXcd u = solver_.solve(TimesDerivative(*lambda, *x));
      const VectorXcd held = rod_.mass.cwiseProduct(*x);  // keeps the vector's size and phase
      const Complex along = held.dot(u), change = held.dot(*x) / along;
      if (!u.allFinite() || !std::isfinite(std::abs(change))) return last < kNearlyConverged;
      *x = u / std::sqrt(std::abs(u.dot(rod_.mass.cwiseProduct(u))));
      *lambda -= change;
      last = std::abs(change) / std::abs(*lambda);
      if (last < kTolerance) return true;
    }
    return last < kNearlyConverged;
  }

  /// |residue| at a root of the receptance of a shape that is normalised in M.
  double Residue(const Complex& lambda, const VectorXcd& x, const VectorXd& shape) const {
    const Complex part = (shape.cwiseProduct(rod_.mass).transpose() * x).value();
    const Complex slope = (x.transpose() * TimesDerivative(lambda, x)).value();
    return std::norm(part) / std::max(std::abs(slope), std::numeric_limits<double>::min());
  }

 private:
  using Sparse = Eigen::SparseMatrix<Complex>;

  bool Factorise(const Complex& lambda) {
    std::array<Complex, LinearisedRod::kComponents> factor;
    for (int i = 0; i < LinearisedRod::kComponents; ++i)
      factor[i] = rod_.moduli[i](lambda) / rod_.moduli[i].C;
    const auto sum = [&](auto block_of) {
      Eigen::Matrix<Complex, 6, 6> sum = block_of(rod_.geometric).template cast<Complex>();
      sum += lambda * block_of(rod_.load_damping);
      for (int i = 0; i < LinearisedRod::kComponents; ++i)
        sum += factor[i] * block_of(rod_.material[i]);
      for (const SymmetricBands& stiffness : rod_.laws) sum += block_of(stiffness);
      return sum;
    };
    entries_.clear();
    const auto put = [this](int row, int column, const Complex& value) {
      entries_.emplace_back(row, column, value);
    };
    const int nodes = rod_.geometric.nodes();
    for (int n = 0; n < nodes; ++n) {
      const auto diagonal = sum([n](const SymmetricBands& a) { return a.diagonal[n]; });
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) put(6 * n + r, 6 * n + c, diagonal(r, c));
      if (n + 1 == nodes) break;
      const auto lower = sum([n](const SymmetricBands& a) { return a.lower[n]; });
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) {
          put(6 * n + 6 + r, 6 * n + c, lower(r, c));
          put(6 * n + c, 6 * n + 6 + r, lower(r, c));
        }
    }
    for (int k = 0; k < rod_.unknowns(); ++k)
      put(k, k, rod_.held[k] ? Complex(1) : lambda * lambda * rod_.mass[k]);
    matrix_.resize(rod_.unknowns(), rod_.unknowns());
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    if (!analysed_) solver_.analyzePattern(matrix_);
    analysed_ = true;
    solver_.factorize(matrix_);
    return solver_.info() == Eigen::Success;
  }

  VectorXcd TimesDerivative(const Complex& lambda, const VectorXcd& x) const {
    VectorXcd y = 2.0 * lambda * rod_.mass.cwiseProduct(x) + rod_.load_damping * x;
    for (int i = 0; i < LinearisedRod::kComponents; ++i)
      y += rod_.moduli[i].Derivative(lambda) / rod_.moduli[i].C * (rod_.material[i] * x);
    return y;
  }

  const LinearisedRod& rod_;
  std::vector<Eigen::Triplet<Complex>> entries_;
  Sparse matrix_;
  Eigen::SparseLU<Sparse> solver_;
  bool analysed_ = false;
};

bool Near(const Complex& a, const Complex& b, double relative) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

/// A root of the whole system, and its part in a mode's motion.
struct Root {
  Complex lambda;
  double after_release, after_blow;
};

/// The roots of the whole system that carry most of a mode's motion: from those of the projected
/// one that do.
class RootSearch {
 public:
  RootSearch(const LinearisedRod& rod, const UndampedModes& basis,
             const std::vector<Candidate>& candidates)
      : system_(rod), basis_(basis), candidates_(candidates) {}

  bool Refine(int mode, int candidate, Root* root) {
    root->lambda = candidates_[candidate].lambda;
    VectorXcd x = basis_.shapes * candidates_[candidate].modal;
    if (!system_.Refine(&root->lambda, &x)) return false;
    if (std::abs(root->lambda.imag()) < kReal * std::abs(root->lambda))
      root->lambda = root->lambda.real();
    if (root->lambda.imag() < 0) root->lambda = std::conj(root->lambda);
    const double both = root->lambda.imag() > 0 ? 2 : 1;
    const double w_squared = std::abs(basis_.w_squared[mode]);
    const double residue = both * system_.Residue(root->lambda, x, basis_.shapes.col(mode));
    root->after_blow = std::sqrt(w_squared) * residue;
    root->after_release = w_squared * residue / std::abs(root->lambda);
    return true;
  }

  /// The roots of a mode that does not oscillate.
  bool Creep(int mode, ModeRoots* roots) {
    std::vector<Root> found;
    const auto take = [&](VectorXd Candidate::*part) {
      std::vector<int> order(candidates_.size());
      for (std::size_t c = 0; c < order.size(); ++c) order[c] = static_cast<int>(c);
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return (candidates_[a].*part)[mode] > (candidates_[b].*part)[mode];
      });
      for (std::size_t k = 0; k < order.size() && k < kTried; ++k) {
        Root root;
        if (!Refine(mode, order[k], &root)) continue;
        if (std::none_of(found.begin(), found.end(),
                         [&](const Root& r) { return Near(r.lambda, root.lambda, kSame); }))
          found.push_back(root);
      }
    };
    take(&Candidate::after_release);
    take(&Candidate::after_blow);
    const auto first = std::max_element(
        found.begin(), found.end(),
        [](const Root& a, const Root& b) { return a.after_release < b.after_release; });
    if (first == found.end()) return false;
    roots->lambda = first->lambda;
    if (first->lambda.imag() > 0) {
      roots->second = std::conj(first->lambda);
      return true;
    }
    found.erase(first);
    const auto second =
        std::max_element(found.begin(), found.end(),
                         [](const Root& a, const Root& b) { return a.after_blow < b.after_blow; });
    // At critical damping the two are one.
    roots->second = second == found.end() ? roots->lambda : second->lambda;
    // The slow one first; but one that grows outlives any that does not.
    const bool grows = roots->lambda.real() > 0, second_grows = roots->second.real() > 0;
    const bool slower = std::abs(roots->second) < std::abs(roots->lambda);
    if (second_grows != grows ? second_grows : slower) std::swap(roots->lambda, roots->second);
    return true;
  }

 private:
  static constexpr std::size_t kTried = 5;  // candidates that may turn out to carry most

  DynamicStiffness system_;
  const UndampedModes& basis_;
  const std::vector<Candidate>& candidates_;
};

}  // namespace

bool FindRoots(const LinearisedRod& rod, const UndampedModes& basis, int count, double rigid,
               std::vector<ModeRoots>* roots) {
  const std::vector<Candidate> candidates = ProjectedRoots(rod, basis, rigid);
  const std::vector<int> pairs = AssignPairs(candidates, static_cast<int>(basis.w_squared.size()));
  RootSearch search(rod, basis, candidates);
  std::vector<Complex> before, after;
  roots->assign(count, {});
  for (int n = 0; n < count; ++n) {
    if (std::abs(basis.w_squared[n]) < rigid * rigid) continue;
    Root root;
    if (pairs[n] >= 0 && search.Refine(n, pairs[n], &root) && root.lambda.imag() > 0) {
      (*roots)[n] = {root.lambda, std::conj(root.lambda)};
      before.push_back(candidates[pairs[n]].lambda);
      after.push_back(root.lambda);
    } else if (!search.Creep(n, &(*roots)[n])) {
      return false;
    }
  }
  for (std::size_t i = 0; i < after.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (Near(after[i], after[k], kSame) && !Near(before[i], before[k], kApart)) return false;
  return true;
}

}  // namespace cosserat_cable::rod
