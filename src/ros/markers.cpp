#include "cosserat_cable/ros/markers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cosserat_cable/rod/element_curve.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

enum Id { kTube, kClamps, kContactPoints, kContactForces, kName };

constexpr double kClampAxisLength = 3;  // in cable diameters
constexpr double kLineWidth = 0.15;     // in cable diameters
constexpr double kTextHeight = 0.01;    // [m], the same for thin cables: it is there to be read

// Curves and colours are resolved along a cable at least so finely.
constexpr std::size_t kMinSegments = 40;
// Of a colour on the map from its true place, which is [0, 1] long: not to be seen.
constexpr double kColorDeviation = 0.03;

std_msgs::ColorRGBA Color(const Eigen::Vector3d& rgb) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(rgb.x());
  color.g = static_cast<float>(rgb.y());
  color.b = static_cast<float>(rgb.z());
  color.a = 1;
  return color;
}

Marker NewMarker(const CableModel& model, std::int64_t time, Id id, int type) {
  Marker marker;
  marker.header.stamp = ToRosTime(time);
  marker.header.frame_id = model.reference;
  marker.ns = model.name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = 1;
  marker.color = Color(Eigen::Vector3d::Ones());
  return marker;
}

// Curvature `u` elements from the start: elements' values sit at their middles, with straight lines
// between them.
double CurvatureAt(const std::vector<double>& curvatures, double u) {
  const double last = static_cast<double>(curvatures.size()) - 1;
  const double clamped = std::clamp(u - 0.5, 0.0, last);
  const auto i = static_cast<std::size_t>(clamped);
  const std::size_t j = std::min(i + 1, curvatures.size() - 1);
  const double t = clamped - static_cast<double>(i);
  return (1 - t) * curvatures[i] + t * curvatures[j];
}

/// A cross-section of the tube.
struct Ring {
  Pose X_WS;
  double color;  // in [0, 1] of the map, or beyond
};

// All that a tube may have: at the nodes, and between them where they are far apart.
std::vector<Ring> AllRings(const CableSimulation& cable, double curvature_scale) {
  const std::vector<double> curvatures = cable.curvatures();
  const std::vector<Pose>& nodes = cable.nodes();
  const std::size_t elements = curvatures.size();
  const std::size_t per_element = (kMinSegments + elements - 1) / elements;
  std::vector<Ring> rings;
  rings.reserve(elements * per_element + 1);
  const auto add = [&](const Pose& X_WS, double u) {
    rings.push_back({X_WS, CurvatureAt(curvatures, u) / curvature_scale});
  };
  for (std::size_t e = 0; e < elements; ++e) {
    const rod::ElementCurve curve(nodes[e], nodes[e + 1]);
    for (std::size_t k = 0; k < per_element; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(per_element);
      add(curve.At(t), static_cast<double>(e) + t);
    }
  }
  add(nodes.back(), static_cast<double>(elements));
  return rings;
}

// Whether a straight piece of tube, and colours in between, may stand for the rings from `first` to
// `last`.
bool AreAlike(const std::vector<Ring>& rings, std::size_t first, std::size_t last, double turn) {
  const Ring& from = rings[first];
  const Eigen::Vector3d along = from.X_WS.q * Eigen::Vector3d::UnitZ();
  const double color_step = (rings[last].color - from.color) / static_cast<double>(last - first);
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (along.dot(rings[i].X_WS.q * Eigen::Vector3d::UnitZ()) < std::cos(turn)) return false;
    const double color = from.color + static_cast<double>(i - first) * color_step;
    if (std::abs(rings[i].color - color) > kColorDeviation) return false;
  }
  return true;
}

// Those of the rings that are needed: straight parts of a cable have few.
std::vector<Ring> NeededRings(const std::vector<Ring>& all, double turn) {
  std::vector<Ring> needed = {all.front()};
  for (std::size_t first = 0, last = 1; first + 1 < all.size(); first = last) {
    last = first + 1;
    while (last + 1 < all.size() && AreAlike(all, first, last + 1, turn)) ++last;
    needed.push_back(all[last]);
  }
  return needed;
}

Marker MakeTube(const CableSimulation& cable, const Pose& X_RW, std::int64_t time,
                const MarkerStyle& style) {
  const CableModel& model = cable.model();
  Marker tube = NewMarker(model, time, kTube, Marker::TRIANGLE_LIST);
  const double scale = style.curvature_scale > 0 ? style.curvature_scale : 1 / (5 * model.diameter);
  const std::vector<Ring> rings = NeededRings(AllRings(cable, scale), style.turn);

  const auto sides = static_cast<std::size_t>(style.sides);
  // The polygon's corners lie as far outside of the circle as the middles of its sides inside.
  const double rim_radius = model.diameter / (1 + std::cos(M_PI / style.sides));
  std::vector<Eigen::Vector3d> rim(sides);
  for (std::size_t j = 0; j < sides; ++j) {
    const double angle = 2 * M_PI * static_cast<double>(j) / static_cast<double>(sides);
    rim[j] = rim_radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  std::vector<geometry_msgs::Point> points;
  std::vector<std_msgs::ColorRGBA> colors;
  for (const Ring& ring : rings) {
    const Pose X_RS = X_RW * ring.X_WS;
    const Eigen::Matrix3d R_RS = X_RS.q.toRotationMatrix();
    for (const Eigen::Vector3d& p_S : rim) points.push_back(ToPoint(X_RS.p + R_RS * p_S));
    colors.push_back(Color(ViridisColor(ring.color)));
  }
  tube.points.reserve(6 * (rings.size() - 1) * sides);
  tube.colors.reserve(tube.points.capacity());
  const auto add = [&](std::size_t ring, std::size_t side) {
    tube.points.push_back(points[ring * sides + side]);
    tube.colors.push_back(colors[ring]);
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t j = 0; j < sides; ++j) {
      const std::size_t next = j + 1 < sides ? j + 1 : 0;
      add(i, j);
      add(i, next);
      add(i + 1, next);
      add(i, j);
      add(i + 1, next);
      add(i + 1, j);
    }
  }
  return tube;
}

Marker MakeClamps(const CableSimulation& cable, const Pose& X_RW, std::int64_t time) {
  const CableModel& model = cable.model();
  Marker lines = NewMarker(model, time, kClamps, Marker::LINE_LIST);
  lines.scale.x = kLineWidth * model.diameter;
  for (const Pose& X_WC : {cable.nodes().front(), cable.nodes().back()}) {
    const Pose X_RC = X_RW * X_WC;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
      lines.points.push_back(ToPoint(X_RC.p));
      lines.points.push_back(
          ToPoint(X_RC * Eigen::Vector3d(kClampAxisLength * model.diameter * unit)));
      lines.colors.insert(lines.colors.end(), 2, Color(unit));
    }
  }
  return lines;
}

void AddContacts(const CableSimulation& cable, const Pose& X_RW, std::int64_t time,
                 const MarkerStyle& style, MarkerArray* markers) {
  const CableModel& model = cable.model();
  Marker spheres = NewMarker(model, time, kContactPoints, Marker::SPHERE_LIST);
  Marker forces = NewMarker(model, time, kContactForces, Marker::LINE_LIST);
  for (const ContactPoint& contact : cable.contacts()) {
    const Eigen::Vector3d tip_W = contact.position_W + style.force_scale * contact.force_W;
    spheres.points.push_back(ToPoint(X_RW * contact.position_W));
    forces.points.push_back(ToPoint(X_RW * contact.position_W));
    forces.points.push_back(ToPoint(X_RW * tip_W));
  }
  spheres.scale.x = spheres.scale.y = spheres.scale.z = 0.5 * model.diameter;
  spheres.color = Color({1, 0.1, 0.1});
  forces.scale.x = kLineWidth * model.diameter;
  forces.color = Color({1, 0.4, 0.1});
  // rviz warns of lists without points.
  if (spheres.points.empty()) spheres.action = forces.action = Marker::DELETE;
  markers->markers.push_back(std::move(spheres));
  markers->markers.push_back(std::move(forces));
}

Marker MakeName(const CableSimulation& cable, const Pose& X_RW, std::int64_t time) {
  const CableModel& model = cable.model();
  Marker text = NewMarker(model, time, kName, Marker::TEXT_VIEW_FACING);
  text.text = model.name;
  text.scale.z = kTextHeight;
  // Dark enough for a light background, light enough for a dark one.
  text.color = Color({0.35, 0.38, 0.45});
  text.pose.position = ToPoint(X_RW * PositionAt(cable, model.apex_s));
  text.pose.position.z += model.diameter + kTextHeight;
  return text;
}

}  // namespace

Eigen::Vector3d ViridisColor(double x) {
  // Nine of the map's 256 samples, at 0, 1/8, ... 1; straight lines between them are within 0.02.
  static constexpr std::array<std::array<double, 3>, 9> kSamples = {{{0.267, 0.005, 0.329},
                                                                     {0.279, 0.175, 0.483},
                                                                     {0.230, 0.322, 0.546},
                                                                     {0.173, 0.449, 0.558},
                                                                     {0.128, 0.567, 0.551},
                                                                     {0.158, 0.684, 0.502},
                                                                     {0.369, 0.789, 0.383},
                                                                     {0.678, 0.864, 0.190},
                                                                     {0.993, 0.906, 0.144}}};
  const double u = std::clamp(x, 0.0, 1.0) * (kSamples.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(u), kSamples.size() - 2);
  const Eigen::Vector3d low(kSamples[i].data());
  const Eigen::Vector3d high(kSamples[i + 1].data());
  return low + (u - static_cast<double>(i)) * (high - low);
}

Eigen::Vector3d PositionAt(const CableSimulation& cable, double s) {
  const int elements = cable.model().elements;
  const double h = cable.model().length / elements;
  const int i = std::clamp(static_cast<int>(s / h), 0, elements - 1);
  return rod::ElementCurve(cable.node(i), cable.node(i + 1)).At(s / h - i).p;
}

MarkerArray MakeMarkers(const CableSimulation& cable, const Pose& X_WR, std::int64_t time,
                        const MarkerStyle& style) {
  const Pose X_RW = X_WR.Inverse();
  MarkerArray markers;
  markers.markers.push_back(MakeTube(cable, X_RW, time, style));
  markers.markers.push_back(MakeClamps(cable, X_RW, time));
  AddContacts(cable, X_RW, time, style, &markers);
  markers.markers.push_back(MakeName(cable, X_RW, time));
  return markers;
}

MarkerArray DeleteMarkers(const CableModel& model, std::int64_t time) {
  MarkerArray markers;
  for (const Id id : {kTube, kClamps, kContactPoints, kContactForces, kName}) {
    Marker marker = NewMarker(model, time, id, Marker::TRIANGLE_LIST);
    marker.action = Marker::DELETE;
    markers.markers.push_back(std::move(marker));
  }
  return markers;
}

}  // namespace cosserat_cable
