#include "cosserat_cable/ros/telemetry.h"

#include <cmath>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

void Set(const Eigen::Vector3d& v, double* x, double* y, double* z) {
  *x = v.x();
  *y = v.y();
  *z = v.z();
}

}  // namespace

ApexTelemetry MakeTelemetry(const CableReport& report, const Motion& reference,
                            const Eigen::Vector3d& rest_R, std::int64_t time) {
  const Eigen::Quaterniond q_RW = reference.X.q.conjugate();
  const Eigen::Vector3d p_R = q_RW * (report.apex - reference.X.p);
  // The derivative of p_R: what R itself moves is taken off.
  const Eigen::Vector3d v_R =
      q_RW * (report.apex_velocity - reference.v) - reference.omega.cross(p_R);

  ApexTelemetry m;
  m.header.stamp = ToRosTime(time);
  Set(p_R, &m.position_x, &m.position_y, &m.position_z);
  Set(p_R - rest_R, &m.displacement_x, &m.displacement_y, &m.displacement_z);
  Set(v_R, &m.velocity_x, &m.velocity_y, &m.velocity_z);
  m.curvature_max = report.curvature_max;
  m.clearance = report.clearance;
  m.contact_force = report.contact_force;
  m.tension = report.tension_max;
  Set(q_RW * report.force_a, &m.force_a_x, &m.force_a_y, &m.force_a_z);
  Set(q_RW * report.moment_a, &m.moment_a_x, &m.moment_a_y, &m.moment_a_z);
  Set(q_RW * report.force_b, &m.force_b_x, &m.force_b_y, &m.force_b_z);
  Set(q_RW * report.moment_b, &m.moment_b_x, &m.moment_b_y, &m.moment_b_z);
  m.work_clamps = report.energy.work_ends;
  m.work_contact = report.energy.work_loads;
  m.dissipated = report.energy.dissipated;
  m.energy_residual = report.energy.Residual();
  return m;
}

bool IsValid(const ApexTelemetry& m) {
  for (const double value :
       {m.position_x,     m.position_y,    m.position_z, m.displacement_x, m.displacement_y,
        m.displacement_z, m.velocity_x,    m.velocity_y, m.velocity_z,     m.amplitude,
        m.curvature_max,  m.contact_force, m.tension,    m.force_a_x,      m.force_a_y,
        m.force_a_z,      m.moment_a_x,    m.moment_a_y, m.moment_a_z,     m.force_b_x,
        m.force_b_y,      m.force_b_z,     m.moment_b_x, m.moment_b_y,     m.moment_b_z,
        m.work_clamps,    m.work_contact,  m.dissipated, m.energy_residual}) {
    if (!std::isfinite(value)) return false;
  }
  return !std::isnan(m.clearance) && m.clearance > -INFINITY;
}

}  // namespace cosserat_cable
