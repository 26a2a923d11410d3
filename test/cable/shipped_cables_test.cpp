#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "cable/cable_text.h"
#include "cosserat_cable/cable/contact_stiffness.h"

namespace cosserat_cable {
namespace {

void ExpectSame(const CableModel& a, const CableModel& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.reference, b.reference);
  for (const auto& [x, y] : {std::make_pair(a.a, b.a), std::make_pair(a.b, b.b)}) {
    EXPECT_EQ(x.link, y.link);
    EXPECT_EQ(x.X_LC.p, y.X_LC.p);
    EXPECT_EQ(x.X_LC.q.coeffs(), y.X_LC.q.coeffs());
  }
  for (double CableModel::*number :
       {&CableModel::length, &CableModel::diameter, &CableModel::mass_per_length, &CableModel::EI1,
        &CableModel::EI2, &CableModel::GJ, &CableModel::GA1, &CableModel::GA2, &CableModel::EA,
        &CableModel::eta_EI1, &CableModel::eta_EI2, &CableModel::eta_GJ, &CableModel::eta_GA1,
        &CableModel::eta_GA2, &CableModel::eta_EA, &CableModel::apex_s}) {
    EXPECT_EQ(a.*number, b.*number);
  }
  ASSERT_EQ(a.masses.size(), b.masses.size());
  for (std::size_t i = 0; i < a.masses.size(); ++i) {
    EXPECT_EQ(a.masses[i].s, b.masses[i].s);
    EXPECT_EQ(a.masses[i].mass, b.masses[i].mass);
  }
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.avoid, b.avoid);
  EXPECT_EQ(a.avoid_visual, b.avoid_visual);
  EXPECT_EQ(a.uncertain, b.uncertain);
  ASSERT_EQ(a.extensions.size(), b.extensions.size());
  for (std::size_t i = 0; i < a.extensions.size(); ++i) {
    EXPECT_EQ(a.extensions[i].name, b.extensions[i].name);
    EXPECT_EQ(a.extensions[i].parts, b.extensions[i].parts);
  }
  EXPECT_EQ(a.contact.stiffness, b.contact.stiffness);
  EXPECT_EQ(a.contact.smoothing, b.contact.smoothing);
  EXPECT_EQ(a.contact.damping, b.contact.damping);
}

void ExpectRoundTrip(const CableFile& file) {
  const Loaded back = Load(WriteCableFile(file));
  EXPECT_EQ(back.said, "") << WriteCableFile(file);
  EXPECT_EQ(back.file.specimen, file.specimen);
  ASSERT_EQ(back.file.cables.size(), file.cables.size());
  for (std::size_t i = 0; i < file.cables.size(); ++i)
    ExpectSame(back.file.cables[i], file.cables[i]);
}

TEST(WriteCableFile, ReadsBackToTheSameBits) {
  ExpectRoundTrip(Load(kSpecimen).file);
  const Loaded vehicle = Load(Vehicle(
      "  - name: one\n    type: hose\n    EI1: 0.0123456789012345678\n    EI2: 0.02\n"
      "    length: 0.33333333333333333\n    masses: [{s: 0.1, mass: 0.0007}]\n"
      "    eta_GA1: 0.3\n    eta_GA2: critical\n    uncertain: [EI, GJ]\n"
      "    contact: {smoothing: 3.3e-5}\n    avoid: [\"it's\", {link: 'null', use_visual: true}]\n"
      "    a: {link: 'a: b', pose: [0.1, 0.2, 0.3, 0.18257, 0.36515, 0.54772, 0.7303]}\n"
      "    b: {link: wheel, pose: [0, 0, 0.1, 1, 0, 0, 0]}\n"));
  ASSERT_EQ(vehicle.said, "");
  ExpectRoundTrip(vehicle.file);
}

TEST(WriteCableFile, SaysEveryDefault) {
  const std::string text = WriteCableFile(Load(kSpecimen).file);
  for (const char* key : {"name: ", "EI: 0.012\n", "EA: 3000\n", "GA: 1000\n",
                          "eta_GJ: ", "eta_EA: ", "eta_GA: ", "masses: []", "apex: {s: 0.1}",
                          "elements: 40", "avoid: []", "contact: {stiffness: "}) {
    EXPECT_NE(text.find(key), std::string::npos) << key << " in\n" << text;
  }
}

// ---- The files that are shipped -----------------------------------------------------------------

std::string ShippedPath(const std::string& name) {
  return std::string(COSSERAT_CABLE_SOURCE_DIR) + "/config/cables/" + name;
}

TEST(ShippedCables, AllLoadAndRoundTrip) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ShippedPath(""))) {
    if (entry.path().extension() != ".yaml") continue;
    Problems problems;
    const CableFile file = LoadCableFile(entry.path().string(), &problems);
    EXPECT_EQ(problems.ToString(), "");
    EXPECT_FALSE(file.cables.empty()) << entry.path();
    ExpectRoundTrip(file);
    ++files;
  }
  EXPECT_GE(files, 3);
}

TEST(ShippedCables, TheTemplateSaysTheDefaults) {
  Problems problems;
  const CableFile file = LoadCableFile(ShippedPath("template.yaml"), &problems);
  ASSERT_EQ(file.cables.size(), 1u);
  const CableModel& cable = file.cables[0];
  EXPECT_EQ(cable.elements, CableModel().elements);
  EXPECT_EQ(cable.contact.stiffness, DefaultContactStiffness(cable));
  EXPECT_EQ(cable.contact.smoothing, ContactLaw().smoothing);
  EXPECT_EQ(cable.contact.damping, ContactLaw().damping);
  EXPECT_EQ(cable.apex_s, cable.length / 2);
}

TEST(ShippedCables, TheCarHasAHoseAndASensorCableAtEachCorner) {
  Problems problems;
  const CableFile file = LoadCableFile(ShippedPath("car.yaml"), &problems);
  ASSERT_EQ(file.cables.size(), 8u);
  std::size_t i = 0;
  for (const std::string corner : {"fl", "fr", "rl", "rr"}) {
    for (const std::string kind : {"brake_hose_", "sensor_cable_"}) {
      const CableModel& cable = file.cables[i++];
      EXPECT_EQ(cable.name, kind + corner);
      EXPECT_EQ(cable.a.link, "base_link");
      EXPECT_EQ(cable.b.link, corner + "_carrier");
      EXPECT_EQ(cable.diameter, kind == "brake_hose_" ? 0.010 : 0.005);
      if (corner[1] == 'l') continue;
      // file.cables is in pairs: the same cable of the left side stands two before.
      const CableModel& left = file.cables[i - 3];
      const Eigen::Vector3d mirror(1, -1, 1);
      EXPECT_EQ(cable.a.X_LC.p, left.a.X_LC.p.cwiseProduct(mirror));
      EXPECT_EQ(cable.b.X_LC.p, left.b.X_LC.p.cwiseProduct(mirror));
      EXPECT_EQ(cable.length, left.length);
    }
  }
}

// Links of a URDF by their tags: the vehicle room's parser is above this one.
std::vector<std::string> LinkNames(const std::string& urdf) {
  std::ifstream file(std::string(COSSERAT_CABLE_SOURCE_DIR) + "/urdf/" + urdf);
  std::ostringstream text;
  text << file.rdbuf();
  const std::string xml = text.str();
  const std::regex link("<link\\s+name=\"([^\"]+)\"");
  std::vector<std::string> names;
  for (std::sregex_iterator it(xml.begin(), xml.end(), link), end; it != end; ++it) {
    names.push_back((*it)[1]);
  }
  return names;
}

TEST(ShippedCables, HangBetweenLinksOfTheShippedVehicles) {
  for (const auto& [cables, urdf] :
       {std::make_pair("car.yaml", "car.urdf"), std::make_pair("template.yaml", "car.urdf"),
        std::make_pair("sweep.yaml", "sweep.urdf")}) {
    Problems problems;
    CheckAgainstVehicle(LoadCableFile(ShippedPath(cables), &problems), LinkNames(urdf), &problems);
    EXPECT_EQ(problems.ToString(), "");
  }
}

TEST(ShippedCables, TheSweepIsAnUprightArch) {
  Problems problems;
  const CableFile file = LoadCableFile(ShippedPath("sweep.yaml"), &problems);
  ASSERT_EQ(file.cables.size(), 1u);
  const CableModel& cable = file.cables[0];
  EXPECT_EQ(cable.reference, "world");
  EXPECT_EQ(cable.a.link, "body");
  EXPECT_EQ(cable.b.link, "body");
  EXPECT_EQ(cable.length, 0.2);
  EXPECT_EQ(cable.EI1, 0.0080);
  EXPECT_EQ(cable.mass_per_length, 0.15);
  EXPECT_EQ(cable.GJ, 0.0060);
  EXPECT_EQ(cable.eta_EI1, 1e-4);
  EXPECT_EQ(cable.eta_GJ, 5e-5);
  EXPECT_EQ(cable.b.X_LC.p - cable.a.X_LC.p, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(cable.a.X_LC.q * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(cable.b.X_LC.q * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ());
}

}  // namespace
}  // namespace cosserat_cable
