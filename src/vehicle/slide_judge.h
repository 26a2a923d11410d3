// Whether an edge rests but for short slides from one place to the next, as filtered corrections of
// a localisation do.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace cosserat_cable {

class SlideJudge {
 public:
  struct Slides {
    std::uint64_t count = 0;
    std::int64_t first = 0, worst = 0;  ///< stamps at which they begin [ns]
    double size = 0;                    ///< of the largest, in m or rad
    double duration = 0;                ///< of the same [s]
  };

  /// Least size of a slide in m or rad, and least acceleration [/s^2].
  SlideJudge(double size, double acceleration) : size_(size), acceleration_(acceleration) {}

  /// The displacement between two samples that follow each other, `h` [s] apart. `stamp`: of the
  /// later one [ns].
  void Add(const Eigen::Vector3d& d, double h, std::int64_t stamp);
  /// What was added before has nothing to do with what comes.
  void Restart();

  const Slides& slides() const { return slides_; }
  /// Whether it also moved for longer than a correction takes.
  bool travels() const { return travels_; }

 private:
  void AddPart(std::int64_t end);
  void CloseRun();

  double size_, acceleration_;
  Eigen::Vector3d part_ = Eigen::Vector3d::Zero();  // the displacement over a part
  double part_time_ = 0;                            // [s]

  double at_rest_ = -1;  // the usual speed; negative: not known
  bool runs_ = false;
  Eigen::Vector3d run_ = Eigen::Vector3d::Zero();
  std::int64_t run_begin_ = 0, run_end_ = 0;  // [ns]
  Slides slides_;
  bool travels_ = false;
};

}  // namespace cosserat_cable
