// The stages of a diagnosis, and what each leaves to the next.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cosserat_cable/diagnosis/diagnosis.h"
#include "fit_memory.h"
#include "goodness.h"
#include "screening.h"
#include "trial.h"
#include "verdict.h"

namespace cosserat_cable {

/// A model with one cause or several, fitted.
struct FittedTrial {
  std::vector<Trial> trials;
  MeasurementSet set;
  std::unique_ptr<FitProblem> problem;
  FitPoint point;
  bool refined = false;  ///< simulated as finely as what it leaves asks
  bool held = false;     ///< what concerns single records stays where the simpler model has it

  std::vector<std::string> causes() const;
  int parameters() const;
  /// Whether so much is left that how each record began hardly counts.
  bool IsFar() const;
  /// Of the unknowns that concern one record each, those that stay where they are in fits that
  /// begin here: none, or all where so much is left that they hardly count and they are many.
  std::vector<std::string> Held() const;
  /// Whether one of its causes is far smaller than such a fault can be.
  bool IsFaint() const;
};

class DiagnosisWork {
 public:
  DiagnosisWork(const MeasurementSet& set, const DiagnosisOptions& options);
  DiagnosisWork(const DiagnosisWork&) = delete;

  /// Mistakes of the set go to `problems`. False: there is no baseline, and `message` says why.
  bool FitBaseline(Problems* problems);
  /// Orders the hypotheses by what they promise, beside the model at `base`.
  std::vector<Screened> ScreenAround(const FittedTrial& base, const std::string& stage);
  /// Fits the most promising causes, one at a time, together with those of the model `beside`.
  void FitCandidates(const std::vector<Screened>& screened, int beside, int most, double part);
  /// Fits the two causes together that promise most, where no single one promises nearly as much.
  void FitPromisingPairs(const std::vector<Screened>& screened, double part);
  void Continue(double part);
  /// Fits causes that contain a simpler one from where that one was found.
  void FitFromSimpler();
  /// Fits what the best model is made of by itself, or the simpler causes that it contains, from
  /// where it ended.
  void FitParts();
  /// Of an answer of several causes: fits what else promises nearly as much in the place of each.
  void FitRivalsOfParts(int most, double part);
  /// The steps of the best models made as fine as what is left there asks, and they are fitted
  /// again.
  void RefineBest();
  /// The answer so far, fitted to its end and with steps as fine as what it leaves asks.
  void FinishAnswer();
  /// Whether a model leaves so little beyond the noise that nothing can be missing from it.
  bool LeavesNothing(int model) const;
  /// The verdict on what has been fitted so far.
  Judgement Judged() const;
  Diagnosis Report();

  const FittedTrial& baseline() const { return *models_.front(); }
  int count() const { return static_cast<int>(models_.size()); }
  /// The part of the plain model's misfit that the best of the others explains.
  double ShareOfBest() const;
  const FittedTrial& model(int i) const { return *models_[static_cast<std::size_t>(i)]; }
  bool Stopping() const;
  /// For fits; what follows them has the rest of the time.
  bool OutOfTime() const { return Seconds() > kFits * options_.time_budget; }
  Difference DifferenceBetween(int worse, int better) const;
  const std::string& message() const { return diagnosis_.message; }
  Diagnosis Failed();

 private:
  static constexpr double kFits = 0.85;
  // A promise, in noise variances, that chance makes among all hypotheses.
  static constexpr double kChance = 10;
  // The part of the misfit that is nearly all of it.
  static constexpr double kNearlyAll = 0.9;
  using Clock = std::chrono::steady_clock;
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  bool Tell(const std::string& what, double part);
  void Charge(const std::string& stage, const SimulationCount& count = {});
  FitProblemOptions ProblemOptions() const;
  double Aim() const;
  using Also = std::map<std::string, double>;
  /// From where a simpler model stands; `also`: unknowns that begin elsewhere.
  std::unique_ptr<FittedTrial> FitOne(const std::vector<Trial>& trials, const FittedTrial& from,
                                      const Also& also = {});
  void LookAroundTheBestObstacle(const FittedTrial& base, std::vector<Screened>* screened) const;
  void FitObstacleInTurns(const FittedTrial& from, std::unique_ptr<FittedTrial>* fitted);
  std::unique_ptr<FittedTrial> FitOneOrFromTheSet(const std::vector<Trial>& trials,
                                                  const FittedTrial& from);
  /// The better one of this and of what there is with its causes. @return whether it is this
  bool Keep(std::unique_ptr<FittedTrial> model);
  double ShareOf(const FittedTrial& model) const;
  bool HasEnded(const FittedTrial& model) const;
  void GoOn(FittedTrial* model);
  void Finish(FittedTrial* model);
  void RefineOne(FittedTrial* model);
  bool IsExplained() const;
  bool IsExplained(const std::string& name, const FittedTrial& beside) const;
  double SdOfForm(const FittedTrial& model, const std::string& name, double value) const;
  std::map<std::string, FoundParameter> FoundIn(const FittedTrial& model) const;
  void LookAtTheBest();
  Records HeldOut(const FittedTrial& of) const;
  MeasurementSet Filled(const FittedTrial& of) const;
  void ReportCandidates(const Judgement& judgement);
  void ReportGain(const Judgement& judgement);
  void ReportRecords(const Judgement& judgement);
  void Advise(const Judgement& judgement);
  void Say(const Judgement& judgement);

  const MeasurementSet& whole_;
  const MeasurementSet set_;  // what is fitted of it
  const DiagnosisOptions& options_;
  FitMemory memory_;
  SetNoise noise_;       // that fits weigh by
  SetNoise seen_noise_;  // that what is left is judged by
  MotionScales scales_;
  std::vector<std::shared_ptr<FittedTrial>> models_;  // the first is the plain one
  std::map<std::string, double> promises_;            // by cause, in noise variances
  std::map<std::string, double> sizes_;               // of components that show faintly
  std::set<std::string> tried_;                       // causes that were fitted alone
  std::set<std::string> begun_from_simpler_;          // and from a simpler one
  std::map<std::string, std::string> failures_;       // by cause, why it could not be fitted
  Correlations correlations_;
  Records plain_heldout_;  // what the plain model leaves of records that its fit had not seen
  Diagnosis diagnosis_;
  std::atomic<bool> stopped_{false};
  double farthest_ = 0;
  Clock::time_point begin_ = Clock::now(), charged_at_ = begin_;
};

}  // namespace cosserat_cable
