// A hanging cable as MuJoCo has it: rigid pieces in ball joints. What a cable may have besides acts
// on its joints and pieces, so that records with a known cause are another program's.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace cosserat_cable {

using Point = std::array<double, 3>;

/// A ball joint twists as it bends: GJ is EI.
struct ChainCable {
  double length = 0.3, diameter = 0.006, rhoA = 0.06;  // m, m, kg/m
  double EI = 0.004, eta_EI = 8e-6;                    // N m^2, N m^2 s
};

/// Nothing of it by default.
struct ChainEffects {
  double drag = 0;               ///< drag coefficient of the air
  double external = 0;           ///< rate of a loss linear in the velocity [1/s]
  double eddy = 0;               ///< the same, of the outer half only [1/s]
  double tip_mass = 0;           ///< kg
  double clamp_spring = 0;       ///< of the clamp; 0: rigid [N m/rad]
  double play = 0;               ///< half of the clamp's backlash [rad]
  double friction = 0;           ///< moment at which strands slip, on average along the cable [N m]
  double friction_EI = 0;        ///< what stuck strands add [N m^2]
  double change = 0;             ///< of EI at large curvature, in parts of it
  double change_curvature = 10;  ///< at which half of that is reached [1/m]
  double anisotropy = 0;         ///< EI (1 + this) about y, EI (1 - this) about z
  double rest_curvature = 0;     ///< about y [1/m]
  double wall = 0;               ///< how far behind the axis at y = 0 a wall stands; 0: none [m]
};

class MujocoChain {
 public:
  /// Its model is written to `path`.
  MujocoChain(const ChainCable& cable, const ChainEffects& effects, const std::string& path);

  /// At rest, its tip pulled by a force; the force is gone then.
  void HoldBy(const Point& force);
  void Step();
  /// Where the axis is at an arc length.
  Point At(double s);

  static constexpr double kStep = 1e-5;  // [s]; MuJoCo's steps are of first order

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  std::string Xml() const;
  void Clear() { mju_zero(data_->qfrc_applied, model_->nv); }
  void Push(const Point& force, const Point& at, int body);
  bool ActsOnPieces() const;
  bool ActsOnJoints() const;
  /// To the forces of the state that MuJoCo has gone forward to.
  void AddEffects();
  void AddToPiece(int body);
  void AddToJoint(int body);
  Point FrictionOf(int body, const Point& turn);

  ChainCable cable_;
  ChainEffects effects_;
  double piece_;                // length of one
  std::vector<Point> slipped_;  // by joint: how far the strands have slipped [rad]
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

}  // namespace cosserat_cable
