// Levenberg and Marquardt's method for residuals that are dear to find, several at a time for
// little more than one: a step is tried together with the derivatives where it leads, and with more
// careful steps beside it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace cosserat_cable {

/// Half a sum of squares of residuals r(x), x in [lower, upper].
class LeastSquaresProblem {
 public:
  virtual ~LeastSquaresProblem() = default;

  struct Linearisation {
    bool ok = false;           ///< false: r or its derivatives cannot be found at x
    bool whole = true;         ///< false: some derivatives are from another x, near by
    bool kept = false;         ///< all of them are
    double cost = 0;           ///< r^T r / 2
    Eigen::MatrixXd gram;      ///< J^T J
    Eigen::VectorXd gradient;  ///< J^T r
  };
  /// Which derivatives are found anew; the others are kept, corrected by what steps have shown.
  enum class Renew {
    kNone,  ///< but for those that are not known yet
    kSome,  ///< those that change most on the way
    kAll
  };
  /// At x; `costs` become those of `others`, infinite where there is none.
  virtual Linearisation Linearise(const Eigen::VectorXd& x,
                                  const std::vector<Eigen::VectorXd>& others, Renew renew,
                                  std::vector<double>* costs) = 0;
  /// The costs at several points, infinite where there is none.
  virtual std::vector<double> Costs(const std::vector<Eigen::VectorXd>& points) = 0;
  /// How many points cost about as much as one; and how many others a linearisation has room for.
  virtual int SideBySide() const = 0;
  virtual int Room() const = 0;
  /// False ends the search where it is.
  virtual bool GoOn(int iteration, double cost) = 0;
  /// Bounds what a step from `x` to `*next` may change, besides the box.
  virtual void Restrain(const Eigen::VectorXd& x, Eigen::VectorXd* next) const = 0;
};

struct LeastSquaresOptions {
  Eigen::VectorXd lower, upper;
  std::vector<bool> held;  ///< by unknown: stays where it is
  int max_iterations = 40;
  /// The end: no more than this can be gained by Gauss and Newton's step, in cost by the noise's
  /// variance. What the noise is taken for is the larger of 1 and the mean square of the residuals,
  /// `samples` of them.
  double small_gain = 1e-3;
  double samples = 1;
  /// A cost to be reached; zero: none. Where the linear model promises for long only a small part
  /// of what is missing, the search ends.
  double aim = 0;
  /// Which derivatives are found anew on the way; at the minimum, all of them.
  LeastSquaresProblem::Renew renew = LeastSquaresProblem::Renew::kAll;
  /// False: a minimum by kept derivatives will do.
  bool finish = true;
};

/// By unknown, twice what a step costs in which it moves by one: so much that a move by its own
/// size, one at least, costs half of the variance of what is left. Unknowns that the residuals
/// hardly show stay where they are until the others are found. Their diagonal entry of J^T J alone
/// would let them drift far for next to nothing, and a valley that runs along them has no end
/// (Transtrum, Machta and Sethna 2011, Phys. Rev. E 83, 036701: "evaporation").
Eigen::VectorXd Ties(const Eigen::VectorXd& x, double variance);

struct LeastSquaresResult {
  enum class End {
    kMinimum,  ///< less than small_gain can be gained
    kStuck,    ///< no damping gains anything, though more should be gained: the residuals are too
               ///< rough
    kIterations,  ///< max_iterations were not enough
    kFar,         ///< the aim is out of reach
    kStopped,     ///< by GoOn
    kFailed       ///< the first linearisation failed
  };
  End end = End::kFailed;
  Eigen::VectorXd x;
  double cost = 0;
  double gain_left = 0;  ///< by Gauss and Newton's step, in units of small_gain's noise
  int iterations = 0;
};

LeastSquaresResult Minimise(const Eigen::VectorXd& start, const LeastSquaresOptions& options,
                            LeastSquaresProblem* problem);

}  // namespace cosserat_cable
