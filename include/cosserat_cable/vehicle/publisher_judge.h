// Whether several publishers say different things about one edge of the tree, also where they have
// one name, or the recording tells none.
#pragma once

#include <array>
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

  /// A sample of this edge. One that is no later than the publisher's last is left out.
  void Add(int publisher, std::int64_t stamp, const Pose& X_PC);
  /// Time starts anew; what was found stays.
  void Restart() { publishers_.clear(); }

  const Conflict& conflict() const { return conflict_; }
  /// Of one publisher whose samples go to and fro between two courses: `count` and how far these
  /// are apart at most. A motion that is real does not do so with each sample.
  const Conflict& two_courses() const { return two_courses_; }

 private:
  struct Sample {
    std::int64_t stamp = 0;  // [ns]; 0: none
    Pose X;
  };
  struct Publisher {
    int number = 0;
    Sample before, last;
    std::int64_t differed = 0;     // stamp of the last sample that was told to differ
    std::array<Sample, 5> recent;  // the last ones, at `count` modulo their number
    std::uint64_t count = 0;
    std::uint64_t to_and_fro = 0;  // how many in a row
  };

  void Compare(const Publisher& fast, Publisher* slow);
  void LookForTwoCourses(Publisher* publisher);

  std::vector<Publisher> publishers_;
  Conflict conflict_, two_courses_;
};

}  // namespace cosserat_cable
