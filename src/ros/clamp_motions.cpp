#include "cosserat_cable/ros/clamp_motions.h"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "clamp_survey.h"
#include "cosserat_cable/console/output_file.h"

namespace cosserat_cable {
namespace {

/// A line of a motion file. Nanoseconds as they are: a double of seconds since 1970 has no room for
/// them.
std::string Row(std::int64_t time, const Pose& X) {
  char text[256];
  std::snprintf(text, sizeof text, "%lld.%09lld,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                static_cast<long long>(time / 1'000'000'000),
                static_cast<long long>(time % 1'000'000'000), X.p.x(), X.p.y(), X.p.z(), X.q.x(),
                X.q.y(), X.q.z(), X.q.w());
  return text;
}

struct MotionFile {
  std::string text = "t,x,y,z,qx,qy,qz,qw\n";
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();

  /// q and -q are one rotation: neighbours have the sign that makes them neighbours.
  void Add(std::int64_t time, Pose X) {
    if (X.q.dot(last) < 0) X.q.coeffs() = -X.q.coeffs();
    last = X.q;
    text += Row(time, X);
  }
};

}  // namespace

std::vector<std::string> ClampMotionFiles(const Inputs& inputs) {
  std::vector<std::string> files;
  for (const CableModel& cable : inputs.cables.cables)
    for (const char* clamp : {"_a.csv", "_b.csv"}) files.push_back(cable.name + clamp);
  return files;
}

void WriteClampMotions(const Inputs& inputs, const EngineOptions& options,
                       const std::string& folder) {
  const std::vector<CableModel>& cables = inputs.cables.cables;
  EngineOptions followed = options;
  followed.links.world_frame = inputs.survey->world;
  std::vector<MotionFile> a(cables.size()), b(cables.size());
  FollowClamps(*inputs.bags, inputs.survey->from, inputs.survey->to, inputs.vehicle, cables,
               followed,
               [&](std::size_t cable, std::int64_t time, const Pose& X_WA, const Pose& X_WB) {
                 a[cable].Add(time, X_WA);
                 b[cable].Add(time, X_WB);
               });
  const std::filesystem::path to(folder);
  std::filesystem::create_directories(to);
  for (std::size_t c = 0; c < cables.size(); ++c) {
    WriteWhole((to / (cables[c].name + "_a.csv")).string(), a[c].text);
    WriteWhole((to / (cables[c].name + "_b.csv")).string(), b[c].text);
  }
}

}  // namespace cosserat_cable
