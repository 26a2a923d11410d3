// Fourier sums over uneven times, by a fast transform.
#pragma once

#include <Eigen/Core>

namespace cosserat_cable {

/// sum over j of x[j] exp(-i (k + 1/2) phase[j]) for k = 0 .. count - 1, to 1e-10 of the sum of
/// |x|. Greengard and Lee, Accelerating the nonuniform fast Fourier transform, SIAM Review 46
/// (2004): each value is spread with a Gaussian over an even grid, whose transform is freed of the
/// Gaussian's.
/// @pre phase is as long as x, and in [0, 2 pi)
Eigen::ArrayXcd UnevenTransform(const Eigen::ArrayXd& phase, const Eigen::ArrayXd& x,
                                Eigen::Index count);

}  // namespace cosserat_cable
