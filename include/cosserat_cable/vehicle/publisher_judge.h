// Whether several publishers say different things about one edge of the tree.
#pragma once

#include <cstdint>
#include <vector>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// Publishers are numbers here. One alone costs next to nothing.
class PublisherJudge {
 public:
  struct Conflict {
    std::uint64_t count = 0;               ///< samples that differ from another publisher's
    std::int64_t first = 0, worst = 0;     ///< stamps [ns]
    double translation = 0, rotation = 0;  ///< of the worst one [m], [rad]
    int one = 0, other = 0;                ///< who said it
  };

  /// A sample of this edge, in whichever order.
  void Add(int publisher, std::int64_t stamp, const Pose& X_PC);
  /// Time starts anew; what was found stays.
  void Restart() { publishers_.clear(); }

  const Conflict& conflict() const { return conflict_; }

 private:
  struct Publisher {
    int number = 0;
    std::int64_t stamp = 0;     // of the last sample [ns]
    std::int64_t interval = 0;  // between the last two; 0: there is but one
    Pose X;
    double step = 0, turn = 0;  // between the last two
  };

  void Compare(const Publisher& known, int publisher, std::int64_t stamp, const Pose& X_PC);

  std::vector<Publisher> publishers_;
  Conflict conflict_;
};

}  // namespace cosserat_cable
