#include "cosserat_cable/identification/ring_down.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "cosserat_cable/input/number_text.h"
#include "damped_terms.h"
#include "record_faults.h"
#include "record_noise.h"

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Eigen::Index kFewestSamples = 16;
constexpr std::size_t kMostTerms = 10;
// Of the information criterion (BIC), for one more term: odds of 150 to 1.
constexpr double kDecisive = 10;
// Of the criterion, by which a first fit may be worse than the best so far: turns of fit and
// correlation bring less.
constexpr double kLost = 30;
// Share of what the criterion asks for that a term's start must bring to be tried.
constexpr double kWorthTrying = 0.4;
// Decay rates and creep rates to start from, times the record's duration.
constexpr double kDecays[] = {0, 1, 3, 8, 20, 60};
constexpr double kCreeps[] = {0.3, 1, 3, 10, 30, 100};
// Offsets from a periodogram's peak to start from, in its steps.
constexpr double kBeside[] = {-1, -0.5, 0, 0.5, 1};
// Frequencies on either side of a mode's whose residual says how much noise there is at it.
constexpr Eigen::Index kFewestBeside = 8;
// Standard deviations beyond which a decay rate's sign is certain.
constexpr double kCertain = 3;
// The residual's power near a mode is noisy itself: 16 frequencies and more, of which as many as
// this share above the mean are chance in one of 100.
constexpr double kChanceOfPower = 2.33;

// Terms with their noise, and what the information criterion says of them.
struct Candidate {
  TermsFit fit;
  CorrelationFit noise;
  double criterion = std::numeric_limits<double>::infinity();
};

// How many numbers the fit adjusts, amplitudes and offset included.
int Parameters(const std::vector<DampedTerm>& terms) {
  return std::accumulate(terms.begin(), terms.end(), 1, [](int sum, const DampedTerm& term) {
    return sum + term.linear() + term.nonlinear();
  });
}

class Growth {
 public:
  Growth(const Eigen::VectorXd& t, const Eigen::VectorXd& y) : t_(t), y_(y) {
    for (const double decay : kDecays) decays_.push_back((-decay / duration() * t.array()).exp());
    best_ = Fit({}, CorrelationFit());
    while (best_.fit.terms.size() < kMostTerms && Grow()) {
    }
    Refine();
  }

  const Candidate& best() const { return best_; }

 private:
  double duration() const { return t_[t_.size() - 1]; }

  // Terms and the noise's correlation, in turns: either changes the other a little.
  Candidate Fit(const std::vector<DampedTerm>& start, const CorrelationFit& noise) const {
    Candidate c;
    c.noise = noise;
    const double n = static_cast<double>(t_.size());
    c.fit = FitTerms(t_, y_, start, c.noise.noise);
    for (int turn = 0; turn < 3 && c.fit.converged; ++turn) {
      const double before = c.noise.time;
      c.noise = FitCorrelation(t_, c.fit.residual);
      if (c.noise.deviance + (Parameters(start) + c.noise.parameters) * std::log(n) >
          best_.criterion + kLost) {
        return c;
      }
      if (c.noise.time == 0 && before == 0) break;
      c.fit = FitTerms(t_, y_, c.fit.terms, c.noise.noise);
      if (std::abs(c.noise.time - before) < 0.02 * c.noise.time) break;
    }
    const double parameters = Parameters(start) + c.noise.parameters;
    if (c.fit.converged && parameters + 2 < n) {
      c.criterion = n * std::log(std::max(c.fit.sum_of_squares / n, 1e-300)) +
                    c.noise.noise.LogDeterminant() + parameters * std::log(n);
    }
    return c;
  }

  Eigen::VectorXd White(const NoiseCorrelation& noise) const {
    Eigen::VectorXd residual = best_.fit.residual;
    noise.Whiten(residual);
    return residual;
  }

  // How much of the white residual's sum of squares a term with these columns takes away.
  static double Gain(Eigen::MatrixXd columns, const NoiseCorrelation& noise,
                     const Eigen::VectorXd& residual) {
    noise.Whiten(columns);
    // Normal equations do for a start; the ridge keeps a column of zeros from dividing by zero.
    Eigen::MatrixXd normal = columns.transpose() * columns;
    normal.diagonal() *= 1 + 1e-9;
    const Eigen::VectorXd right = columns.transpose() * residual;
    const double gain = right.dot(normal.ldlt().solve(right));
    return std::isfinite(gain) ? gain : 0;
  }

  DampedTerm StartNear(double omega, double step, const NoiseCorrelation& noise) const {
    const Eigen::VectorXd residual = White(noise);
    DampedTerm best;
    double most = -1;
    Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(t_.size(), 3);
    for (const double beside : kBeside) {
      DampedTerm term;
      term.omega = std::max(omega + beside * step, 0.25 * step);
      const Eigen::ArrayXd phase = term.omega * t_.array();
      const Eigen::ArrayXd cosine = phase.cos(), sine = phase.sin();
      for (std::size_t k = 0; k < decays_.size(); ++k) {
        term.delta = kDecays[k] / duration();
        if (term.delta > 2 * term.omega) continue;
        columns.col(1) = decays_[k] * cosine;
        columns.col(2) = decays_[k] * sine;
        const double gain = Gain(columns, noise, residual);
        if (gain > most) {
          most = gain;
          best = term;
        }
      }
    }
    return best;
  }

  DampedTerm StartCreep(const NoiseCorrelation& noise) const {
    const Eigen::VectorXd residual = White(noise);
    DampedTerm best;
    double most = -1;
    for (const double rate : kCreeps) {
      DampedTerm term;
      term.oscillates = false;
      term.delta = rate / duration();
      const double gain = Gain(TermColumns(t_, {term}), noise, residual);
      if (gain > most) {
        most = gain;
        best = term;
      }
    }
    return best;
  }

  // Where the start takes nowhere near enough away, no search from it would.
  bool IsHopeless(const DampedTerm& term, const NoiseCorrelation& noise) const {
    const Eigen::VectorXd residual = White(noise);
    const double n = static_cast<double>(t_.size());
    const double needed = kDecisive + (term.linear() + term.nonlinear()) * std::log(n);
    return Gain(TermColumns(t_, {term}), noise, residual) * n <
           kWorthTrying * needed * residual.squaredNorm();
  }

  void Try(std::vector<DampedTerm> terms, const DampedTerm& added, const CorrelationFit& noise,
           Candidate* winner) const {
    if (IsHopeless(added, noise.noise)) return;
    terms.push_back(added);
    Candidate candidate = Fit(terms, noise);
    if (candidate.criterion < winner->criterion) *winner = std::move(candidate);
  }

  // A frequency that moves with the amplitude leaves power beside itself, as a second mode does.
  void TryShift(double omega, const CorrelationFit& noise, Candidate* winner) const {
    for (std::size_t k = 0; k < best_.fit.terms.size(); ++k) {
      const DampedTerm& term = best_.fit.terms[k];
      const double width = 3 * term.delta + 4 * kPi / duration();
      if (!term.oscillates || term.shifts || std::abs(term.omega - omega) > width) continue;
      std::vector<DampedTerm> terms = best_.fit.terms;
      terms[k].shifts = true;
      Candidate candidate = Fit(terms, noise);
      if (candidate.criterion < winner->criterion) *winner = std::move(candidate);
    }
  }

  void TryNear(const Peak& peak, const CorrelationFit& noise, Candidate* winner) const {
    Try(best_.fit.terms, StartNear(peak.omega, peak.step, noise.noise), noise, winner);
    Try(best_.fit.terms, StartCreep(noise.noise), noise, winner);
    TryShift(peak.omega, noise, winner);
  }

  bool Grow() {
    const Peak white = HighestPeak(t_, best_.fit.white_residual);
    const bool is_white = best_.noise.noise.white();
    // Correlated noise may be a slow term that is not found yet: only trying tells.
    if (is_white && !best_.fit.terms.empty() && !white.significant) return false;
    Candidate winner;
    TryNear(white, best_.noise, &winner);
    if (!is_white) {
      // Noise that is nearly a random walk takes slow terms for its own, and cannot leave that
      // again: what is added to it starts from white noise as well.
      TryNear(HighestPeak(t_, best_.fit.residual), CorrelationFit(), &winner);
    }
    if (!(winner.criterion < best_.criterion - kDecisive)) return false;
    best_ = std::move(winner);
    return true;
  }

  // The fit takes part of slow noise for signal: its correlation anew, with that counted.
  void Refine() {
    if (best_.noise.noise.white() || !best_.fit.converged) return;
    const CorrelationFit noise = FitCorrelation(t_, best_.fit.residual, FitSlopes(t_, best_.fit));
    const TermsFit fit = FitTerms(t_, y_, best_.fit.terms, noise.noise);
    if (!fit.converged) return;
    best_.fit = fit;
    best_.noise = noise;
  }

  const Eigen::VectorXd& t_;
  const Eigen::VectorXd& y_;
  std::vector<Eigen::ArrayXd> decays_;  // exp(-decay t), by kDecays
  Candidate best_;
};

// The noise's power at a mode's frequency over that of the white noise which the fit's covariance
// assumes: 1, or more where the residual has more there than chance gives.
double PowerAt(const RingDownMode& mode, const Periodogram& residual) {
  const double steps = 2 * mode.delta / residual.step;
  const Eigen::Index size = residual.power.size();
  const Eigen::Index half = std::min(
      size / 4, std::max(2 * kFewestBeside, static_cast<Eigen::Index>(std::max(steps, 0.0))));
  const Eigen::Index middle = static_cast<Eigen::Index>(mode.omega / residual.step);
  const Eigen::Index from = std::clamp<Eigen::Index>(middle - half, 0, size - 1);
  const Eigen::Index to = std::clamp<Eigen::Index>(middle + half, from + 1, size);
  const double count = static_cast<double>(to - from) / 2;  // independent ones
  const double power = residual.power.segment(from, to - from).mean();
  return power > 1 + kChanceOfPower / std::sqrt(count) ? power : 1;
}

// Fills modes, creep and offset.
void Collect(const Eigen::VectorXd& t, const TermsFit& fit, double variance,
             const Periodogram& residual, RingDownFit* result) {
  const Eigen::MatrixXd columns = TermColumns(t, fit.terms);
  result->offset = fit.amplitudes[0];
  int linear = 1, nonlinear = 0;
  for (const DampedTerm& term : fit.terms) {
    if (term.oscillates) {
      RingDownMode mode;
      mode.omega = term.omega;
      mode.delta = term.delta;
      mode.cosine = fit.amplitudes[linear];
      mode.sine = fit.amplitudes[linear + 1];
      mode.strength = std::sqrt(
          (columns.middleCols(linear, 2) * fit.amplitudes.segment(linear, 2)).squaredNorm() /
          static_cast<double>(t.size()));
      mode.shifts = term.shifts;
      if (term.shifts) mode.amplitude_shift = term.shift / term.omega;
      mode.covariance = PowerAt(mode, residual) * variance *
                        fit.inverse_hessian.block<2, 2>(nonlinear, nonlinear);
      result->modes.push_back(mode);
    } else {
      result->creep.push_back({term.delta, fit.amplitudes[linear]});
    }
    linear += term.linear();
    nonlinear += term.nonlinear();
  }
  std::stable_sort(
      result->modes.begin(), result->modes.end(),
      [](const RingDownMode& a, const RingDownMode& b) { return a.strength > b.strength; });
}

std::string WhyRefused(const std::vector<RingDownMode>& modes, double duration) {
  if (modes.empty()) return "no oscillation rises above the noise";
  const RingDownMode& mode = modes.front();
  const double period = 2 * kPi / mode.omega;
  if (period > duration) {
    return "record of " + FormatRounded(duration) + " s is shorter than a period" +
           (period < 3 * duration ? " (" + FormatRounded(period) + " s)" : "");
  }
  if (mode.delta < -kCertain * std::sqrt(mode.covariance(1, 1))) {
    return "the oscillation grows, at " + FormatRounded(-mode.delta) + " 1/s: it is no ring-down";
  }
  return "";
}

void AddMessages(const RingDownFit& fit, double nyquist, std::vector<std::string>* messages) {
  const RingDownMode& mode = fit.modes.front();
  const double delta_sd = std::sqrt(mode.covariance(1, 1));
  if (mode.delta < 2 * delta_sd) {
    messages->push_back("the decay rate is not above zero by more than its noise: " +
                        FormatRounded(mode.delta) + " +- " + FormatRounded(delta_sd) + " 1/s");
  }
  if (mode.omega > 0.8 * nyquist) {
    messages->push_back(
        "fewer than 2.5 samples a period: the frequency may be the alias of a higher one");
  }
  if (mode.shifts) {
    messages->push_back("the frequency moves with the amplitude: at the first sample it is " +
                        FormatRounded(100 * mode.amplitude_shift) +
                        " % above that of small amplitudes, which is reported");
  }
  if (!fit.residual_is_noise) {
    messages->push_back(
        "the residual is not noise alone: its highest peak has " +
        FormatRounded(fit.residual_peak) +
        " times the power of noise; the standard deviations count what of it is near the mode");
  }
}

}  // namespace

double RingDownMode::amplitude() const { return std::hypot(cosine, sine); }

RingDownFit FitRingDown(const std::vector<double>& t, const Eigen::VectorXd& y,
                        std::optional<double> sigma) {
  RingDownFit result;
  Eigen::VectorXd times =
      Eigen::Map<const Eigen::VectorXd>(t.data(), static_cast<Eigen::Index>(t.size()));
  if (times.size() != y.size() || times.size() < kFewestSamples) {
    result.refused = "has " + std::to_string(std::min(times.size(), y.size())) +
                     " samples, expected at least " + std::to_string(kFewestSamples);
    return result;
  }
  result.refused = FaultOf(times, y);
  if (!result.refused.empty()) return result;
  times.array() -= t.front();
  const double duration = times[times.size() - 1];
  // About its mean: what an offset takes of a number's digits is not noise.
  const double mean = y.mean();
  const Growth growth(times, y.array() - mean);
  const Candidate& best = growth.best();
  if (!best.fit.converged) {
    result.refused = "no fit converged";
    return result;
  }
  const double n = static_cast<double>(times.size());
  const double free = n - Parameters(best.fit.terms) - best.noise.parameters;
  result.sigma = std::sqrt(best.fit.sum_of_squares / free);
  const Periodogram residual = MakePeriodogram(times, best.fit.white_residual);
  const double used = std::max(result.sigma, sigma.value_or(0));
  Collect(times, best.fit, used * used, residual, &result);
  const std::string refused = WhyRefused(result.modes, duration);
  if (!refused.empty()) {
    result = RingDownFit();
    result.refused = refused;
    return result;
  }
  result.offset += mean;
  result.correlation_time = best.noise.time;
  const Peak peak = HighestPeak(times, best.fit.white_residual);
  result.residual_peak = peak.power;
  result.residual_is_noise = !peak.significant;
  result.fit = y - best.fit.residual;
  AddMessages(result, kPi * (n - 1) / duration, &result.messages);
  return result;
}

}  // namespace cosserat_cable
