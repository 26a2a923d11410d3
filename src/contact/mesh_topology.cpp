#include "mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace cosserat_cable {
namespace {

// A closed part thinner than this, relative to its extent, is a sheet drawn twice: it has no
// inside.
constexpr double kLeastThickness = 1e-6;

struct Edge {
  int low, high;  // vertices
  int triangle, side;
  bool rising;  // the triangle runs from low to high
};

template <typename Visit>
void ForEachEdge(const std::vector<Eigen::Vector3i>& triangles, Visit visit) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[i][k], to = triangles[i][(k + 1) % 3];
      visit(Edge{std::min(from, to), std::max(from, to), static_cast<int>(i), k, from < to});
    }
  }
}

// All edges of a mesh with so many vertices, those between the same two next to each other.
std::vector<Edge> SortedEdges(const TriangleMesh& mesh) {
  // By their lower vertex first, which has few: counted, then put in place.
  std::vector<std::size_t> begin(mesh.vertices.size() + 1, 0);
  ForEachEdge(mesh.triangles,
              [&](const Edge& edge) { ++begin[static_cast<std::size_t>(edge.low) + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Edge> edges(3 * mesh.triangles.size());
  std::vector<std::size_t> next = begin;
  ForEachEdge(mesh.triangles,
              [&](const Edge& edge) { edges[next[static_cast<std::size_t>(edge.low)]++] = edge; });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(begin[v]);
    const auto last = edges.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
    std::sort(first, last, [](const Edge& a, const Edge& b) {
      return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
    });
  }
  return edges;
}

// Calls visit(first, last) for the run of edges between each two vertices.
template <typename Visit>
void ForEachRun(const std::vector<Edge>& edges, Visit visit) {
  for (auto first = edges.begin(); first != edges.end();) {
    auto last = std::find_if(first, edges.end(), [&](const Edge& e) {
      return e.low != first->low || e.high != first->high;
    });
    visit(first, last);
    first = last;
  }
}

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(int i, int j) { parent_[Root(i)] = Root(j); }

 private:
  std::vector<int> parent_;
};

// Some of the triangles with their vertices. `names`: -1 for each of the mesh's vertices, and so
// again afterwards.
TriangleMesh Extract(const TriangleMesh& mesh, const std::vector<int>& triangles,
                     std::vector<int>* names) {
  TriangleMesh part;
  std::vector<int> used;
  for (int i : triangles) {
    Eigen::Vector3i t = mesh.triangles[i];
    for (int& v : t) {
      int& name = (*names)[v];
      if (name < 0) {
        name = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
        used.push_back(v);
      }
      v = name;
    }
    part.triangles.push_back(t);
  }
  for (int v : used) (*names)[v] = -1;
  return part;
}

double Volume(const TriangleMesh& mesh) {
  // Relative to a vertex of its own, lest a part far from the origin lose its volume in rounding.
  const Eigen::Vector3d& origin = mesh.vertices.front();
  double six_volumes = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    six_volumes += (mesh.vertices[t[0]] - origin)
                       .dot((mesh.vertices[t[1]] - origin).cross(mesh.vertices[t[2]] - origin));
  }
  return six_volumes / 6;
}

double Area(const TriangleMesh& mesh) {
  double twice_area = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    twice_area += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return twice_area / 2;
}

double CornerAngle(const TriangleMesh& mesh, const Eigen::Vector3i& t, int k) {
  const Eigen::Vector3d& a = mesh.vertices[t[k]];
  const Eigen::Vector3d ab = mesh.vertices[t[(k + 1) % 3]] - a;
  const Eigen::Vector3d ac = mesh.vertices[t[(k + 2) % 3]] - a;
  return std::atan2(ab.cross(ac).norm(), ab.dot(ac));
}

// Directions only matter by their sign, except where they cancel out: those stay zero.
Eigen::Vector3d NormalizedOrZero(const Eigen::Vector3d& v) {
  constexpr double kCancelled = 1e-9;
  const double norm = v.norm();
  return norm > kCancelled ? Eigen::Vector3d(v / norm) : Eigen::Vector3d::Zero();
}

OrientedMesh Orient(TriangleMesh mesh, bool closed) {
  OrientedMesh result;
  if (closed) {
    const double volume = Volume(mesh), area = Area(mesh);
    if (std::abs(volume) < kLeastThickness * area * std::sqrt(area)) {
      closed = false;
    } else if (volume < 0) {
      for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
    }
  }
  result.closed = closed;
  result.faces.resize(mesh.triangles.size());
  result.corner_normals.assign(mesh.vertices.size(), Eigen::Vector3d::Zero());
  result.corner_is_rim.assign(mesh.vertices.size(), false);

  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    Eigen::Vector3d& normal = result.faces[i].normal;
    normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
    for (int k = 0; k < 3; ++k) {
      result.corner_normals[t[k]] += CornerAngle(mesh, t, k) * normal;
    }
  }
  for (Eigen::Vector3d& normal : result.corner_normals) normal = NormalizedOrZero(normal);

  ForEachRun(SortedEdges(mesh), [&](auto first, auto last) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto e = first; e != last; ++e) sum += result.faces[e->triangle].normal;
    sum = NormalizedOrZero(sum);
    const bool folded_flat =
        last - first == 2 && first->rising != (first + 1)->rising && sum == Eigen::Vector3d::Zero();
    const bool rim = !closed && (last - first == 1 || folded_flat);
    for (auto e = first; e != last; ++e) {
      result.faces[e->triangle].edge_normals[e->side] = sum;
      result.faces[e->triangle].edge_is_rim[e->side] = rim;
    }
    if (rim) result.corner_is_rim[first->low] = result.corner_is_rim[first->high] = true;
  });
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace

const Eigen::Vector3d& OrientedMesh::Normal(int triangle, Feature feature) const {
  switch (feature) {
    case Feature::kEdge0:
    case Feature::kEdge1:
    case Feature::kEdge2:
      return faces[triangle]
          .edge_normals[static_cast<int>(feature) - static_cast<int>(Feature::kEdge0)];
    case Feature::kCorner0:
    case Feature::kCorner1:
    case Feature::kCorner2:
      return corner_normals[mesh.triangles[triangle][static_cast<int>(feature) -
                                                     static_cast<int>(Feature::kCorner0)]];
    case Feature::kFace:
      break;
  }
  return faces[triangle].normal;
}

bool OrientedMesh::IsRim(int triangle, Feature feature) const {
  if (feature == Feature::kFace) return false;
  if (feature >= Feature::kCorner0) {
    return corner_is_rim[mesh.triangles[triangle][static_cast<int>(feature) -
                                                  static_cast<int>(Feature::kCorner0)]];
  }
  return faces[triangle].edge_is_rim[static_cast<int>(feature) - static_cast<int>(Feature::kEdge0)];
}

std::vector<OrientedMesh> SplitIntoParts(const TriangleMesh& mesh) {
  const std::vector<Edge> edges = SortedEdges(mesh);
  UnionFind connected(mesh.triangles.size());
  std::vector<bool> watertight(mesh.triangles.size(), true);
  ForEachRun(edges, [&](auto first, auto last) {
    const bool matched = last - first == 2 && first->rising != (first + 1)->rising;
    for (auto e = first; e != last; ++e) {
      connected.Join(e->triangle, first->triangle);
      if (!matched) watertight[e->triangle] = false;
    }
  });

  // In the order of their first triangles in the file.
  std::vector<int> part_of_root(mesh.triangles.size(), -1);
  std::vector<std::vector<int>> members;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    int& part = part_of_root[connected.Root(static_cast<int>(i))];
    if (part < 0) {
      part = static_cast<int>(members.size());
      members.emplace_back();
    }
    members[part].push_back(static_cast<int>(i));
  }

  std::vector<OrientedMesh> parts;
  std::vector<int> open, names(mesh.vertices.size(), -1);
  for (const std::vector<int>& part : members) {
    if (std::all_of(part.begin(), part.end(), [&](int i) { return watertight[i]; })) {
      OrientedMesh oriented = Orient(Extract(mesh, part, &names), true);
      if (oriented.closed) {
        parts.push_back(std::move(oriented));
        continue;
      }
    }
    open.insert(open.end(), part.begin(), part.end());
  }
  if (!open.empty()) {
    std::sort(open.begin(), open.end());
    parts.push_back(Orient(Extract(mesh, open, &names), false));
  }
  return parts;
}

}  // namespace cosserat_cable
