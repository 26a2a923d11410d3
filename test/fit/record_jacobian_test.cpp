// Derivatives of two records by three unknowns, of which one concerns the second record only.
#include "cosserat_cable/fit/record_jacobian.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-14;

RecordJacobian Two() {
  RecordJacobian::Record first, second;
  first.unknowns = {0, 1};
  first.columns = (Eigen::MatrixXd(2, 2) << 1, 2, 3, 4).finished();
  second.unknowns = {1, 2};
  second.columns = (Eigen::MatrixXd(2, 2) << 5, 6, 7, 8).finished();
  return RecordJacobian({first, second}, Vector3d::Zero());
}

TEST(RecordJacobianTest, SomeAndTheRestMakeTheWhole) {
  const std::vector<bool> one = {false, true, false}, rest = {true, false, true};
  RecordJacobian whole = Two().Only(one);
  EXPECT_EQ(whole.Known(), one);
  whole.Add(Two(), rest);
  EXPECT_EQ(whole.Known(), std::vector<bool>(3, true));
  EXPECT_LT((whole.Gram() - Two().Gram()).norm(), kRounding);
}

TEST(RecordJacobianTest, ACorrectedOneSaysWhatAStepDid) {
  RecordJacobian corrected = Two();
  const Vector3d step(0.1, -0.2, 0.3);
  const Eigen::Vector4d change(0.5, -1, 2, 0.25);
  corrected.Correct(step, change);
  Eigen::Index row = 0;
  for (const RecordJacobian::Record& record : corrected.records()) {
    const Eigen::Vector2d own(step[record.unknowns[0]], step[record.unknowns[1]]);
    EXPECT_LT((record.columns * own - change.segment<2>(row)).norm(), kRounding);
    row += 2;
  }
}

TEST(RecordJacobianTest, AStepThatDoesWhatIsSaidCorrectsNothing) {
  RecordJacobian same = Two();
  const Vector3d step(0.1, -0.2, 0.3);
  Eigen::Vector4d change;
  change << 0.1 * 1 - 0.2 * 2, 0.1 * 3 - 0.2 * 4, -0.2 * 5 + 0.3 * 6, -0.2 * 7 + 0.3 * 8;
  same.Correct(step, change);
  EXPECT_LT((same.Gram() - Two().Gram()).norm(), 100 * kRounding);
}

}  // namespace
}  // namespace cosserat_cable
