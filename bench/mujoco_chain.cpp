#include "mujoco_chain.h"

#include <cstring>
#include <sstream>
#include <stdexcept>

namespace cosserat_cable::bench {

namespace {

std::string Numbers(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << ' ' << v.y() << ' ' << v.z();
  return out.str();
}

/// Mass and capsule of one piece of the chain between z0 and z1 of its node's frame.
std::string Capsule(const SweptArch& arch, double z0, double z1) {
  constexpr double kRadius = SweptArch::kDiameter / 2;
  const double length = z1 - z0, mass = arch.rhoA * length, middle = 0.5 * (z0 + z1);
  // A cylinder's inertia: round ends would overlap and count twice.
  const double across = mass * (kRadius * kRadius / 4 + length * length / 12);
  std::ostringstream out;
  out.precision(17);
  out << "<inertial pos='0 0 " << middle << "' mass='" << mass << "' diaginertia='" << across << ' '
      << across << ' ' << mass * kRadius * kRadius / 2 << "'/><geom type='capsule' size='"
      << kRadius << "' fromto='0 0 " << z0 << " 0 0 " << z1 << "'/>";
  return out.str();
}

std::string Xml(const SweptArch& arch, const MujocoSetting& setting) {
  const double h = SweptArch::kLength / setting.elements;
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><compiler angle='radian' inertiafromgeom='false' boundmass='0'/>"
      << "<option timestep='" << setting.dt << "' integrator='" << setting.integrator
      << "' solver='" << setting.solver << "' gravity='0 0 -9.81'>"
      << "<flag contact='disable'/></option><worldbody>"
      << "<body name='clamp_a' mocap='true'/><body name='clamp_b' mocap='true' pos='"
      << Numbers(SweptArch::ClampB(0).p) << "' quat='0 0 1 0'/>"
      << "<body name='node0'><freejoint/>" << Capsule(arch, 0, h / 2);
  for (int i = 1; i <= setting.elements; ++i)
    xml << "<body name='node" << i << "' pos='0 0 " << h << "'><joint type='ball' pos='0 0 "
        << -h / 2 << "' stiffness='" << arch.EI / h << "' damping='" << arch.eta_EI / h << "'/>"
        << Capsule(arch, -h / 2, i < setting.elements ? h / 2 : 0);
  for (int i = 0; i <= setting.elements; ++i) xml << "</body>";
  // As hard as the step allows: a time constant of two steps. An impedance nearer to 1 was no more
  // accurate.
  const std::string weld = "relpose='0 0 0 1 0 0 0' solimp='0.95 0.95 0.001' solref='";
  xml << "</worldbody><equality>"
      << "<weld body1='clamp_a' body2='node0' " << weld << 2 * setting.dt << " 1'/>"
      << "<weld body1='clamp_b' body2='node" << setting.elements << "' " << weld << 2 * setting.dt
      << " 1'/></equality></mujoco>";
  return xml.str();
}

mjModel* Load(const std::string& xml) {
  constexpr const char* kName = "arch.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kName)], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* model = mj_loadXML(kName, files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

}  // namespace

MujocoChain::MujocoChain(const SweptArch& arch, const MujocoSetting& setting) : dt_(setting.dt) {
  model_.reset(Load(Xml(arch, setting)));
  data_.reset(mj_makeData(model_.get()));
  const std::string apex = "node" + std::to_string(setting.elements / 2);
  apex_ = mj_name2id(model_.get(), mjOBJ_BODY, apex.c_str());
  end_ = mj_name2id(model_.get(), mjOBJ_BODY, "node0");
  const rod::Rod rod = Settled(arch.Model(setting.elements));
  double* q = data_->qpos + 7;
  for (int i = 1; i <= setting.elements; ++i, q += 4) {
    const Eigen::Quaterniond turn = rod.pose(i - 1).q.conjugate() * rod.pose(i).q;
    q[0] = turn.w();
    q[1] = turn.x();
    q[2] = turn.y();
    q[3] = turn.z();
  }
  mj_forward(model_.get(), data_.get());
}

bool MujocoChain::Start() {
  constexpr double kSettling = 0.5;  // s
  for (int k = 0; k * dt_ < kSettling; ++k)
    if (!Step(0)) return false;
  data_->qvel[0] = SweptArch::StartVelocity();
  return true;
}

bool MujocoChain::Step(double shift) {
  data_->mocap_pos[0] = SweptArch::ClampA(shift).p.x();
  data_->mocap_pos[3] = SweptArch::ClampB(shift).p.x();
  mj_step(model_.get(), data_.get());
  return data_->warning[mjWARN_BADQPOS].number + data_->warning[mjWARN_BADQVEL].number +
             data_->warning[mjWARN_BADQACC].number ==
         0;
}

}  // namespace cosserat_cable::bench
