#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable::generator {

using Points = Eigen::Matrix3Xd;  ///< one column per point along the rod

/// How finely a rod is resolved: Legendre polynomials per strain component and element.
struct Resolution {
  int curvature = 9;  ///< of K1, K2, K3
  int strain = 7;     ///< of Gamma1, Gamma2, Gamma3
  int nodes = 16;     ///< quadrature nodes per element
};

/// The six strains K1, K2, K3, Gamma1, Gamma2, Gamma3 of a rod as piecewise polynomials of arc
/// length (elements end where a point mass or a point load makes a strain jump or kink), and all
/// that depends on the geometry alone: strains and rotations from coordinates, integrals along s.
///
/// *Points* are the quadrature nodes of all elements in order, then the elements' ends.
class RodShape {
 public:
  /// @param breaks inner arc lengths [m] at which elements end, in any order.
  RodShape(double length, const std::vector<double>& breaks, const Resolution& resolution);

  int size() const { return size_; }
  int nodes() const { return static_cast<int>(weights_.size()); }
  int points() const { return nodes() + elements(); }
  int elements() const { return static_cast<int>(ends_.size()); }
  double length() const { return length_; }
  /// Index among the points of the element's end at s; throws where no element ends there.
  int endPoint(double s) const;

  int offset(int component) const { return offset_[component]; }
  int count(int component) const { return offset_[component + 1] - offset_[component]; }
  /// Values at the nodes of the functions that span a component.
  const Eigen::MatrixXd& basis(int component) const { return component < 3 ? curvature_ : strain_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  /// points x nodes: integral from 0 to each point of what is given at the nodes.
  const Eigen::MatrixXd& integral() const { return integral_; }
  /// The same for any one arc length.
  Eigen::RowVectorXd integralTo(double s) const;

  /// Sum of basis times coordinates at the nodes; `first` is 0 for K and 3 for Gamma.
  Points atNodes(const Eigen::VectorXd& q, int first) const;
  /// Section frames {a1, a2, a3} at all points side by side (3 x 3 points()), from K alone and
  /// relative to the frame at s = 0.
  void rotations(const Eigen::VectorXd& q, Eigen::Matrix3Xd* frames) const;

 private:
  Eigen::Vector3d step(const Points& K, int first, double h) const;

  double length_;
  int size_ = 0;
  int nodes_per_element_;
  std::vector<double> ends_;
  std::vector<double> lengths_;
  int offset_[7];
  Eigen::VectorXd weights_;
  Eigen::MatrixXd curvature_;
  Eigen::MatrixXd strain_;
  Eigen::MatrixXd integral_;
  Eigen::MatrixXd between_;      ///< curvature basis at three points between each two neighbours
  std::vector<double> spacing_;  ///< [m] of those neighbours
};

}  // namespace cosserat_cable::generator
