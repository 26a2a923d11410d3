// A vehicle's cables with the section that was found on a specimen.
#include "cosserat_cable/cable/section_file.h"

#include <gtest/gtest.h>

#include "cable/cable_text.h"

namespace cosserat_cable {
namespace {

const char* const kVehicle =
    "format: 1\n"
    "types:\n"
    "  hose: {length: 0.3, diameter: 0.008, mass_per_length: 0.1, EI: 0.03, GJ: 0.02, eta_EI: "
    "1e-4}\n"
    "cables:\n"
    "  - name: left\n"
    "    type: hose\n"
    "    a: {link: body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "    b: {link: left_wheel, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "  - name: right\n"
    "    type: hose\n"
    "    a: {link: body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "    b: {link: right_wheel, pose: [0, 0, 0, 0, 0, 0, 1]}\n";

const std::string kFound =
    std::string(kSpecimen) + "  extensions: {maxwell: [{tau: 0.1, EI: 0.002}]}\n";

struct Read {
  CableFile file;
  std::string said;
};

Read With(const std::vector<std::string>& sections, const std::string& text = kVehicle) {
  const TemporaryFile yaml(text);
  Problems problems;
  Read read;
  read.file = LoadCableFile(yaml.path(), &problems, sections);
  read.said = problems.ToString();
  return read;
}

TEST(SectionFile, GivesAllCablesWhatWasFittedAndNothingElse) {
  const TemporaryFile specimen(kFound);
  const Read read = With({specimen.path()});
  ASSERT_EQ(read.said, "");
  ASSERT_EQ(read.file.cables.size(), 2u);
  for (const CableModel& cable : read.file.cables) {
    EXPECT_EQ(cable.EI1, 0.012);
    EXPECT_EQ(cable.GJ, 0.009);
    EXPECT_EQ(cable.eta_EI1, 2e-4);
    EXPECT_EQ(cable.extensions.size(), 1u);
    EXPECT_EQ(cable.length, 0.3);
    EXPECT_EQ(cable.mass_per_length, 0.1);
  }
}

TEST(SectionFile, OfOneCableStandsBeforeThatForAll) {
  const TemporaryFile specimen(kFound), other(Replaced(kSpecimen, "EI: 0.012", "EI: 0.02"));
  const Read one = With({"right=" + specimen.path()});
  ASSERT_EQ(one.said, "");
  EXPECT_EQ(one.file.cables[0].EI1, 0.03);
  EXPECT_EQ(one.file.cables[1].EI1, 0.012);
  for (const bool own_first : {true, false}) {
    std::vector<std::string> both = {"right=" + specimen.path(), other.path()};
    if (!own_first) std::swap(both[0], both[1]);
    const Read read = With(both);
    ASSERT_EQ(read.said, "");
    EXPECT_EQ(read.file.cables[0].EI1, 0.02);
    EXPECT_EQ(read.file.cables[1].EI1, 0.012);
  }
}

TEST(SectionFile, RefusesWhatCannotBeMeant) {
  const TemporaryFile specimen(kFound),
      thicker(Replaced(kSpecimen, "diameter: 0.008", "diameter: 0.010"));
  const std::string path = specimen.path();
  EXPECT_NE(With({"rigth=" + path}).said.find("did you mean 'right'?"), std::string::npos);
  EXPECT_NE(With({path, path}).said.find("a second section for all cables"), std::string::npos);
  EXPECT_NE(With({thicker.path()}).said.find("a diameter of 0.01 m, this cable 0.008 m"),
            std::string::npos);
  EXPECT_NE(With({"left=/nowhere.yaml"}).said.find("/nowhere.yaml"), std::string::npos);
}

}  // namespace
}  // namespace cosserat_cable
