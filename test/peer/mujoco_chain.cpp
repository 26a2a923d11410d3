#include "mujoco_chain.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace cosserat_cable {
namespace {

constexpr int kPieces = 30;
// While the cable is pulled aside, the step [s], how long, the force growing over a quarter of it,
// and what damps the joints [N m s].
constexpr double kPullStep = 5e-5, kPulled = 1.5, kPullDamping = 0.1;
constexpr double kAirDensity = 1.2;  // kg/m^3
// Thresholds of friction along the cable: even, from one less this to one and this, mixed up.
constexpr double kSpread = 0.6;
constexpr int kMixed = 7;
// A wall's stiffness [N/m] and loss [N s/m] at one piece.
constexpr double kWallStiffness = 3e3, kWallLoss = 0.02;

double Norm(const Point& v) { return std::hypot(v[0], v[1], v[2]); }

/// In the frame of a joint's outer piece, what `v` is in the frame halfway to it.
Point FromHalfway(const Point& turn, const Point& v) {
  return {v[0] - 0.5 * (turn[1] * v[2] - turn[2] * v[1]),
          v[1] - 0.5 * (turn[2] * v[0] - turn[0] * v[2]),
          v[2] - 0.5 * (turn[0] * v[1] - turn[1] * v[0])};
}

}  // namespace

std::string MujocoChain::Xml() const {
  const double h = piece_, r = cable_.diameter / 2, mass = cable_.rhoA * h;
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><option timestep='" << kStep << "' integrator='Euler' gravity='0 0 -9.81'>"
      << "<flag contact='disable'/></option><worldbody>";
  for (int i = 0; i < kPieces; ++i) {
    // The joint at the clamp has half a piece to bend, and the clamp's spring in series.
    double joint = (i == 0 ? 2 : 1) * cable_.EI / h;
    const double damping = joint * cable_.eta_EI / cable_.EI;
    if (i == 0 && effects_.clamp_spring > 0) joint = 1 / (1 / joint + 1 / effects_.clamp_spring);
    if (i == 0 && effects_.play > 0) joint = 0;  // AddToJoint has it
    const double lump = i + 1 == kPieces ? effects_.tip_mass : 0;
    const double centre = (mass * h / 2 + lump * h) / (mass + lump);
    const double across = mass * (3 * r * r + h * h) / 12 + mass * std::pow(centre - h / 2, 2) +
                          lump * std::pow(h - centre, 2);
    xml << "<body pos='" << (i == 0 ? 0 : h) << " 0 0'><inertial pos='" << centre << " 0 0' mass='"
        << mass + lump << "' diaginertia='" << mass * r * r / 2 << ' ' << across << ' ' << across
        << "'/><joint type='ball' stiffness='" << joint << "' damping='" << damping << "'/>";
  }
  for (int i = 0; i < kPieces; ++i) xml << "</body>";
  xml << "</worldbody></mujoco>";
  return xml.str();
}

MujocoChain::MujocoChain(const ChainCable& cable, const ChainEffects& effects,
                         const std::string& path)
    : cable_(cable), effects_(effects), piece_(cable.length / kPieces) {
  std::ofstream(path) << Xml();
  char error[1000] = "";
  model_.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
  if (!model_) throw std::runtime_error(error);
  data_.reset(mj_makeData(model_.get()));
}

void MujocoChain::HoldBy(const Point& force) {
  mj_resetData(model_.get(), data_.get());
  slipped_.assign(kPieces, Point{});
  const std::vector<double> own(model_->dof_damping, model_->dof_damping + model_->nv);
  std::fill_n(model_->dof_damping, model_->nv, kPullDamping);
  model_->opt.timestep = kPullStep;
  const int steps = static_cast<int>(std::lround(kPulled / kPullStep));
  for (int i = 0; i < steps; ++i) {
    mj_forward(model_.get(), data_.get());
    AddEffects();
    const double part = std::min(1.0, 4.0 * i / steps);
    Push({part * force[0], part * force[1], part * force[2]}, At(cable_.length), kPieces);
    mj_step(model_.get(), data_.get());
  }
  std::copy(own.begin(), own.end(), model_->dof_damping);
  model_->opt.timestep = kStep;
  mju_zero(data_->qvel, model_->nv);
  Clear();
  mj_forward(model_.get(), data_.get());
}

void MujocoChain::Step() {
  if (ActsOnPieces() || ActsOnJoints()) {
    mj_forward(model_.get(), data_.get());
    AddEffects();
  }
  mj_step(model_.get(), data_.get());
}

Point MujocoChain::At(double s) {
  const int piece = std::min(kPieces - 1, static_cast<int>(std::floor(s / piece_ - 1e-9)));
  const mjtNum* R = data_->xmat + 9 * (piece + 1);
  const mjtNum* p = data_->xpos + 3 * (piece + 1);
  const double along = s - piece * piece_;
  return {p[0] + R[0] * along, p[1] + R[3] * along, p[2] + R[6] * along};
}

void MujocoChain::Push(const Point& force, const Point& at, int body) {
  const mjtNum none[3] = {0, 0, 0};
  mj_applyFT(model_.get(), data_.get(), force.data(), none, at.data(), body, data_->qfrc_applied);
}

bool MujocoChain::ActsOnPieces() const {
  const ChainEffects& e = effects_;
  return e.drag > 0 || e.external > 0 || e.eddy > 0 || e.wall > 0;
}

bool MujocoChain::ActsOnJoints() const {
  const ChainEffects& e = effects_;
  return e.friction > 0 || e.change != 0 || e.anisotropy != 0 || e.rest_curvature != 0 ||
         e.play > 0;
}

void MujocoChain::AddEffects() {
  Clear();
  for (int body = 1; body <= kPieces; ++body) {
    if (ActsOnPieces()) AddToPiece(body);
    if (ActsOnJoints()) AddToJoint(body);
  }
}

void MujocoChain::AddToPiece(int body) {
  mjtNum velocity[6];
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, body, velocity, 0);
  const mjtNum* R = data_->xmat + 9 * body;
  const Point v = {velocity[3], velocity[4], velocity[5]};
  const double along = v[0] * R[0] + v[1] * R[3] + v[2] * R[6];
  const Point across = {v[0] - along * R[0], v[1] - along * R[3], v[2] - along * R[6]};
  const double by_drag =
      0.5 * kAirDensity * effects_.drag * cable_.diameter * piece_ * Norm(across);
  const bool outer = 2 * body > kPieces;
  const double by_rate = (effects_.external + (outer ? effects_.eddy : 0)) * cable_.rhoA * piece_;
  const mjtNum* centre = data_->xipos + 3 * body;
  Point force;
  for (std::size_t k = 0; k < 3; ++k) force[k] = -by_drag * across[k] - by_rate * v[k];
  const double depth = cable_.diameter / 2 - effects_.wall - centre[1];
  if (effects_.wall > 0 && depth > 0)
    force[1] += std::max(0.0, kWallStiffness * depth - kWallLoss * v[1]);
  Push(force, {centre[0], centre[1], centre[2]}, body);
}

void MujocoChain::AddToJoint(int body) {
  const int joint = body - 1;
  const mjtNum* quat = data_->qpos + model_->jnt_qposadr[joint];
  mjtNum turned[3];
  mju_quat2Vel(turned, quat, 1);
  const Point turn = {turned[0], turned[1], turned[2]};
  const double stiffness = (joint == 0 ? 2 : 1) * cable_.EI / piece_;
  // What of the cable a joint stands for.
  const double arc = joint == 0 ? piece_ / 2 : piece_;
  const double k2 = (turn[1] * turn[1] + turn[2] * turn[2]) / (arc * arc);
  const double changed =
      effects_.change * k2 / (k2 + effects_.change_curvature * effects_.change_curvature);
  Point moment = {0, -stiffness * (changed + effects_.anisotropy) * turn[1],
                  -stiffness * (changed - effects_.anisotropy) * turn[2]};
  moment[1] += cable_.EI * effects_.rest_curvature;
  if (effects_.friction > 0) {
    const Point friction = FrictionOf(body, turn);
    for (std::size_t k = 0; k < 3; ++k) moment[k] += friction[k];
  }
  if (joint == 0 && effects_.play > 0) {
    const double angle = Norm(turn), beyond = std::max(0.0, angle - effects_.play);
    for (std::size_t k = 0; k < 3 && angle > 0; ++k)
      moment[k] -= stiffness * beyond * turn[k] / angle;
  }
  const Point own = FromHalfway(turn, moment);
  for (int k = 0; k < 3; ++k)
    data_->qfrc_applied[model_->jnt_dofadr[joint] + k] += own[static_cast<std::size_t>(k)];
}

Point MujocoChain::FrictionOf(int body, const Point& turn) {
  const int joint = body - 1;
  const double arc = joint == 0 ? piece_ / 2 : piece_, stuck = effects_.friction_EI / arc;
  const double place = (joint * kMixed % kPieces + 0.5) / kPieces;
  const double most = effects_.friction * (1 + kSpread * (2 * place - 1));
  Point& slipped = slipped_[static_cast<std::size_t>(joint)];
  Point held = {0, stuck * (turn[1] - slipped[1]), stuck * (turn[2] - slipped[2])};
  const double size = Norm(held);
  if (size > most)
    for (std::size_t k = 1; k < 3; ++k) {
      held[k] *= most / size;
      slipped[k] = turn[k] - held[k] / stuck;
    }
  return {0, -held[1], -held[2]};
}

}  // namespace cosserat_cable
