#include "step_kernels.h"

#include "cosserat_cable/rod/generalized_alpha.h"
#include "kernel.h"

namespace cosserat_cable::rod {
namespace {

template <class T>
void EvaluateForcesOf(StepWorkspace<T>* w) {
  const T zero(0.0);
  for (int i = 0; i < w->count; ++i) {
    const Vec3<T> f = w->mass[i] * w->gravity;
    w->rhs[i] = {{f.x, f.y, f.z, zero, zero, zero}};
  }
  w->chain.Evaluate(w->trial.data(), w->law, w->rhs.data());
}

template <class T>
void PredictOf(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) {
  for (int i = first; i <= last; ++i) {
    const Vec3<T> dr = c.dt * w->node[i].v, dphi = c.dt * w->node[i].omega;
    w->increment[i] = {{dr.x, dr.y, dr.z, dphi.x, dphi.y, dphi.z}};
  }
}

template <class T>
void UpdateNodesOf(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) {
  for (int i = first; i <= last; ++i) {
    const Node<T>& from = w->node[i];
    const NodeRates<T>&a0 = w->algorithm[i], &rate0 = w->rate[i];
    const Vec6<T>& d = w->increment[i];
    const Vec3<T> dr{d[0], d[1], d[2]}, dphi{d[3], d[4], d[5]};
    NodeRates<T> a1;
    a1.v = c.algorithm_by_increment * (dr - c.dt * from.v - c.old_position * a0.v);
    a1.omega = c.algorithm_by_increment * (dphi - c.dt * from.omega - c.old_position * a0.omega);
    Node<T>& to = w->trial[i];
    to.r = from.r + dr;
    to.q = from.q * Exp(dphi);
    to.v = from.v + c.old_velocity * a0.v + c.new_velocity * a1.v;
    to.omega = from.omega + c.old_velocity * a0.omega + c.new_velocity * a1.omega;
    NodeRates<T>& rate = w->trial_rate[i];
    rate.v = c.new_algorithm * a1.v + c.old_algorithm * a0.v + c.old_rate * rate0.v;
    rate.omega = c.new_algorithm * a1.omega + c.old_algorithm * a0.omega + c.old_rate * rate0.omega;
    w->trial_algorithm[i] = a1;
  }
}

template <class T>
void SubtractInertiaOf(StepWorkspace<T>* w) {
  for (int i = 0; i < w->count; ++i) {
    const Vec3<T> f = w->mass[i] * w->trial_rate[i].v;
    const Vec3<T>& omega = w->trial[i].omega;
    const Vec3<T> g =
        Scale(w->inertia[i], w->trial_rate[i].omega) + Cross(omega, Scale(w->inertia[i], omega));
    Vec6<T>& b = w->rhs[i];
    b[0] -= f.x;
    b[1] -= f.y;
    b[2] -= f.z;
    b[3] -= g.x;
    b[4] -= g.y;
    b[5] -= g.z;
  }
}

template <class T>
void AddInertiaOf(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) {
  for (int i = first; i <= last; ++i) {
    const Vec3<T> j = c.rate_by_increment * w->inertia[i];
    const T m = c.rate_by_increment * w->mass[i];
    Block6<T>& d = w->system.diagonal(i);
    for (int k = 0; k < 3; ++k) d[k][k] += m;
    d[3][3] += j.x;
    d[4][4] += j.y;
    d[5][5] += j.z;
  }
}

template <class T>
CorrectionSize<T> MeasureCorrectionOf(int first, int last, const StepWorkspace<T>& w) {
  CorrectionSize<T> size{T(0.0), T(0.0), T(0.0)};
  for (int i = first; i <= last; ++i) {
    const Vec6<T>& d = w.rhs[i];
    size.translation = Max(size.translation, Max(Abs(d[0]), Max(Abs(d[1]), Abs(d[2]))));
    size.rotation = Max(size.rotation, Max(Abs(d[3]), Max(Abs(d[4]), Abs(d[5]))));
    // A maximum may lose a NaN, a sum does not.
    size.sum += (d[0] + d[1] + d[2]) + (d[3] + d[4] + d[5]);
  }
  return size;
}

// The system is solved for the variation phi in the section's frame; the step's rotation vector
// Theta changes by Jr(Theta)^{-1} phi = phi + Theta x phi/2 + Theta x (Theta x phi)/12. With that,
// the rates' tangent is `velocity_by_increment` times the strains' to first order in Theta: what
// both leave out cancels.
template <class T>
void CorrectOf(int first, int last, StepWorkspace<T>* w) {
  for (int i = first; i <= last; ++i) {
    const Vec6<T>& x = w->rhs[i];
    Vec6<T>& increment = w->increment[i];
    const Vec3<T> theta{increment[3], increment[4], increment[5]}, phi{x[3], x[4], x[5]};
    const Vec3<T> across = Cross(theta, phi);
    const Vec3<T> d = phi + 0.5 * across + (1.0 / 12) * Cross(theta, across);
    for (int k = 0; k < 3; ++k) increment[k] += x[k];
    increment[3] += d.x;
    increment[4] += d.y;
    increment[5] += d.z;
  }
}

}  // namespace

StepCoefficients::StepCoefficients(double step) : dt(step) {
  constexpr GeneralizedAlpha kScheme{};
  algorithm_by_increment = 1 / (kScheme.beta * dt * dt);
  velocity_by_increment = kScheme.gamma / (kScheme.beta * dt);
  old_position = dt * dt * (0.5 - kScheme.beta);
  old_velocity = dt * (1 - kScheme.gamma);
  new_velocity = dt * kScheme.gamma;
  new_algorithm = (1 - kScheme.alpha_m) / (1 - kScheme.alpha_f);
  old_algorithm = kScheme.alpha_m / (1 - kScheme.alpha_f);
  old_rate = -kScheme.alpha_f / (1 - kScheme.alpha_f);
  rate_by_increment = new_algorithm * algorithm_by_increment;
}

#define COSSERAT_CABLE_DEFINE_KERNELS(T)                                                  \
  void EvaluateForces(StepWorkspace<T>* w) { EvaluateForcesOf(w); }                       \
  void AssembleTangent(double rate_factor, StepWorkspace<T>* w) {                         \
    w->chain.AssembleTangent(w->law.h, w->law.C_F + rate_factor * w->law.V_F,             \
                             w->law.C_M + rate_factor * w->law.V_M, &w->system);          \
  }                                                                                       \
  void Predict(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) {     \
    PredictOf(c, first, last, w);                                                         \
  }                                                                                       \
  COSSERAT_CABLE_KERNEL                                                                   \
  void UpdateNodes(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) { \
    UpdateNodesOf(c, first, last, w);                                                     \
  }                                                                                       \
  COSSERAT_CABLE_KERNEL                                                                   \
  void SubtractInertia(StepWorkspace<T>* w) { SubtractInertiaOf(w); }                     \
  COSSERAT_CABLE_KERNEL                                                                   \
  void AddInertia(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w) {  \
    AddInertiaOf(c, first, last, w);                                                      \
  }                                                                                       \
  COSSERAT_CABLE_KERNEL                                                                   \
  void Factorise(int first, int last, StepWorkspace<T>* w, T* smallest) {                 \
    *smallest = w->system.Factorise(first, last);                                         \
  }                                                                                       \
  COSSERAT_CABLE_KERNEL                                                                   \
  void Solve(StepWorkspace<T>* w) { w->system.Solve(w->rhs.data()); }                     \
  COSSERAT_CABLE_KERNEL                                                                   \
  CorrectionSize<T> MeasureCorrection(int first, int last, const StepWorkspace<T>& w) {   \
    return MeasureCorrectionOf(first, last, w);                                           \
  }                                                                                       \
  COSSERAT_CABLE_KERNEL                                                                   \
  void Correct(int first, int last, StepWorkspace<T>* w) { CorrectOf(first, last, w); }

COSSERAT_CABLE_DEFINE_KERNELS(double)
COSSERAT_CABLE_DEFINE_KERNELS(Lanes)

}  // namespace cosserat_cable::rod
