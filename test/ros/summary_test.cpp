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

}  // namespace
}  // namespace cosserat_cable
