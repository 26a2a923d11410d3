// Cable P2 of the source paper (a 200 mm arch between parallel clamps 100 mm apart), whose clamps
// are swept from 10 to 38 Hz in 7 s, in its plane: what the costs are measured on.
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "cosserat_cable/rod/rod_batch.h"
#include "swept_arch.h"

namespace cosserat_cable::bench {

inline constexpr double kDt = 1e-3;  // s

inline rod::RodModel CableP2(int elements) {
  constexpr double kEI = 0.008, kRhoA = 0.15, kEtaEI = 1e-4;
  return rod::RoundCable(0.2, 0.008, kRhoA, kEI, 0.75 * kEI, kEtaEI, kEtaEI / 2, elements);
}

/// Poses of both clamps over the sweep, again from its start after its end: what they cost is not
/// the rod's.
class Drive {
 public:
  Drive() {
    for (int k = 1; k * kDt < SweptArch::kDuration; ++k) {
      a_.push_back(SweptArch::ClampA(SweptArch::Shift(k * kDt)));
      b_.push_back(SweptArch::ClampB(SweptArch::Shift(k * kDt)));
    }
  }
  void Advance() { k_ = (k_ + 1) % a_.size(); }
  const Pose& a() const { return a_[k_]; }
  const Pose& b() const { return b_[k_]; }

 private:
  std::vector<Pose> a_, b_;
  std::size_t k_ = 0;
};

/// Any number of cables, stepped side by side in as many batches as it takes; one that is left over
/// is stepped by itself.
class Fleet {
 public:
  Fleet(int cables, int elements) {
    const int kMost = rod::RodBatch::PreferredRods();
    const rod::Rod rod = Settled(CableP2(elements));
    rods_.reserve(cables);
    for (int i = 0; i < cables; ++i) rods_.push_back(rod);
    batched_ = cables % kMost == 1 ? cables - 1 : cables;
    for (int first = 0; first < batched_; first += kMost) {
      std::vector<rod::Rod*> some;
      for (int i = first; i < batched_ && i < first + kMost; ++i) some.push_back(&rods_[i]);
      sizes_.push_back(some.size());
      batches_.emplace_back(some);
    }
  }

  /// Newton iterations, of all cables. @throws std::runtime_error where a step does not converge
  int Step(const Drive& drive) {
    int iterations = 0;
    const auto add = [&](const rod::SolveReport& report) {
      if (!report.converged) throw std::runtime_error("a step did not converge");
      iterations += report.iterations;
    };
    for (std::size_t i = 0; i < batches_.size(); ++i) {
      drives_.assign(sizes_[i], {&drive.a(), &drive.b(), nullptr});
      for (const rod::SolveReport& report : batches_[i].Step(kDt, drives_)) add(report);
    }
    for (std::size_t i = batched_; i < rods_.size(); ++i)
      add(rods_[i].Step(kDt, drive.a(), drive.b()));
    return iterations;
  }

 private:
  std::vector<rod::Rod> rods_;
  int batched_;  // so many of them
  std::vector<std::size_t> sizes_;
  std::vector<rod::RodBatch> batches_;
  std::vector<rod::RodDrive> drives_;
};

}  // namespace cosserat_cable::bench
