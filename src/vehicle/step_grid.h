// Whether displacements are multiples of one step, as a coarse sensor or a rounded file has them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace cosserat_cable {

class StepGrid {
 public:
  /// The displacement between two samples that follow each other.
  void Add(const Eigen::Vector3d& d);
  /// One step along each axis that has a grid; 0 where none has, or too little is known.
  double Step() const;
  /// The largest one of these along one axis.
  double LargestStep() const;
  /// The same while it is not known yet whether all displacements keep to it.
  double Candidate() const;

 private:
  struct Axis {
    double step = 0;       // the smallest displacement so far
    long multiple = 0;     // of the last displacement
    std::uint64_t on = 0;  // displacements of one step or a few
    std::uint64_t off = 0;
    std::uint64_t changes = 0;  // of the multiple from one displacement to the next
    void Add(double d);
    bool IsGrid() const;
  };
  std::array<Axis, 3> axes_;
};

}  // namespace cosserat_cable
