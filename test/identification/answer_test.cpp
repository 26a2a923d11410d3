// What is written of an identification.
#include "../../src/identification/answer.h"

#include <gtest/gtest.h>

#include "cosserat_cable/identification/identified_cable.h"

namespace cosserat_cable {
namespace {

ParameterEstimate Estimated(const std::string& name, double value, double low, double high) {
  ParameterEstimate one;
  one.unknown.name = name;
  one.determined = true;
  one.value = value;
  one.sd = 0.1 * value;
  one.low = low;
  one.high = high;
  return one;
}

MeasurementSet SetOf(const std::string& cable) {
  Problems problems;
  MapReader map(YamlValue::Root("set", YAML::Load(cable), &problems));
  MeasurementSet set;
  set.cable = ReadCableKeys(&map);
  set.cable_mark = map.mark();
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  return set;
}

TEST(AnswerTest, TheIdentifiedCableHasTheIntervalsOfTheTableAndMarksExtensions) {
  const MeasurementSet set = SetOf(
      "length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\nEI1: 0.003\nEI2: 0.006\n"
      "GJ: 0.0019\neta_EI: 1.0e-6\neta_GJ: 1.0e-6\n"
      "extensions: {maxwell: [{tau: 0.1, EI: 0.001}, {tau: 2, GJ: 0.001}],\n"
      "             clamp_compliance: {a: {bending: 5}}}\n");
  Estimation estimation;
  estimation.cable = set.cable;
  // Neither is 1.96 sd to both sides.
  estimation.parameters = {Estimated("EI", 0.003, 0.0021, 0.0045),
                           Estimated("extensions.maxwell[0].EI", 0.001, 0.0004, 0.0013),
                           Estimated("extensions.clamp_compliance.a.bending", 5, 4, 7)};
  ParameterEstimate hidden;
  hidden.unknown.name = "extensions.maxwell[1].tau";
  hidden.reason = "no record shows it";
  estimation.parameters.push_back(hidden);
  const std::string text = IdentifiedCableText(set, estimation);
  for (const char* part : {"EI1: 0.003  # identified, 95 % from 0.0021 to 0.0045\n",
                           "EI2: 0.006  # identified with EI1, in proportion\n",
                           "  # maxwell[0].EI identified, 95 % from 0.0004 to 0.0013; "
                           "maxwell[1].tau not determined by the data: no record shows it\n",
                           "  # clamp_compliance.a.bending identified, 95 % from 4 to 7\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "in\n" << text;
  // It is a cable file still.
  EXPECT_TRUE(YAML::Load(text)["cable"]["extensions"]["maxwell"][0]["EI"]);
}

TEST(AnswerTest, ANumberThatASlipMakesIsMarkedWhereverItStands) {
  const MeasurementSet set = SetOf(
      "length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\nEI: 0.003\nGJ: 0.0019\n"
      "eta_EI: 1.0e-6\neta_GJ: 1.0e-6\n");
  Estimation estimation;
  estimation.cable = set.cable;
  estimation.parameters = {Estimated("EI", 0.003, 0.0021, 0.0045),
                           Estimated("GJ", 0.0019, 0.0018, 0.002)};
  for (ParameterEstimate& one : estimation.parameters) one.unknown.kind = Unknown::Kind::kCable;
  estimation.parameters[0].doubt = "pull fits with its load in grams; with that mended it is 3e-05";
  estimation.correlation = Eigen::MatrixXd::Identity(2, 2);
  const std::string text = IdentifiedCableText(set, estimation);
  EXPECT_NE(text.find("0.0045; not to be trusted: pull fits with its load in grams"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("not to be trusted", text.find("GJ:")), std::string::npos) << text;
  const nlohmann::json answer = AnswerJson(set, estimation);
  EXPECT_EQ(answer["untrusted"].size(), 1u);
  EXPECT_EQ(answer["untrusted"]["EI"], estimation.parameters[0].doubt);
  const std::string table = AnswerTable(set, estimation);
  const std::string of_EI =
      table.substr(table.find("\nEI"), table.find("\nGJ") - table.find("\nEI"));
  EXPECT_NE(of_EI.find("not to be trusted"), std::string::npos) << table;
}

}  // namespace
}  // namespace cosserat_cable
