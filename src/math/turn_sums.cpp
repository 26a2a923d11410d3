#include "turn_sums.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/kernel.h"
#include "cosserat_cable/math/lane_rows.h"

namespace cosserat_cable {
namespace {

constexpr int kStep = Lanes::kCount;
static_assert(WeightedPoses::kMax % kStep == 0);

double SumOf(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }

// atan(t)/t in z = t^2. The first dropped term is z^13/27: below 1e-16 for z < 0.0652, which is
// t = tan(kSmallTurn / 4).
Lanes ArcTangentByTangent(const Lanes& z) {
  Lanes sum(1. / 25);
  for (int k = 11; k >= 0; --k) sum = Lanes(1. / (2 * k + 1)) - z * sum;
  return sum;
}

// Sums by `weights` of the position's and the logarithm's three coordinates; the smallest cosine of
// half a turn.
COSSERAT_CABLE_KERNEL
double SumRows(const WeightedPoses& poses, const SplineWeights& weights, int count, double* sums) {
  Lanes total[12];
  for (Lanes& sum : total) sum = Lanes(0.0);
  Lanes least(1.0);
  for (int i = 0; i < count; i += kStep) {
    // A turn and its negative are one rotation.
    const Lanes signed_w = LoadLanes(&poses.w[i]);
    const Lanes w = Max(signed_w, -signed_w);
    least = Min(least, w);
    const Lanes x = LoadLanes(&poses.qx[i]), y = LoadLanes(&poses.qy[i]),
                z = LoadLanes(&poses.qz[i]);
    const Lanes part = Lanes(1.0) / (Lanes(1.0) + w);  // tan(a/4) = sin(a/2) / (1 + cos(a/2))
    const Lanes square = (x * x + y * y + z * z) * part * part;
    const Lanes scale = Lanes(4.0) * part * ArcTangentByTangent(square) * (signed_w / w);
    const Lanes values[6] = {LoadLanes(&poses.px[i]),
                             LoadLanes(&poses.py[i]),
                             LoadLanes(&poses.pz[i]),
                             scale * x,
                             scale * y,
                             scale * z};
    const Lanes first = LoadLanes(&weights.first[i]), second = LoadLanes(&weights.second[i]);
    for (int k = 0; k < 6; ++k) {
      total[k] += first * values[k];
      total[k + 6] += second * values[k];
    }
  }
  for (int k = 0; k < 12; ++k) sums[k] = SumOf(total[k]);
  return std::min({least[0], least[1], least[2], least[3]});
}

}  // namespace

void WeightedPoses::Set(int k, const Eigen::Vector3d& p, const Eigen::Quaterniond& turn) {
  px[k] = p.x();
  py[k] = p.y();
  pz[k] = p.z();
  w[k] = turn.w();
  qx[k] = turn.x();
  qy[k] = turn.y();
  qz[k] = turn.z();
}

WeightedSums SumUp(const WeightedPoses& poses, const SplineWeights& weights, int count) {
  double sums[12];
  WeightedSums result;
  result.small = SumRows(poses, weights, count, sums) > std::cos(0.5 * kSmallTurn);
  result.d_position = Eigen::Vector3d(sums);
  result.d_phi = Eigen::Vector3d(sums + 3);
  result.dd_position = Eigen::Vector3d(sums + 6);
  result.dd_phi = Eigen::Vector3d(sums + 9);
  return result;
}

}  // namespace cosserat_cable
