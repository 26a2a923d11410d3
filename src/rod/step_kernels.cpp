#include "step_kernels.h"

#include "cosserat_cable/rod/generalized_alpha.h"
#include "kernel.h"

namespace cosserat_cable::rod {

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

COSSERAT_CABLE_KERNEL
void UpdateNodes(const StepCoefficients& c, const NodeStep& step, int first, int last) {
  for (int i = first; i <= last; ++i) {
    const Node<double>& from = step.from[i];
    const NodeRates &a0 = step.algorithm[i], &rate0 = step.rate[i];
    const Vec6<double>& d = step.increment[i];
    const Vec3<double> dr{d[0], d[1], d[2]}, dphi{d[3], d[4], d[5]};
    NodeRates a1;
    a1.v = c.algorithm_by_increment * (dr - c.dt * from.v - c.old_position * a0.v);
    a1.omega = c.algorithm_by_increment * (dphi - c.dt * from.omega - c.old_position * a0.omega);
    Node<double>& to = step.to[i];
    to.r = from.r + dr;
    to.q = from.q * Exp(dphi);
    to.v = from.v + c.old_velocity * a0.v + c.new_velocity * a1.v;
    to.omega = from.omega + c.old_velocity * a0.omega + c.new_velocity * a1.omega;
    NodeRates& rate = step.to_rate[i];
    rate.v = c.new_algorithm * a1.v + c.old_algorithm * a0.v + c.old_rate * rate0.v;
    rate.omega = c.new_algorithm * a1.omega + c.old_algorithm * a0.omega + c.old_rate * rate0.omega;
    step.to_algorithm[i] = a1;
  }
}

COSSERAT_CABLE_KERNEL
void SubtractInertia(const double* mass, const Vec3<double>* inertia, const Node<double>* nodes,
                     const NodeRates* rates, int count, Vec6<double>* rhs) {
  for (int i = 0; i < count; ++i) {
    const Vec3<double> f = mass[i] * rates[i].v;
    const Vec3<double>& omega = nodes[i].omega;
    const Vec3<double> g =
        Scale(inertia[i], rates[i].omega) + Cross(omega, Scale(inertia[i], omega));
    Vec6<double>& b = rhs[i];
    b[0] -= f.x;
    b[1] -= f.y;
    b[2] -= f.z;
    b[3] -= g.x;
    b[4] -= g.y;
    b[5] -= g.z;
  }
}

COSSERAT_CABLE_KERNEL
double Factorise(BlockTridiagonal<double>* system, int first, int last) {
  return system->Factorise(first, last);
}

COSSERAT_CABLE_KERNEL
void Solve(const BlockTridiagonal<double>& system, Vec6<double>* x) { system.Solve(x); }

}  // namespace cosserat_cable::rod
