// What the partly held ends of a rod do to its statics.
#pragma once

#include "end_part.h"
#include "step_workspace.h"

namespace cosserat_cable::rod {

/// Puts what is held of the end nodes of the iterate where the clamps have it.
inline void ImposeEnds(const EndParts& ends, StepWorkspace<double>* w) {
  if (ends.a.holds()) ends.a.ImposePose(&w->trial.front());
  if (ends.b.holds()) ends.b.ImposePose(&w->trial.back());
}

/// Adds the clamps' springs and takes what is held out of the system.
inline void ConstrainEnds(const EndParts& ends, EndPart::Memory memory, StepWorkspace<double>* w) {
  using Matrix6 = EndPart::Matrix6;
  const auto as_matrix = [](Block6<double>* block) {
    return Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(&(*block)[0][0]);
  };
  ends.ForEachActive([&](const EndPart& end, bool at_b) {
    const int i = at_b ? w->count - 1 : 0;
    const Node<double>& node = w->trial[i];
    const Matrix6 free = end.FreeProjector(node);
    Eigen::Map<Eigen::Matrix<double, 6, 1>> rhs(w->rhs[i].v);
    rhs.tail<3>() += end.SpringMoment(node, memory);
    rhs = (free * rhs).eval();
    // Only the lower triangle of a diagonal block is kept.
    auto diagonal = as_matrix(&w->system.diagonal(i));
    Matrix6 block = diagonal.selfadjointView<Eigen::Lower>();
    block.bottomRightCorner<3, 3>() += end.SpringTangent(node, 0, memory);
    const double scale = block.diagonal().cwiseAbs().maxCoeff();
    diagonal = free * block * free + scale * (Matrix6::Identity() - free);
    if (at_b) {
      auto lower = as_matrix(&w->system.lower(i - 1));
      lower = (free * lower).eval();
    } else {
      auto lower = as_matrix(&w->system.lower(0));
      lower = (lower * free).eval();
    }
  });
}

}  // namespace cosserat_cable::rod
