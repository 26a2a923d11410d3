// Writes what the figures of docs/validation.md show, as CSV files, into the folder given; drawn by
// scripts/validation.
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/published_rods.h"

namespace cosserat_cable::rod {
namespace {

std::ofstream Table(const std::string& folder, const char* name, const char* header) {
  std::ofstream out(folder + "/" + name);
  out.exceptions(std::ofstream::failbit | std::ofstream::badbit);
  out << header << '\n';
  return out;
}

void WriteShape(std::ofstream* out, double key, const Rod& rod) {
  for (int i = 0; i <= rod.elements(); ++i) {
    const Eigen::Vector3d p = rod.pose(i).p;
    *out << key << ',' << p.x() << ',' << p.y() << ',' << p.z() << '\n';
  }
}

void Require(const SolveReport& report, const char* what) {
  if (!report.converged) throw std::runtime_error(std::string(what) + ": no convergence");
}

void Elastica(const std::string& folder) {
  std::ofstream out = Table(folder, "elastica.csv", "load,x,y,z");  // P L^2/EI, in lengths
  RodModel model = InextensibleRod(0.02, 80);
  model.b = EndModel::Free();
  for (const double load : {0, 1, 2, 5, 10}) {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, 1.0, model.elements));
    const PointLoads force(1.0, {{1.0, {0.02 * load, 0, 0}}});
    if (load > 0) Require(rod.Equilibrate(&force), "elastica");
    WriteShape(&out, load, rod);
  }
}

void Bend(const std::string& folder) {
  std::ofstream out = Table(folder, "bend.csv", "load,x,y,z");
  Rod rod = FortyFiveDegreeBend(64);
  for (const double load : {0, 300, 600}) {
    const double L = rod.model().length;
    const PointLoads force(L, {{L, {0, 0, load}}});
    Require(rod.Equilibrate(&force), "45 degree bend");
    WriteShape(&out, load, rod);
  }
}

void Pendulum(const std::string& folder) {
  std::ofstream out = Table(folder, "pendulum.csv", "t,x,y,z");  // [s], [m]
  constexpr double kDt = 5e-4;
  Rod rod = RubberRodPendulum(40);
  const Pose pin = rod.pose(0);
  WriteShape(&out, 0, rod);
  for (int k = 1; k <= 1400; ++k) {
    Require(rod.Step(kDt, pin, pin), "pendulum");
    if (k % 200 == 0) WriteShape(&out, k * kDt, rod);
  }
}

/// Half the way between successive extremes of the apex, at the time between them [s], [mm].
void SweptArches(const std::string& folder) {
  std::ofstream out = Table(folder, "sweep.csv", "cable,factor,t,amplitude");
  struct Cable {
    int number;
    double EI, rhoA, eta_EI;
    Eigen::Vector3d axis;
  };
  const Cable cables[] = {{2, 0.0080, 0.15, 1e-4, Eigen::Vector3d::UnitX()},
                          {4, 0.0205, 0.09, 2e-4, Eigen::Vector3d::UnitY()}};
  for (const Cable& cable : cables)
    for (const double factor : {1.5, 1.0, 0.5, 0.1}) {
      Sweep sweep{cable.EI, cable.rhoA, factor * cable.eta_EI, cable.axis};
      sweep.dt = 5e-4;
      for (const Sweep::Swing& swing : sweep.Swings(7))
        out << cable.number << ',' << factor << ',' << swing.t << ',' << 1e3 * swing.size << '\n';
    }
}

}  // namespace
}  // namespace cosserat_cable::rod

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: validation_figures FOLDER\n");
    return 2;
  }
  try {
    cosserat_cable::rod::Elastica(argv[1]);
    cosserat_cable::rod::Bend(argv[1]);
    cosserat_cable::rod::Pendulum(argv[1]);
    cosserat_cable::rod::SweptArches(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "validation_figures: %s\n", error.what());
    return 3;
  }
}
