#include "step_kernels.h"

#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable::rod {

void EvaluateForces(StepWorkspace<double>* w) {
  for (int i = 0; i < w->count; ++i) {
    const Vec3<double> f = w->mass[i] * w->gravity;
    w->rhs[i] = {{f.x, f.y, f.z, 0, 0, 0}};
  }
  w->chain.Evaluate(w->trial.data(), w->law, w->rhs.data());
}

void AssembleTangent(double rate_factor, StepWorkspace<double>* w) {
  w->chain.AssembleTangent(rate_factor, &w->system);
}

COSSERAT_CABLE_KERNEL
void Factorise(int first, int last, StepWorkspace<double>* w, double* smallest) {
  *smallest = w->system.Factorise(first, last);
}

COSSERAT_CABLE_KERNEL
void Solve(StepWorkspace<double>* w) { w->system.Solve(w->rhs.data()); }

CorrectionSize<double> MeasureCorrection(int first, int last, const StepWorkspace<double>& w) {
  CorrectionSize<double> size{0, 0, 0};
  for (int i = first; i <= last; ++i) {
    const Vec6<double>& d = w.rhs[i];
    size.translation = Max(size.translation, Max(Abs(d[0]), Max(Abs(d[1]), Abs(d[2]))));
    size.rotation = Max(size.rotation, Max(Abs(d[3]), Max(Abs(d[4]), Abs(d[5]))));
    // A maximum may lose a NaN, a sum does not.
    size.sum += (d[0] + d[1] + d[2]) + (d[3] + d[4] + d[5]);
  }
  return size;
}

}  // namespace cosserat_cable::rod
