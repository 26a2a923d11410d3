// A measurement set on disk that lives as long as a test, and what reading it says.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

class SetFolder {
 public:
  SetFolder() {
    if (!mkdtemp(&path_[0])) throw std::runtime_error("cannot create " + path_);
  }
  ~SetFolder() { std::filesystem::remove_all(path_); }
  SetFolder(const SetFolder&) = delete;
  SetFolder& operator=(const SetFolder&) = delete;

  const std::string& path() const { return path_; }

  SetFolder& Write(const std::string& name, const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return *this;
  }

  /// One line a problem, with the folder left out.
  std::string Anonymous(const Problems& problems) const {
    std::string said = problems.ToString();
    for (std::size_t at = said.find(path_ + "/"); at != std::string::npos;
         at = said.find(path_ + "/")) {
      said.erase(at, path_.size() + 1);
    }
    return said;
  }

  /// What reading the set says.
  std::string Said() const {
    Problems problems;
    LoadMeasurementSet(path_, &problems);
    return Anonymous(problems);
  }

  MeasurementSet LoadGood() const {
    Problems problems;
    const MeasurementSet set = LoadMeasurementSet(path_, &problems);
    EXPECT_EQ(Anonymous(problems), "");
    return set;
  }

 private:
  std::string path_ = "/tmp/cosserat_cable_set_XXXXXX";
};

inline std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// ---- Good sets, one of each kind ----------------------------------------------------------------

// Lines 1 to 10.
inline const char* const kHead =
    "format: 1\n"
    "cable:\n"
    "  length: 0.200\n"
    "  diameter: 0.008\n"
    "  mass_per_length: 0.090\n"
    "  EI: 0.0120\n"
    "  GJ: 0.0090\n"
    "  eta_EI: 2.0e-4\n"
    "  eta_GJ: null\n"
    "experiments:\n";

// Lines 11 to 20: a tip pulled aside and let go.
inline const char* const kRingdown =
    "  - name: ringdown_small\n"
    "    kind: ringdown\n"
    "    specimen: {length: 0.250}\n"
    "    a: {pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "    b: free\n"
    "    start: {held: {s: 0.250, position: [0.01, 0, 0.249]}}\n"
    "    record: ringdown_small.csv\n"
    "    channels:\n"
    "      - {column: tip_x, s: 0.250, quantity: position, axis: x, sigma: 5.0e-5}\n"
    "      - {column: tip_z, s: 0.250, quantity: position, axis: z, offset: unknown}\n";
inline const char* const kRingdownCsv =
    "t,tip_x,tip_z\n"
    "0,0.0100,0.2490\n"
    "0.01,0.0071,0.2495\n"
    "0.02,0.0011,0.2500\n"
    "0.035,-0.0052,0.2496\n";

// A disc at the end, twisted and let go.
inline const char* const kTorsion =
    "  - name: pendulum\n"
    "    a: {pose: [0, 0, 1, 1, 0, 0, 0]}\n"
    "    b: {disc: {inertia: 1.2e-4, mass: 0.15, guided: true}}\n"
    "    start: {twisted: 1.2}\n"
    "    record: torsion/pendulum.csv\n"
    "    channels:\n"
    "      - {column: phi, s: 0.2, quantity: angle}\n"
    "      - {column: phi_dot, s: 0.2, quantity: rate}\n";
inline const char* const kTorsionCsv =
    "t,phi_dot,phi\n"
    "5,0,1.2\n"
    "5.1,-3,1.0\n";

// An arch between two clamps; a shakes.
inline const char* const kArch =
    "  - name: arch\n"
    "    gravity: [0, -9.81, 0]\n"
    "    a: {motion: shaker.csv}\n"
    "    b: {motion: shaker.csv, roll: unknown}\n"
    "    start: {rest: true, near: {s: 0.1, position: [0, 0.05, 0.05]}}\n"
    "    load: pull.csv\n"
    "    record: arch.csv\n"
    "    channels:\n"
    "      - {column: apex, s: 0.1, quantity: acceleration, axis: y, frame: a}\n"
    "      - {column: torque, clamp: a, quantity: moment, axis: x}\n";
inline const char* const kShakerCsv =
    "t,x,y,z,qx,qy,qz,qw\n"
    "0,0,0,0,0,0,0,1\n"
    "0.5,0.001,0,0,0,0,0,1\n"
    "1,0,0,0,0,0,0.6,0.8\n";
inline const char* const kPullCsv =
    "t,s,fx,fy,fz\n"
    "0,0.05,0,0,1\n"
    "0,0.15,0,0,2\n"
    "1,0.05,0,0,0\n";
inline const char* const kArchCsv =
    "t,apex,torque\n"
    "0.1,1.5,0.01\n"
    "0.2,-1.25e-1,0.02\n";

// A support that is lifted step by step under a load.
inline const char* const kSteps =
    "  - name: steps\n"
    "    a: {pose: [0, 0, 0, 0.5, 0.5, 0.5, 0.5]}\n"
    "    b: {motion: support.csv, free: [tz, rx, ry, rz]}\n"
    "    start: {rest: true}\n"
    "    load: [{s: 0.1, force: [0, 0, -0.5]}]\n"
    "    record: steps.csv\n"
    "    channels:\n"
    "      - {column: force, clamp: b, quantity: force, axis: z, frame: a}\n";
inline const char* const kSupportCsv =
    "step,x,y,z,qx,qy,qz,qw\n"
    "0,0.2,0,0.0001,0.5,0.5,0.5,0.5\n"
    "1,0.2,0,0.0002,0.5,0.5,0.5,0.5\n";
inline const char* const kStepsCsv =
    "step,force\n"
    "0,0.006\n"
    "1,0.033\n"
    "2,0.041\n";

// A cable that swings already.
inline const char* const kSwinging =
    "  - name: swinging\n"
    "    a: {pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "    b: free\n"
    "    start: {unknown: true}\n"
    "    record: swinging.csv\n"
    "    channels:\n"
    "      - {column: v, s: 0.2, quantity: velocity, axis: x}\n";
inline const char* const kSwingingCsv =
    "t,v\n"
    "0,0.1\n"
    "0.1,0.2\n";

/// The folder with the files of all of them and this set.
inline void WriteAll(SetFolder* folder, const std::string& text) {
  folder->Write("measurement.yaml", text)
      .Write("ringdown_small.csv", kRingdownCsv)
      .Write("torsion/pendulum.csv", kTorsionCsv)
      .Write("shaker.csv", kShakerCsv)
      .Write("pull.csv", kPullCsv)
      .Write("arch.csv", kArchCsv)
      .Write("support.csv", kSupportCsv)
      .Write("steps.csv", kStepsCsv)
      .Write("swinging.csv", kSwingingCsv);
}
inline std::string AllSets() {
  return std::string(kHead) + kRingdown + kTorsion + kArch + kSteps + kSwinging;
}

}  // namespace cosserat_cable
