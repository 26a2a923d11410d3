// What the end of a run says.
#include "cosserat_cable/ros/summary.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

std::string Said(double dissipated, double residual) {
  Summary summary;
  summary.cables.resize(1);
  summary.cables[0].name = "hose";
  summary.cables[0].dissipated = dissipated;
  summary.cables[0].energy_residual = residual;
  return summary.ToText();
}

TEST(Summary, ABalanceThatIsFarOffIsAWarning) {
  const std::string text = Said(3.494, -3.48);
  EXPECT_NE(text.find("warning: its energy balance is off by -3.48 J, 100 %"), std::string::npos)
      << text;
  EXPECT_NE(text.find("--dt"), std::string::npos) << text;
}

TEST(Summary, WhatASnapLacksIsNone) {
  EXPECT_EQ(Said(1.0, 0.05).find("warning"), std::string::npos);
  EXPECT_EQ(Said(0.0, 1e-12).find("warning"), std::string::npos);
}

TEST(Summary, SaysWhatTheBalanceIsRelativeTo) {
  EXPECT_NE(Said(1.0, 0.0).find("in % of what the cable dissipated"), std::string::npos);
  // A stiff cable on a vehicle: 3.4 uJ dissipated, 15 mJ of kinetic energy.
  Summary summary;
  summary.cables.resize(1);
  summary.cables[0].dissipated = 3.4e-6;
  summary.cables[0].energy_residual = 3e-6;
  summary.cables[0].kinetic_max = 0.015;
  const std::string text = summary.ToText();
  EXPECT_NE(text.find("88 % of what was dissipated (0.02 % of its largest kinetic energy)"),
            std::string::npos)
      << text;
  EXPECT_NE(summary.ToJson().find("\"energy_off_by\": 0.88235"), std::string::npos);
}

TEST(Summary, ABalanceThatActsAsDampingIsTold) {
  EXPECT_NE(Said(1.0, 0.05).find("note: its energy balance is off by 0.05 J, 5 %"),
            std::string::npos);
  EXPECT_EQ(Said(1.0, 0.019).find("note:"), std::string::npos);
}

}  // namespace
}  // namespace cosserat_cable
