// Meshes with known shapes, and a reference for distances that shares nothing with the code under
// test.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {
namespace test {

/// Closed, facing outward, two triangles per side, centred [m].
inline TriangleMesh BoxMesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        Eigen::Vector3d(i & 1 ? .5 : -.5, i & 2 ? .5 : -.5, i & 4 ? .5 : -.5).cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Closed, facing outward: an inscribed polyhedron of `rings` x `sectors` facets.
inline TriangleMesh SphereMesh(double radius, int rings, int sectors) {
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, radius});
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const double polar = M_PI * i / rings, azimuth = 2 * M_PI * j / sectors;
      mesh.vertices.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                                       std::sin(polar) * std::sin(azimuth),
                                                       std::cos(polar)));
    }
  }
  mesh.vertices.push_back({0, 0, -radius});
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * sectors + j % sectors; };
  for (int j = 0; j < sectors; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({south, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// Open: a rectangle in the plane z = 0, `n` x `n` cells, facing +z, centred [m].
inline TriangleMesh SheetMesh(double size_x, double size_y, int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      mesh.vertices.push_back({size_x * (double(i) / n - .5), size_y * (double(j) / n - .5), 0});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

/// A star-like closed body with ridges and valleys: a sphere whose radius swings between 0.4
/// and 1.6 of `radius`.
inline TriangleMesh UrchinMesh(double radius, int rings, int sectors) {
  TriangleMesh mesh = SphereMesh(radius, rings, sectors);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertices[i] *= i % 2 ? 1.6 : 0.4;
  return mesh;
}

inline TriangleMesh Moved(TriangleMesh mesh, const Pose& X) {
  for (Eigen::Vector3d& v : mesh.vertices) v = X * v;
  return mesh;
}

inline TriangleMesh Joined(TriangleMesh a, const TriangleMesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Eigen::Vector3i& t : b.triangles) {
    a.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  return a;
}

inline Pose SomePose() {
  return {{0.3, -0.2, 0.5}, Eigen::Quaterniond(0.5, -0.1, 0.7, 0.4).normalized()};
}

inline Shape MakeShape(const Pose& X_LS, decltype(Shape::geometry) geometry) {
  Shape shape;
  shape.X_LS = X_LS;
  shape.geometry = std::move(geometry);
  return shape;
}

inline Body MakeBody(decltype(Shape::geometry) geometry, const Pose& X_LS = {}) {
  std::vector<Shape> shapes;
  shapes.push_back(MakeShape(X_LS, std::move(geometry)));
  return Body(shapes);
}

inline double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
  const double t = (p - a).dot(b - a) / (b - a).squaredNorm();
  return (p - a - std::min(1.0, std::max(0.0, t)) * (b - a)).norm();
}

/// By the plane where the foot is within the triangle, else by the three edges: all triangles are
/// tried.
inline double BruteForceDistance(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    const bool over_face = n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
                           n.dot((a - c).cross(p - c)) >= 0;
    if (over_face) best = std::min(best, std::abs(n.dot(p - a)));
    best = std::min(
        {best, DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a)});
  }
  return best;
}

/// The winding number of a closed mesh around p, from solid angles (Van Oosterom and Strackee
/// 1983).
inline double WindingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double solid_angle = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                          c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)),
                                  la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle / (4 * M_PI);
}

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : generator_(seed) {}
  double In(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Eigen::Vector3d InCube(double half) {
    return {In(-half, half), In(-half, half), In(-half, half)};
  }
  Eigen::Vector3d Direction() {
    Eigen::Vector3d v;
    do v = InCube(1);
    while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
    return v.normalized();
  }

 private:
  std::mt19937 generator_;
};

}  // namespace test
}  // namespace cosserat_cable
