#include "damped_terms.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>

namespace cosserat_cable {
namespace {

// Bounds, in units of the record's duration T: slower ones are straight lines to it.
constexpr double kSlowestOmega = 0.05;
constexpr double kSlowestCreep = 0.1;
// A growing oscillation is not stopped at once, so that the estimate of a small damping has no
// bias.
constexpr double kFastestGrowth = 3;
constexpr int kMostIterations = 60;

// (1 - exp(-2 d t))/(2 d), and its derivative by d.
struct ShiftPhase {
  double value, slope;
};
ShiftPhase PhaseOfShift(double d, double t) {
  const double x = 2 * d * t;
  if (std::abs(x) < 1e-3) return {t * (1 - x / 2 + x * x / 6), t * t * (-1 + 2 * x / 3)};
  const double decay = std::exp(-x);
  const double value = -std::expm1(-x) / (2 * d);
  return {value, (t * decay - value) / d};
}

// The terms' nonlinear parameters in one vector, times the duration.
std::vector<double> Pack(const std::vector<DampedTerm>& terms, double duration) {
  std::vector<double> x;
  for (const DampedTerm& term : terms) {
    if (term.oscillates) x.push_back(term.omega * duration);
    x.push_back(term.delta * duration);
    if (term.oscillates && term.shifts) x.push_back(term.shift * duration);
  }
  return x;
}

void Unpack(const double* x, double duration, std::vector<DampedTerm>* terms) {
  for (DampedTerm& term : *terms) {
    if (term.oscillates) term.omega = *x++ / duration;
    term.delta = *x++ / duration;
    if (term.oscillates && term.shifts) term.shift = *x++ / duration;
  }
}

// Derivatives of the fit by the nonlinear parameters at fixed amplitudes.
Eigen::MatrixXd TermSlopes(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms,
                           const Eigen::VectorXd& amplitudes, int count) {
  Eigen::MatrixXd slopes(t.size(), count);
  int column = 0, linear = 1;
  for (const DampedTerm& term : terms) {
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const double decay = std::exp(-term.delta * t[i]);
      if (!term.oscillates) {
        slopes(i, column) = -t[i] * decay * amplitudes[linear];
        continue;
      }
      const ShiftPhase phase = PhaseOfShift(term.delta, t[i]);
      const double psi = term.omega * t[i] + (term.shifts ? term.shift * phase.value : 0);
      const double cosine = std::cos(psi), sine = std::sin(psi);
      const double c = amplitudes[linear], s = amplitudes[linear + 1];
      const double value = decay * (c * cosine + s * sine);
      const double quadrature = decay * (s * cosine - c * sine);
      slopes(i, column) = t[i] * quadrature;
      slopes(i, column + 1) =
          -t[i] * value + (term.shifts ? term.shift * phase.slope * quadrature : 0);
      if (term.shifts) slopes(i, column + 2) = phase.value * quadrature;
    }
    column += term.nonlinear();
    linear += term.linear();
  }
  return slopes;
}

int Count(const std::vector<DampedTerm>& terms) {
  int count = 0;
  for (const DampedTerm& term : terms) count += term.nonlinear();
  return count;
}

// Residual and Jacobian (Kaufman's) with the amplitudes eliminated.
struct Projection {
  Eigen::VectorXd amplitudes, white_residual;
  Eigen::MatrixXd jacobian;  // by the nonlinear parameters; only where asked for
  bool finite = false;
};

Projection Project(const Eigen::VectorXd& t, const Eigen::VectorXd& white_y,
                   const std::vector<DampedTerm>& terms, const NoiseCorrelation& noise,
                   bool with_jacobian) {
  Projection p;
  Eigen::MatrixXd columns = TermColumns(t, terms);
  if (!columns.allFinite()) return p;
  noise.Whiten(columns);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::Index rank = columns.cols();
  p.amplitudes = qr.solve(white_y);
  const auto out_of_span = [&](Eigen::Ref<Eigen::MatrixXd> m) {
    Eigen::MatrixXd rotated = qr.householderQ().adjoint() * m;
    rotated.topRows(rank).setZero();
    m = qr.householderQ() * rotated;
  };
  p.white_residual = white_y;
  out_of_span(p.white_residual);
  if (!p.amplitudes.allFinite()) return p;
  if (with_jacobian) {
    p.jacobian = -TermSlopes(t, terms, p.amplitudes, Count(terms));
    noise.Whiten(p.jacobian);
    out_of_span(p.jacobian);
    if (!p.jacobian.allFinite()) return p;
  }
  p.finite = true;
  return p;
}

class TermsCost : public ceres::CostFunction {
 public:
  TermsCost(const Eigen::VectorXd& t, const Eigen::VectorXd& white_y,
            const std::vector<DampedTerm>& terms, const NoiseCorrelation& noise)
      : t_(t), white_y_(white_y), terms_(terms), noise_(noise) {
    set_num_residuals(static_cast<int>(t.size()));
    mutable_parameter_block_sizes()->push_back(Count(terms));
    scale_ = 1 / std::max(white_y.norm(), 1e-300);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const double duration = t_[t_.size() - 1];
    std::vector<DampedTerm> terms = terms_;
    Unpack(x[0], duration, &terms);
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    const Projection p = Project(t_, white_y_, terms, noise_, wanted);
    if (!p.finite) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, t_.size()) = scale_ * p.white_residual;
    if (wanted) {
      // Ceres wants it row by row.
      Eigen::Map<Eigen::MatrixXd>(jacobians[0], p.jacobian.cols(), t_.size()) =
          (scale_ / duration * p.jacobian).transpose();
    }
    return true;
  }

 private:
  const Eigen::VectorXd& t_;
  const Eigen::VectorXd& white_y_;
  const std::vector<DampedTerm>& terms_;
  const NoiseCorrelation& noise_;
  double scale_ = 1;
};

void SetBounds(const std::vector<DampedTerm>& terms, double samples, double* x,
               ceres::Problem* problem) {
  int k = 0;
  const auto bound = [&](double low, double high) {
    x[k] = std::clamp(x[k], low, high);
    problem->SetParameterLowerBound(x, k, low);
    problem->SetParameterUpperBound(x, k, high);
    ++k;
  };
  const double nyquist = 3.14159265358979323846 * samples;
  for (const DampedTerm& term : terms) {
    if (!term.oscillates) {
      bound(kSlowestCreep, samples);
      continue;
    }
    bound(kSlowestOmega, 1.2 * nyquist);
    bound(-kFastestGrowth, 2 * samples);
    if (term.shifts) ++k;
  }
}

}  // namespace

void NoiseCorrelation::Whiten(Eigen::Ref<Eigen::MatrixXd> columns) const {
  if (white()) return;
  for (Eigen::Index i = columns.rows() - 1; i > 0; --i) {
    const double c = correlation[i];
    columns.row(i) = (columns.row(i) - c * columns.row(i - 1)) / std::sqrt(1 - c * c);
  }
}

double NoiseCorrelation::LogDeterminant() const {
  double sum = 0;
  for (Eigen::Index i = 1; i < correlation.size(); ++i) {
    sum += std::log1p(-correlation[i] * correlation[i]);
  }
  return sum;
}

Eigen::MatrixXd TermColumns(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms) {
  int count = 1;
  for (const DampedTerm& term : terms) count += term.linear();
  Eigen::MatrixXd columns(t.size(), count);
  columns.col(0).setOnes();
  int column = 1;
  for (const DampedTerm& term : terms) {
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const double decay = std::exp(-term.delta * t[i]);
      if (!term.oscillates) {
        columns(i, column) = decay;
        continue;
      }
      double psi = term.omega * t[i];
      if (term.shifts) psi += term.shift * PhaseOfShift(term.delta, t[i]).value;
      columns(i, column) = decay * std::cos(psi);
      columns(i, column + 1) = decay * std::sin(psi);
    }
    column += term.linear();
  }
  return columns;
}

TermsFit FitTerms(const Eigen::VectorXd& t, const Eigen::VectorXd& y,
                  const std::vector<DampedTerm>& start, const NoiseCorrelation& noise) {
  TermsFit fit;
  fit.terms = start;
  Eigen::VectorXd white_y = y;
  noise.Whiten(white_y);
  const double duration = t[t.size() - 1];
  bool usable = true;
  if (!start.empty()) {
    std::vector<double> x = Pack(start, duration);
    ceres::Problem problem;
    problem.AddResidualBlock(new TermsCost(t, white_y, start, noise), nullptr, x.data());
    SetBounds(start, static_cast<double>(t.size()), x.data(), &problem);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = kMostIterations;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-11;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    usable = summary.IsSolutionUsable();
    Unpack(x.data(), duration, &fit.terms);
  }
  const Projection p = Project(t, white_y, fit.terms, noise, true);
  if (!usable || !p.finite) return fit;
  fit.amplitudes = p.amplitudes;
  fit.white_residual = p.white_residual;
  fit.sum_of_squares = p.white_residual.squaredNorm();
  fit.residual = y - TermColumns(t, fit.terms) * p.amplitudes;
  fit.converged = true;
  if (!start.empty()) {
    // Scaled to a unit diagonal: frequencies and decay rates may differ by orders.
    const Eigen::MatrixXd hessian = p.jacobian.transpose() * p.jacobian;
    const Eigen::VectorXd scale = hessian.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(scale.asDiagonal() * hessian * scale.asDiagonal());
    fit.converged = scale.allFinite() && ldlt.isPositive() && ldlt.rcond() > 1e-13;
    fit.inverse_hessian = scale.asDiagonal() *
                          ldlt.solve(Eigen::MatrixXd::Identity(hessian.rows(), hessian.cols())) *
                          scale.asDiagonal();
  }
  return fit;
}

}  // namespace cosserat_cable
