#include "damped_terms.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "column_span.h"

namespace cosserat_cable {
namespace {

// Bounds, in units of the record's duration T: slower ones are straight lines to it.
constexpr double kSlowestOmega = 0.05;
constexpr double kSlowestCreep = 0.1;
// A growing oscillation is not stopped at once, so that the estimate of a small damping has no
// bias.
constexpr double kFastestGrowth = 3;
constexpr int kMostIterations = 40;

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

// What columns and slopes have in common, over the samples.
struct Wave {
  Eigen::ArrayXd cosine, sine;        // with the decay; a creep has its decay in `cosine` alone
  Eigen::ArrayXd phase, phase_slope;  // of the shift, per unit of it, and by delta; where it shifts
};

Wave MakeWave(const Eigen::VectorXd& t, const DampedTerm& term) {
  const Eigen::Index n = t.size();
  Wave wave;
  wave.cosine = (-term.delta * t.array()).exp();
  if (!term.oscillates) return wave;
  if (term.shifts) {
    wave.phase.resize(n);
    wave.phase_slope.resize(n);
  }
  wave.sine.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double psi = term.omega * t[i];
    if (term.shifts) {
      const ShiftPhase phase = PhaseOfShift(term.delta, t[i]);
      wave.phase[i] = phase.value;
      wave.phase_slope[i] = phase.slope;
      psi += term.shift * phase.value;
    }
    wave.sine[i] = wave.cosine[i] * std::sin(psi);
    wave.cosine[i] *= std::cos(psi);
  }
  return wave;
}

std::vector<Wave> MakeWaves(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms) {
  std::vector<Wave> waves;
  for (const DampedTerm& term : terms) waves.push_back(MakeWave(t, term));
  return waves;
}

Eigen::MatrixXd WaveColumns(Eigen::Index n, const std::vector<Wave>& waves) {
  Eigen::Index count = 1;
  for (const Wave& wave : waves) count += wave.sine.size() > 0 ? 2 : 1;
  Eigen::MatrixXd columns(n, count);
  columns.col(0).setOnes();
  Eigen::Index column = 1;
  for (const Wave& wave : waves) {
    columns.col(column++) = wave.cosine;
    if (wave.sine.size() > 0) columns.col(column++) = wave.sine;
  }
  return columns;
}

// Derivatives of the fit by the nonlinear parameters at fixed amplitudes.
Eigen::MatrixXd WaveSlopes(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms,
                           const std::vector<Wave>& waves, const Eigen::VectorXd& amplitudes,
                           int count) {
  Eigen::MatrixXd slopes(t.size(), count);
  int column = 0, linear = 1;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const DampedTerm& term = terms[k];
    const Wave& wave = waves[k];
    if (!term.oscillates) {
      slopes.col(column) = -t.array() * wave.cosine * amplitudes[linear];
    } else {
      const double c = amplitudes[linear], s = amplitudes[linear + 1];
      const Eigen::ArrayXd quadrature = s * wave.cosine - c * wave.sine;
      slopes.col(column) = t.array() * quadrature;
      slopes.col(column + 1) = -t.array() * (c * wave.cosine + s * wave.sine);
      if (term.shifts) {
        slopes.col(column + 1).array() += term.shift * wave.phase_slope * quadrature;
        slopes.col(column + 2) = wave.phase * quadrature;
      }
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

// The terms with the amplitudes that fit best.
struct Projection {
  std::vector<DampedTerm> terms;
  std::vector<Wave> waves;
  std::optional<ColumnSpan> span;  // of the waves, made white
  Eigen::VectorXd amplitudes, white_residual;
  bool finite = false;
};

Projection Project(const Eigen::VectorXd& t, const Eigen::VectorXd& white_y,
                   const std::vector<DampedTerm>& terms, const NoiseCorrelation& noise) {
  Projection p;
  p.terms = terms;
  p.waves = MakeWaves(t, terms);
  Eigen::MatrixXd columns = WaveColumns(t.size(), p.waves);
  if (!columns.allFinite()) return p;
  noise.Whiten(columns);
  p.span.emplace(std::move(columns));
  p.amplitudes = p.span->Solve(white_y);
  p.white_residual = white_y;
  p.span->Leave(p.white_residual);
  p.finite = p.amplitudes.allFinite();
  return p;
}

// Of the residual by the nonlinear parameters, with the amplitudes eliminated (Kaufman's).
Eigen::MatrixXd JacobianOf(const Projection& p, const Eigen::VectorXd& t,
                           const NoiseCorrelation& noise) {
  Eigen::MatrixXd jacobian = -WaveSlopes(t, p.terms, p.waves, p.amplitudes, Count(p.terms));
  noise.Whiten(jacobian);
  p.span->Leave(jacobian);
  return jacobian;
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
    MoveTo(x[0], duration);
    if (!last_.finite) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, t_.size()) = scale_ * last_.white_residual;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const Eigen::MatrixXd jacobian = JacobianOf(last_, t_, noise_);
    if (!jacobian.allFinite()) return false;
    // Ceres wants it row by row.
    Eigen::Map<Eigen::MatrixXd>(jacobians[0], jacobian.cols(), t_.size()) =
        (scale_ / duration * jacobian).transpose();
    return true;
  }

 private:
  // Ceres asks for the residual at a point first, and for the Jacobian where it takes the step.
  void MoveTo(const double* x, double duration) const {
    const std::vector<double> at(x, x + parameter_block_sizes()[0]);
    if (at == at_) return;
    at_ = at;
    std::vector<DampedTerm> terms = terms_;
    Unpack(x, duration, &terms);
    last_ = Project(t_, white_y_, terms, noise_);
  }

  const Eigen::VectorXd& t_;
  const Eigen::VectorXd& white_y_;
  const std::vector<DampedTerm>& terms_;
  const NoiseCorrelation& noise_;
  double scale_ = 1;
  mutable std::vector<double> at_;
  mutable Projection last_;
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
  const Eigen::Index n = columns.rows() - 1;
  const Eigen::ArrayXd c = correlation.tail(n);
  const Eigen::ArrayXd scale = (1 - c.square()).rsqrt();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const Eigen::ArrayXd before = columns.col(k).head(n);
    columns.col(k).tail(n).array() = scale * (columns.col(k).tail(n).array() - c * before);
  }
}

double NoiseCorrelation::LogDeterminant() const {
  return white() ? 0 : (1 - correlation.tail(correlation.size() - 1).array().square()).log().sum();
}

Eigen::MatrixXd TermColumns(const Eigen::VectorXd& t, const std::vector<DampedTerm>& terms) {
  return WaveColumns(t.size(), MakeWaves(t, terms));
}

Eigen::MatrixXd FitSlopes(const Eigen::VectorXd& t, const TermsFit& fit) {
  const std::vector<Wave> waves = MakeWaves(t, fit.terms);
  const Eigen::MatrixXd columns = WaveColumns(t.size(), waves);
  const int count = Count(fit.terms);
  Eigen::MatrixXd slopes(t.size(), columns.cols() + count);
  slopes << columns, WaveSlopes(t, fit.terms, waves, fit.amplitudes, count);
  return slopes;
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
    // Of a tall Jacobian, as its columns are in ColumnSpan.
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    // Steps end at the bounds as they are: a line search along each would double the evaluations.
    options.max_num_line_search_step_size_iterations = 0;
    options.max_num_iterations = kMostIterations;
    options.function_tolerance = 1e-10;
    options.parameter_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    usable = summary.IsSolutionUsable();
    Unpack(x.data(), duration, &fit.terms);
  }
  const Projection p = Project(t, white_y, fit.terms, noise);
  if (!usable || !p.finite) return fit;
  fit.amplitudes = p.amplitudes;
  fit.white_residual = p.white_residual;
  fit.sum_of_squares = p.white_residual.squaredNorm();
  fit.residual = y - WaveColumns(t.size(), p.waves) * p.amplitudes;
  fit.converged = true;
  if (!start.empty()) {
    // Scaled to a unit diagonal: frequencies and decay rates may differ by orders.
    const Eigen::MatrixXd jacobian = JacobianOf(p, t, noise);
    if (!jacobian.allFinite()) return TermsFit();
    const Eigen::MatrixXd hessian = jacobian.transpose() * jacobian;
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
