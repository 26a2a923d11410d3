// The smallest distance to a cable's bodies, against trying every site and every triangle.
#include "../../src/cable/nearest_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cable/cable_cases.h"
#include "contact/meshes.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kReach = 0.15;       // [m]
constexpr double kRounding = 1e-12;   // [m], of positions of about a metre
constexpr double kSpinRate = 45;      // [rad/s], a wheel's at 50 km/h
constexpr double kReportStep = 5e-3;  // [s]

CableModel Cable() { return RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4); }

/// Closed with valleys, closed with flat sides, and open.
std::vector<TriangleMesh> Meshes() {
  return {test::UrchinMesh(0.08, 8, 10), test::BoxMesh({0.05, 0.1, 0.15}),
          test::SheetMesh(0.2, 0.15, 3)};
}
constexpr std::size_t kClosedMeshes = 2;

class Scene {
 public:
  Scene() : meshes_(Meshes()), sites_(PlaceContactSites(Cable())) {
    for (const TriangleMesh& mesh : meshes_) bodies_.push_back(test::MakeBody(mesh));
    motions.resize(bodies_.size());
    nodes.resize(static_cast<std::size_t>(Cable().elements) + 1);
  }
  NearestBody Make() const {
    std::vector<const Body*> bodies;
    for (const Body& body : bodies_) bodies.push_back(&body);
    return {sites_, bodies, kReach};
  }

  /// A bow of the cable's length from `start` on, in the plane of two random directions.
  void Bow(const Vector3d& start, const Vector3d& along, const Vector3d& aside, double turn) {
    const double h = Cable().length / Cable().elements;
    nodes.front() = start;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const double angle = turn * static_cast<double>(i) / static_cast<double>(nodes.size());
      nodes[i] = nodes[i - 1] + h * (std::cos(angle) * along + std::sin(angle) * aside);
    }
  }

  double BruteForce() const {
    double nearest = kInfinity;
    for (std::size_t b = 0; b < meshes_.size(); ++b)
      for (const ContactSite& site : sites_) {
        const auto e = static_cast<std::size_t>(site.element);
        const Vector3d p_W = (1 - site.xi) * nodes[e] + site.xi * nodes[e + 1];
        const Vector3d p = motions[b].X.Inverse() * p_W;
        const double distance = test::BruteForceDistance(meshes_[b], p);
        const bool inside = b < kClosedMeshes && std::abs(test::WindingNumber(meshes_[b], p)) > 0.5;
        nearest = std::min(nearest, inside ? -distance : distance);
      }
    return nearest < kReach ? nearest : kInfinity;
  }
  void ExpectAgreement(NearestBody* tested) const {
    const double expected = BruteForce();
    const double found = tested->Distance(Pose(), nodes, motions);
    if (std::isinf(expected)) {
      EXPECT_EQ(found, expected);
    } else {
      EXPECT_NEAR(found, expected, kRounding);
    }
  }

  std::vector<Vector3d> nodes;  // in W
  std::vector<Motion> motions;  // of the bodies

 private:
  std::vector<TriangleMesh> meshes_;
  std::vector<Body> bodies_;
  std::vector<ContactSite> sites_;
};

TEST(NearestBodyTest, AgreesWithBruteForceWhereverThingsJump) {
  test::RandomPoints random(71);
  Scene scene;
  NearestBody tested = scene.Make();
  int within = 0, beyond = 0;
  for (int k = 0; k < 120; ++k) {
    const Vector3d along = random.Direction();
    scene.Bow(random.InCube(0.3), along, along.unitOrthogonal(), random.In(-3, 3));
    for (Motion& motion : scene.motions)
      motion.X = {random.InCube(0.3),
                  Eigen::Quaterniond(Eigen::AngleAxisd(random.In(0, 3), random.Direction()))};
    scene.ExpectAgreement(&tested);
    (std::isinf(scene.BruteForce()) ? beyond : within) += 1;
  }
  EXPECT_GT(within, 40);
  EXPECT_GT(beyond, 5);
}

TEST(NearestBodyTest, AgreesWithBruteForceAlongAMotion) {
  Scene scene;
  NearestBody tested = scene.Make();
  // A cable that sways beside a spinning body, a box that passes by, and a sheet that comes near.
  for (int k = 0; k < 150; ++k) {
    const double t = kReportStep * k;
    scene.Bow({0.2 + 0.03 * std::sin(40 * t), 0, -0.15}, Vector3d::UnitZ(), Vector3d::UnitX(),
              0.5 + 0.3 * std::sin(25 * t));
    scene.motions[0].X.q = Eigen::AngleAxisd(kSpinRate * t, Vector3d::UnitY());
    scene.motions[1].X.p = {0.4, -0.5 + 1.5 * t, 0};
    scene.motions[2].X = {{0.25, -0.3 + 0.35 * t, 0.05},
                          Eigen::Quaterniond(Eigen::AngleAxisd(0.8 * t, Vector3d::UnitX()))};
    scene.ExpectAgreement(&tested);
  }
}

}  // namespace
}  // namespace cosserat_cable
