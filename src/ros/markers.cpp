#include "cosserat_cable/ros/markers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

enum Id { kTube, kClamps, kContactPoints, kContactForces, kName };

constexpr double kClampAxisLength = 3;  // in cable diameters
constexpr double kLineWidth = 0.15;     // in cable diameters
constexpr double kTextHeight = 0.01;    // [m], the same for thin cables: it is there to be read

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

// Curvature at s: elements' values sit at their middles, with straight lines between them.
double CurvatureAt(const std::vector<double>& curvatures, double length, double s) {
  const double u = s / length * static_cast<double>(curvatures.size()) - 0.5;
  const double last = static_cast<double>(curvatures.size()) - 1;
  const double clamped = std::clamp(u, 0.0, last);
  const auto i = static_cast<std::size_t>(clamped);
  const std::size_t j = std::min(i + 1, curvatures.size() - 1);
  const double t = clamped - static_cast<double>(i);
  return (1 - t) * curvatures[i] + t * curvatures[j];
}

Marker MakeTube(const CableSimulation& cable, const Pose& X_RW, std::int64_t time,
                const MarkerStyle& style) {
  const CableModel& model = cable.model();
  Marker tube = NewMarker(model, time, kTube, Marker::TRIANGLE_LIST);
  const std::vector<Pose>& nodes = cable.nodes();
  const std::vector<double> curvatures = cable.curvatures();
  const double scale = style.curvature_scale > 0 ? style.curvature_scale : 1 / (5 * model.diameter);

  const auto rings = static_cast<std::size_t>(style.rings);
  const auto sides = static_cast<std::size_t>(style.sides);
  std::vector<geometry_msgs::Point> points(rings * sides);
  std::vector<std_msgs::ColorRGBA> colors(rings);
  std::vector<Eigen::Vector3d> rim(sides);
  for (std::size_t j = 0; j < sides; ++j) {
    const double angle = 2 * M_PI * static_cast<double>(j) / static_cast<double>(sides);
    rim[j] = model.diameter / 2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  for (std::size_t i = 0; i < rings; ++i) {
    const double s = model.length * static_cast<double>(i) / static_cast<double>(rings - 1);
    const Pose X_RS = X_RW * InterpolateNodes(nodes, model.length, s);
    colors[i] = Color(ViridisColor(CurvatureAt(curvatures, model.length, s) / scale));
    const Eigen::Matrix3d R_RS = X_RS.q.toRotationMatrix();
    for (std::size_t j = 0; j < sides; ++j) points[i * sides + j] = ToPoint(X_RS.p + R_RS * rim[j]);
  }
  tube.points.resize(6 * (rings - 1) * sides);
  tube.colors.resize(tube.points.size());
  std::size_t corner = 0;
  const auto add = [&](std::size_t ring, std::size_t side) {
    tube.points[corner] = points[ring * sides + side];
    tube.colors[corner++] = colors[ring];
  };
  for (std::size_t i = 0; i + 1 < rings; ++i) {
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
  const Pose apex = InterpolateNodes(cable.nodes(), model.length, model.apex_s);
  text.pose.position = ToPoint(X_RW * apex.p);
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

Pose InterpolateNodes(const std::vector<Pose>& nodes, double length, double s) {
  const double h = length / static_cast<double>(nodes.size() - 1);
  const double u = std::clamp(s / h, 0.0, static_cast<double>(nodes.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(u), nodes.size() - 2);
  const double t = u - static_cast<double>(i);
  const Pose& A = nodes[i];
  const Pose& B = nodes[i + 1];
  const double t2 = t * t, t3 = t2 * t;
  const Eigen::Vector3d a3 = h * (A.q * Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d b3 = h * (B.q * Eigen::Vector3d::UnitZ());
  Pose pose;
  pose.p = (2 * t3 - 3 * t2 + 1) * A.p + (t3 - 2 * t2 + t) * a3 + (3 * t2 - 2 * t3) * B.p +
           (t3 - t2) * b3;
  pose.q = A.q.slerp(t, B.q);
  return pose;
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
