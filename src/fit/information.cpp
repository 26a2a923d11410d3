#include "cosserat_cable/fit/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// A parameter whose 95 % interval is wider than it is large is not determined by the data.
constexpr double kWidest = 1.0;
// Eigenvalue of the normalised information below which there is none.
constexpr double kNoInformation = 1e-12;
// Variance beside that in white noise, at least: an autocorrelation is cut where it has died to
// this.
constexpr double kLeastColour = 1e-3;

Eigen::MatrixXd Sub(const Eigen::MatrixXd& m, const std::vector<int>& which) {
  Eigen::MatrixXd sub(which.size(), which.size());
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::size_t k = 0; k < which.size(); ++k) sub(i, k) = m(which[i], which[k]);
  return sub;
}

/// Covariance over `which` alone, by eigenvectors of the information normalised to unit diagonal:
/// directions without information get a variance that is as good as infinite, and none gets a
/// negative one from rounding.
Eigen::MatrixXd SubCovariance(const Information& information, const std::vector<int>& which) {
  using Eigenvectors = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  const Eigen::MatrixXd expected = Sub(information.expected, which);
  const Eigen::VectorXd unit =
      expected.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? 1 / x : 0.0; });
  const Eigenvectors normal(unit.asDiagonal() * expected * unit.asDiagonal());
  // A square root of the covariance in white noise; and how the noise's colour changes it.
  const Eigen::MatrixXd root =
      unit.asDiagonal() * normal.eigenvectors() *
      normal.eigenvalues().cwiseMax(kNoInformation).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigenvectors colour(root.transpose() * Sub(information.scatter, which) * root);
  const Eigen::MatrixXd coloured =
      root * colour.eigenvectors() *
      colour.eigenvalues().cwiseMax(kLeastColour).cwiseSqrt().asDiagonal();
  return coloured * coloured.transpose();
}

/// What size of the unknown, in its scale, would be worth knowing: its own value; a damping may
/// also be small beside the others that damp the same motion.
double WorthKnowing(const Unknowns& unknowns, const Eigen::VectorXd& values,
                    const Eigen::MatrixXd& expected, int i) {
  const Unknown& u = unknowns.all()[i];
  const double own = std::abs(values[i]) / u.scale;
  if (!u.damping) return u.kind == Unknown::Kind::kCable ? own : 1.0;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(unknowns.size());
  for (int k = 0; k < unknowns.size(); ++k)
    if (unknowns.all()[k].damping) all[k] = values[k] / unknowns.all()[k].scale;
  // What of their joint effect this one alone could make.
  const double joint = expected(i, i) > 0 ? std::abs(expected.row(i).dot(all)) / expected(i, i) : 0;
  // Nothing is known of a number that is a hundredth of its interval; of none at all, its bound is.
  constexpr double kMost = 100;
  return own > 0 ? std::clamp(joint, own, kMost * own) : joint;
}

std::string WithUnit(const Unknown& u, double value) {
  return FormatRounded(value) + (u.unit.empty() ? "" : " " + u.unit);
}

/// The one length of all experiments that show both, or 0.
double CommonLength(const RecordModel& model, int i, int k, const Eigen::VectorXd& values) {
  const Unknowns& unknowns = model.unknowns();
  double length = 0;
  for (std::size_t e = 0; e < unknowns.set().experiments.size(); ++e) {
    if (!unknowns.Concerns(i, static_cast<int>(e)) || !unknowns.Concerns(k, static_cast<int>(e)))
      continue;
    Problems problems;
    const double L = unknowns.MakeSpecimen(static_cast<int>(e), values, &problems).cable.length;
    if (length > 0 && std::abs(L - length) > 1e-9 * length) return 0;
    length = L;
  }
  return length;
}

/// The sum of two unknowns that the data see: value and standard deviation.
Combination Combine(const RecordModel& model, const Eigen::VectorXd& values,
                    const Information& information, int i, int k) {
  const auto& all = model.unknowns().all();
  const Eigen::MatrixXd& expected = information.expected;
  // Along c_i x_i + c_k x_k, in the unknowns' own units; the second's factor is one.
  const double factor = expected(i, i) > 0 && expected(k, k) > 0
                            ? std::sqrt(expected(i, i) / expected(k, k)) * all[k].scale /
                                  all[i].scale * (expected(i, k) < 0 ? -1 : 1)
                            : 1.0;
  Combination combination;
  combination.unit = all[k].unit;
  combination.value = factor * values[i] + values[k];
  combination.sd = std::sqrt(information.scatter(k, k)) / expected(k, k) * all[k].scale;
  const double L = CommonLength(model, i, k, values);
  constexpr double kIsOneOverLength = 0.02;
  if (all[i].name == "eta_GJ" && all[k].name == kEndDamping && L > 0 &&
      std::abs(factor * L - 1) < kIsOneOverLength) {
    combination.text = "eta_GJ/L + D_E";
    combination.value = values[i] / L + values[k];
  } else {
    combination.text = FormatRounded(factor) + " " + all[i].name + " + " + all[k].name;
  }
  return combination;
}

}  // namespace

Information InformationOfRecord(const RecordModel& model, const RecordJacobian& jacobian,
                                const std::vector<std::vector<NoiseColour>>& colours,
                                int experiment) {
  const int unknowns = jacobian.unknowns();
  Information information{Eigen::MatrixXd::Zero(unknowns, unknowns),
                          Eigen::MatrixXd::Zero(unknowns, unknowns)};
  const auto e = static_cast<std::size_t>(experiment);
  const RecordJacobian::Record& record = jacobian.records()[e];
  const auto n = static_cast<int>(model.unknowns().set().experiments[e].record.t.size());
  int row = 0;
  for (const NoiseColour& colour : colours[e]) {
    const Eigen::MatrixXd block = record.columns.middleRows(row, n);
    Eigen::MatrixXd sum = block.transpose() * block;
    AddPart(sum, record.unknowns, &information.expected);
    for (int lag = 1; lag < std::min<int>(n, static_cast<int>(colour.autocorrelation.size()));
         ++lag) {
      const Eigen::MatrixXd product =
          block.topRows(n - lag).transpose() * block.bottomRows(n - lag);
      sum +=
          colour.autocorrelation[static_cast<std::size_t>(lag)] * (product + product.transpose());
    }
    AddPart(colour.sd * colour.sd * sum, record.unknowns, &information.scatter);
    row += n;
  }
  return information;
}

Information InformationOf(const RecordModel& model, const RecordJacobian& jacobian,
                          const std::vector<std::vector<NoiseColour>>& colours) {
  const auto experiments = static_cast<int>(model.unknowns().set().experiments.size());
  const Eigen::MatrixXd of_priors = jacobian.priors().cwiseAbs2().asDiagonal();
  Information information{of_priors, of_priors};
  for (int e = 0; e < experiments; ++e) {
    const Information record = InformationOfRecord(model, jacobian, colours, e);
    information.expected += record.expected;
    information.scatter += record.scatter;
  }
  return information;
}

Eigen::MatrixXd CovarianceOf(const Information& information, const std::vector<int>& which) {
  const auto n = information.expected.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  if (which.empty()) return covariance;
  const Eigen::MatrixXd sub = SubCovariance(information, which);
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::size_t k = 0; k < which.size(); ++k) covariance(which[i], which[k]) = sub(i, k);
  return covariance;
}

Determination Determine(const RecordModel& model, const Eigen::VectorXd& values,
                        const Information& information) {
  const Unknowns& unknowns = model.unknowns();
  Determination result;
  result.reasons.resize(unknowns.size());
  std::vector<int>& kept = result.determined;
  const auto drop = [&](int i, const std::string& why) {
    result.reasons[i] = why;
    kept.erase(std::find(kept.begin(), kept.end(), i));
  };
  for (int i = 0; i < unknowns.size(); ++i) kept.push_back(i);
  const auto worth = [&](int i) { return WorthKnowing(unknowns, values, information.expected, i); };

  // By itself, everything else known: does it show at all?
  for (const int i : std::vector<int>(kept)) {
    const double expected = information.expected(i, i);
    const double sd = expected > 0 ? std::sqrt(information.scatter(i, i)) / expected
                                   : std::numeric_limits<double>::infinity();
    if (!(kNormal95 * sd < kWidest * worth(i)) && unknowns.all()[i].kind == Unknown::Kind::kCable)
      drop(i,
           "[" + unknowns.all()[i].name + "] moves no record of this set by more than its noise");
  }

  // Together: the widest goes first, with those that it cannot be told from. What is dropped so
  // stays unknown beside the others: all but the one that the rest of its group can stand for.
  std::vector<int> hidden;
  const auto covariance_of_all = [&] {
    std::vector<int> all = kept;
    all.insert(all.end(), hidden.begin(), hidden.end());
    return CovarianceOf(information, all);
  };
  for (;;) {
    const Eigen::MatrixXd covariance = covariance_of_all();
    const auto width = [&](int i) {
      return kNormal95 * std::sqrt(covariance(i, i)) / (kWidest * worth(i));
    };
    int widest = -1;
    for (const int i : kept)
      if (unknowns.all()[i].kind == Unknown::Kind::kCable && !(width(i) < 1) &&
          (widest < 0 || width(i) > width(widest)))
        widest = i;
    if (widest < 0) {
      result.covariance = covariance;
      return result;
    }
    // How the others move along with it where the data do not see it.
    std::vector<int> together = {widest};
    for (const int k : kept) {
      if (k == widest || unknowns.all()[k].kind != Unknown::Kind::kCable) continue;
      const double along = std::abs(covariance(k, widest)) / std::sqrt(covariance(widest, widest));
      if (kNormal95 * along > kWidest * worth(k)) together.push_back(k);
    }
    std::sort(together.begin(), together.end());
    const auto name = [&](int k) { return "[" + unknowns.all()[k].name + "]"; };
    if (together.size() == 1) {
      const Unknown& u = unknowns.all()[widest];
      const double sd = std::sqrt(covariance(widest, widest)) * u.scale;
      drop(widest, "its 95 % interval is wider than its value: " + WithUnit(u, values[widest]) +
                       " +- " + WithUnit(u, kNormal95 * sd));
      hidden.push_back(widest);
      continue;
    }
    std::string sum_text;
    if (together.size() == 2) {
      const Combination sum = Combine(model, values, information, together[0], together[1]);
      result.combinations.push_back(sum);
      sum_text = ": " + sum.text + " = " + FormatRounded(sum.value) + " +- " +
                 FormatRounded(kNormal95 * sum.sd, 2) + " " + sum.unit + " (95 %)";
    }
    for (const int k : together) {
      std::string others;
      for (const int other : together)
        if (other != k) others += (others.empty() ? "" : ", ") + name(other);
      drop(k, "the data see " + name(k) + " only together with " + others + sum_text);
      if (k != widest) hidden.push_back(k);
    }
  }
}

}  // namespace cosserat_cable
