#include "mesh_cleanup.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

namespace cosserat_cable {
namespace {

double WeldTolerance(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    largest = std::max(largest, v.cwiseAbs().maxCoeff());
  }
  return 4.0 * std::numeric_limits<float>::epsilon() * largest;
}

// Finds an earlier vertex within the tolerance through a grid of cells much wider than it, so that
// mostly one cell, and never more than eight, must be searched.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance), cell_(16 * tolerance) {}

  int IndexOf(const Eigen::Vector3d& v) {
    if (tolerance_ == 0) return AddOrFind(v, Cell{0, 0, 0});  // all vertices are the origin
    const Cell low = CellOf(v.array() - tolerance_), high = CellOf(v.array() + tolerance_);
    for (auto x = low[0]; x <= high[0]; ++x) {
      for (auto y = low[1]; y <= high[1]; ++y) {
        for (auto z = low[2]; z <= high[2]; ++z) {
          const int found = Find(v, {x, y, z});
          if (found >= 0) return found;
        }
      }
    }
    return AddOrFind(v, CellOf(v));
  }

  std::vector<Eigen::Vector3d> vertices;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      return static_cast<std::size_t>(c[0]) * 73856093u ^
             static_cast<std::size_t>(c[1]) * 19349663u ^
             static_cast<std::size_t>(c[2]) * 83492791u;
    }
  };

  Cell CellOf(const Eigen::Array3d& v) const {
    const Eigen::Array3d scaled = (v / cell_).floor();
    return {static_cast<std::int64_t>(scaled[0]), static_cast<std::int64_t>(scaled[1]),
            static_cast<std::int64_t>(scaled[2])};
  }

  int Find(const Eigen::Vector3d& v, const Cell& cell) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return -1;
    for (int i = found->second.first; i >= 0; i = next_[i]) {
      if ((vertices[i] - v).cwiseAbs().maxCoeff() <= tolerance_) return i;
    }
    return -1;
  }

  int AddOrFind(const Eigen::Vector3d& v, const Cell& cell) {
    const int found = Find(v, cell);
    if (found >= 0) return found;
    const int added = static_cast<int>(vertices.size());
    vertices.push_back(v);
    next_.push_back(-1);
    const auto [entry, is_new] = cells_.emplace(cell, Chain{added, added});
    if (!is_new) next_[std::exchange(entry->second.last, added)] = added;
    return added;
  }

  /// The vertices of a cell, in the order in which they came.
  struct Chain {
    int first, last;
  };

  double tolerance_, cell_;
  std::unordered_map<Cell, Chain, Hash> cells_;
  std::vector<int> next_;  // of a vertex in its cell; -1: none
};

bool RepeatsAVertex(const Eigen::Vector3i& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// Removes triangles without height, and splits the neighbour along the longest edge of each.
class SliverRemover {
 public:
  SliverRemover(const std::vector<Eigen::Vector3d>& vertices, double least_height)
      : vertices_(vertices), least_height_(least_height) {}

  void Add(const Eigen::Vector3i& triangle) {
    if (!RepeatsAVertex(triangle)) triangles_.push_back(triangle);
  }

  std::vector<Eigen::Vector3i> Finish() {
    std::vector<int> suspects;
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      if (SliverCorner(triangles_[i]) >= 0) suspects.push_back(static_cast<int>(i));
    if (suspects.empty()) return triangles_;
    for (std::size_t i = 0; i < triangles_.size(); ++i) SetEdges(static_cast<int>(i));
    // Each removal merges one edge; the bound only keeps a tangle of slivers from going in circles.
    std::size_t left = 4 * triangles_.size() + 16;
    while (!suspects.empty()) {
      const int i = suspects.back();
      suspects.pop_back();
      const int corner = SliverCorner(triangles_[i]);
      if (corner < 0) continue;
      const Eigen::Vector3i sliver = triangles_[i];
      triangles_[i].setConstant(-1);
      const int b = sliver[corner], c = sliver[(corner + 1) % 3], a = sliver[(corner + 2) % 3];
      // The sliver runs a, b, c with b within the edge c-a; the neighbour runs a, c, d.
      const auto across = edges_.find({a, c});
      if (across == edges_.end() || left == 0) continue;
      --left;
      const int j = across->second;
      if (!RunsAlong(triangles_[j], a, c)) continue;
      const int d = triangles_[j].sum() - a - c;
      if (d == b) {  // two slivers back to back: nothing is left of either
        triangles_[j].setConstant(-1);
        continue;
      }
      triangles_[j] = {a, b, d};
      triangles_[i] = {b, c, d};
      SetEdges(i);
      SetEdges(j);
      suspects.push_back(i);
      suspects.push_back(j);
    }
    std::vector<Eigen::Vector3i> kept;
    for (const Eigen::Vector3i& t : triangles_) {
      if (t[0] >= 0) kept.push_back(t);
    }
    return kept;
  }

 private:
  void SetEdges(int i) {
    for (int k = 0; k < 3; ++k) edges_[{triangles_[i][k], triangles_[i][(k + 1) % 3]}] = i;
  }

  // Entries of `edges_` outlive the triangles that made them.
  static bool RunsAlong(const Eigen::Vector3i& t, int from, int to) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] == from && t[(k + 1) % 3] == to) return true;
    }
    return false;
  }

  // The corner opposite to the longest edge, if the triangle has no height over that edge; else -1.
  int SliverCorner(const Eigen::Vector3i& t) const {
    if (t[0] < 0) return -1;
    int longest = 0;
    double length = -1;
    for (int k = 0; k < 3; ++k) {
      const double edge = (vertices_[t[(k + 1) % 3]] - vertices_[t[(k + 2) % 3]]).norm();
      if (edge > length) {
        length = edge;
        longest = k;
      }
    }
    const Eigen::Vector3d& v = vertices_[t[0]];
    const double twice_area = (vertices_[t[1]] - v).cross(vertices_[t[2]] - v).norm();
    return twice_area <= least_height_ * length ? longest : -1;
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  double least_height_;
  std::vector<Eigen::Vector3i> triangles_;
  std::map<std::pair<int, int>, int> edges_;
};

TriangleMesh WithoutUnusedVertices(const std::vector<Eigen::Vector3d>& vertices,
                                   std::vector<Eigen::Vector3i> triangles) {
  TriangleMesh result;
  std::vector<int> renamed(vertices.size(), -1);
  for (Eigen::Vector3i& t : triangles) {
    for (int& i : t) {
      if (renamed[i] < 0) {
        renamed[i] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(vertices[i]);
      }
      i = renamed[i];
    }
  }
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace

TriangleMesh CleanMesh(const TriangleMesh& mesh) {
  const double tolerance = WeldTolerance(mesh);
  Welder welder(tolerance);
  std::vector<int> welded;
  welded.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices) welded.push_back(welder.IndexOf(v));

  SliverRemover remover(welder.vertices, tolerance);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    remover.Add({welded[t[0]], welded[t[1]], welded[t[2]]});
  }
  return WithoutUnusedVertices(welder.vertices, remover.Finish());
}

}  // namespace cosserat_cable
