#include "record_scatter.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/information.h"

namespace cosserat_cable {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard normal deviate that chance exceeds in one of 500 cases.
constexpr double kByChance = 2.878;
// Eigenvalues, in parts of the largest, that are none.
constexpr double kNothing = 1e-9;
constexpr const char* kMayScatter[] = {"EI",      "EI1",     "EI2",    "GJ",       "eta_EI",
                                       "eta_EI1", "eta_EI2", "eta_GJ", kEndDamping};

/// Of one record: information on all unknowns, and derivative of half the sum of squares, at the
/// unknowns' means; both as if the noise were white.
struct RecordScore {
  MatrixXd information;
  VectorXd score;
};

/// Differences of one parameter between records, all that is common taken out, along directions in
/// which they are independent: each measured with variance 1/information.
struct Differences {
  VectorXd information, score;  // by direction; score has the variance of the information
};

MatrixXd PseudoInverse(const MatrixXd& symmetric) {
  const VectorXd unit = symmetric.diagonal().cwiseMax(0).cwiseSqrt().unaryExpr(
      [](double x) { return x > 0 ? 1 / x : 0.0; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(unit.asDiagonal() * symmetric *
                                                      unit.asDiagonal());
  const VectorXd inverse =
      eigen.eigenvalues().unaryExpr([](double x) { return x > kNothing ? 1 / x : 0.0; });
  return unit.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() *
         eigen.eigenvectors().transpose() * unit.asDiagonal();
}

class Scatter {
 public:
  Scatter(const RecordModel& model, const FitEnd& end) : unknowns_(model.unknowns()), end_(end) {
    for (int e = 0; e < Records(); ++e) {
      RecordScore record;
      record.information = InformationOfRecord(model, end.jacobian, end.colours, e).expected;
      record.score = ScoreOf(model, e);
      // Where the differences that the fit found are taken back.
      for (int i = 0; i < unknowns_.size(); ++i)
        if (IsScatter(i))
          record.score -= record.information.col(i) * (end.values[i] / unknowns_.all()[i].scale);
      widening_.push_back(Widening(model, e));
      records_.push_back(std::move(record));
    }
  }

  std::vector<ParameterScatter> Find() const {
    std::vector<ParameterScatter> found;
    // One more at a time: what one parameter's differences explain, others must not.
    std::optional<ParameterScatter> clearest;
    double clarity = kByChance;
    for (const char* name : kMayScatter) {
      const int of = unknowns_.Find(name);
      if (of < 0 || (std::string(name) == "eta_GJ" && unknowns_.Find(kEndDamping) >= 0)) continue;
      const std::vector<int> shown = ShownBy(of);
      if (shown.size() < 2) continue;
      const Differences differences = DifferencesOf(of, shown);
      const auto freedom = static_cast<int>(differences.score.size());
      if (freedom < 1) continue;
      const double sd = LikeliestSd(differences) * unknowns_.all()[of].scale;
      const ParameterScatter scatter{name, sd, static_cast<int>(shown.size()), freedom};
      if (!(sd > 0)) continue;
      if (Assumed(of)) {
        found.push_back(scatter);
      } else if (Clarity(differences) > clarity) {
        clarity = Clarity(differences);
        clearest = scatter;
      }
    }
    if (clearest) found.push_back(*clearest);
    return found;
  }

 private:
  int Records() const { return static_cast<int>(unknowns_.set().experiments.size()); }
  bool IsScatter(int i) const { return unknowns_.all()[i].kind == Unknown::Kind::kScatter; }
  bool Assumed(int of) const {
    for (int i = 0; i < unknowns_.size(); ++i)
      if (IsScatter(i) && unknowns_.all()[i].index == of) return true;
    return false;
  }
  std::vector<int> ShownBy(int of) const {
    std::vector<int> shown;
    for (int e = 0; e < Records(); ++e)
      if (records_[e].information(of, of) > 0) shown.push_back(e);
    return shown;
  }
  /// Derivative of half a record's sum of squares by all unknowns.
  VectorXd ScoreOf(const RecordModel& model, int e) const {
    const RecordJacobian::Record& record = end_.jacobian.records()[e];
    const VectorXd part = record.columns.transpose() *
                          end_.residuals.segment(FirstRow(model, e), record.columns.rows());
    VectorXd score = VectorXd::Zero(unknowns_.size());
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      score[record.unknowns[k]] = part[static_cast<Eigen::Index>(k)];
    return score;
  }
  /// By unknown, how much the noise's colour widens its variance.
  VectorXd Widening(const RecordModel& model, int e) const {
    const Information information = InformationOfRecord(model, end_.jacobian, end_.colours, e);
    VectorXd widening = VectorXd::Ones(unknowns_.size());
    for (int i = 0; i < unknowns_.size(); ++i)
      if (information.expected(i, i) > 0)
        widening[i] = std::max(1.0, information.scatter(i, i) / information.expected(i, i));
    return widening;
  }

  Differences DifferencesOf(int of, const std::vector<int>& shown) const {
    // Common: all unknowns but the differences of this parameter.
    std::vector<int> common;
    for (int i = 0; i < unknowns_.size(); ++i)
      if (!IsScatter(i) || unknowns_.all()[i].index != of) common.push_back(i);
    const auto n = static_cast<Eigen::Index>(common.size());
    const auto m = static_cast<Eigen::Index>(shown.size());
    MatrixXd cc = MatrixXd::Zero(n, n), cb = MatrixXd::Zero(n, m);
    VectorXd gc = VectorXd::Zero(n), bb = VectorXd::Zero(m), gb = VectorXd::Zero(m);
    for (int e = 0; e < Records(); ++e) {
      const double by = 1 / widening_[e][of];
      for (Eigen::Index i = 0; i < n; ++i) {
        gc[i] += by * records_[e].score[common[i]];
        for (Eigen::Index k = 0; k < n; ++k)
          cc(i, k) += by * records_[e].information(common[i], common[k]);
      }
    }
    const VectorXd& priors = end_.jacobian.priors();
    for (Eigen::Index i = 0; i < n; ++i) {
      const int one = common[i];
      const Unknown& u = unknowns_.all()[one];
      cc(i, i) += priors[one] * priors[one];
      if (!IsScatter(one) && u.prior_sd > 0)
        gc[i] += priors[one] * (u.start - end_.values[one]) / u.prior_sd;
    }
    for (Eigen::Index b = 0; b < m; ++b) {
      const RecordScore& record = records_[shown[b]];
      const double by = 1 / widening_[shown[b]][of];
      for (Eigen::Index i = 0; i < n; ++i) cb(i, b) = by * record.information(common[i], of);
      bb[b] = by * record.information(of, of);
      gb[b] = by * record.score[of];
    }
    const MatrixXd solve = PseudoInverse(cc);
    const MatrixXd information = MatrixXd(bb.asDiagonal()) - cb.transpose() * solve * cb;
    const VectorXd score = gb - cb.transpose() * solve * gc;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information);
    Differences differences;
    const Eigen::Index none =
        (eigen.eigenvalues().array() <= 1e-6 * bb.maxCoeff()).cast<int>().sum();
    differences.information = eigen.eigenvalues().tail(m - none);
    differences.score = (eigen.eigenvectors().transpose() * score).tail(m - none);
    return differences;
  }

  /// The standard normal deviate that is as rare as the differences' chi-square: by Wilson and
  /// Hilferty's cube root.
  static double Clarity(const Differences& differences) {
    const double chi_square =
        (differences.score.array().square() / differences.information.array()).sum();
    const auto freedom = static_cast<double>(differences.score.size());
    const double width = 2 / (9 * freedom);
    return (std::cbrt(chi_square / freedom) - (1 - width)) / std::sqrt(width);
  }

  /// In units of the scale. By golden section over its logarithm, between what is far below and far
  /// above what the differences show.
  static double LikeliestSd(const Differences& differences) {
    const auto deviance = [&](double log_sd) {
      const double variance = std::exp(2 * log_sd);
      double sum = 0;
      for (Eigen::Index k = 0; k < differences.score.size(); ++k) {
        const double information = differences.information[k];
        const double excess = 1 + variance * information;
        sum += std::log(excess) + std::pow(differences.score[k], 2) / information / excess;
      }
      return sum;
    };
    double low = -0.5 * std::log(differences.information.maxCoeff()) - 5, high = 0;
    for (Eigen::Index k = 0; k < differences.score.size(); ++k)
      high = std::max(high, std::abs(differences.score[k]) / differences.information[k]);
    high = std::log(std::max(high, 1e-300)) + 2;
    const double nothing = deviance(low);
    const double golden = (std::sqrt(5.0) - 1) / 2;
    while (high - low > 1e-3) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      (deviance(a) < deviance(b) ? high : low) = deviance(a) < deviance(b) ? b : a;
    }
    const double best = (low + high) / 2;
    return deviance(best) < nothing ? std::exp(best) : 0.0;
  }

  const Unknowns& unknowns_;
  const FitEnd& end_;
  std::vector<RecordScore> records_;
  std::vector<VectorXd> widening_;
};

}  // namespace

std::vector<ParameterScatter> FindScatter(const RecordModel& model, const FitEnd& end) {
  return Scatter(model, end).Find();
}

}  // namespace cosserat_cable
