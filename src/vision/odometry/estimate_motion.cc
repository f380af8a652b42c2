#include "vision/odometry/estimate_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "math/decompositions.h"
#include "math/functions.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

namespace {

Eigen::Matrix3d CrossMatrix(const math::Vector3& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

Motion Compose(const Motion& A_to_B, const Motion& B_to_C) {
  const Eigen::Matrix3d R_AB = A_to_B.X_FS.linear();
  MotionCovariance by_first = MotionCovariance::Identity();
  by_first.topRightCorner<3, 3>() = -CrossMatrix(R_AB * B_to_C.X_FS.translation());
  MotionCovariance by_second = MotionCovariance::Zero();
  by_second.topLeftCorner<3, 3>() = R_AB;
  by_second.bottomRightCorner<3, 3>() = R_AB;
  Motion whole;
  whole.X_FS = A_to_B.X_FS * B_to_C.X_FS;
  whole.covariance = by_first * A_to_B.covariance * by_first.transpose() +
                     by_second * B_to_C.covariance * by_second.transpose();
  return whole;
}

namespace {

using math::Matrix6;
using math::Transform;
using math::Vector3;
using math::Vector6;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

Eigen::Matrix3d Cross(const Vector3& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(),  //
      v.z(), 0.0, -v.x(),       //
      -v.y(), v.x(), 0.0;
  return cross;
}

PairPixel Measured(const StereoMeasurement& m) { return {m.left.x(), m.left.y(), m.disparity_px}; }

// Returns the motion changed by (e_t, e_r). Must be the error of MotionCovariance, as the
// covariance is the inverse of the equations for this change.
Transform Disturbed(const Transform& X_FS, const Vector6& change) {
  Transform moved = X_FS;
  moved.translation() += change.head<3>();
  const Vector3 turn = change.tail<3>();
  const double angle_rad = turn.norm();
  if (angle_rad > 0.0) {
    moved.linear() = math::RotationAbout(angle_rad, turn / angle_rad) * X_FS.linear();
  }
  return moved;
}

// What was measured of a point, weighed by the inverse covariances.
struct Point {
  PairPixel first;
  PairPixel second;
  Eigen::Matrix3d first_weight;
  Eigen::Matrix3d second_weight;
};

// Estimated places of the points, in F.
using Places = std::vector<Vector3>;

// The part of one point in the equations: N of the motion, of the point and of both together, and
// the right sides.
struct Terms {
  Matrix6 motion = Matrix6::Zero();
  Vector6 motion_side = Vector6::Zero();
  Matrix63 both = Matrix63::Zero();
  Eigen::Matrix3d point = Eigen::Matrix3d::Zero();
  Vector3 point_side = Vector3::Zero();
};

class MotionProblem {
 public:
  MotionProblem(const PointsSeenTwice& points, const RectifiedPair& cameras,
                const EstimationParams& params, const Transform& start)
      : project_(cameras), params_(params), X_FS_(start) {
    for (const PointSeenTwice& point : points) {
      points_.push_back({Measured(point.first), Measured(point.second),
                         point.first.covariance_px2.inverse(),
                         point.second.covariance_px2.inverse()});
      places_.push_back(point.first.p_A);
    }
  }

  EstimatedMotion Solve() {
    EstimatedMotion result;
    double cost = Cost(X_FS_, places_);
    double damping = 1e-4;
    while (std::isfinite(cost) && !result.converged && result.iterations < params_.max_iterations) {
      ++result.iterations;
      Step step = FindStep(damping);
      const double next = Cost(step.X_FS, step.places);
      result.converged = step.decrement <= params_.tolerance * params_.tolerance;
      if (!(next <= cost)) {
        damping *= 10.0;
        continue;
      }
      X_FS_ = step.X_FS;
      places_ = std::move(step.places);
      cost = next;
      damping = std::max(damping * 0.1, 1e-12);
    }
    result.X_FS = X_FS_;
    Judge(result);
    return result;
  }

 private:
  struct Step {
    Transform X_FS;
    Places places;
    double decrement = 0.0;  // d' N d
  };

  struct Residuals {
    PairPixel first;
    PairPixel second;
    double squared = 0.0;  // sum of both, in units of their covariances
  };

  std::optional<Residuals> ResidualsOf(const Transform& X_SF, const Point& point,
                                       const Vector3& p_F) const {
    const auto first = project_(p_F);
    const auto second = project_(X_SF * p_F);
    if (!first || !second) return std::nullopt;
    Residuals r{point.first - *first, point.second - *second, 0.0};
    r.squared =
        r.first.dot(point.first_weight * r.first) + r.second.dot(point.second_weight * r.second);
    return r;
  }

  // The robust part of a point in the sum. `squared` comes from 6 measurements less the point's 3
  // coordinates, so that its mean is 3 for normal noise.
  double RobustCost(double squared) const {
    const double limit = params_.robust_sigma * params_.robust_sigma * kDegreesOfPoint;
    switch (params_.weights) {
      case RobustWeights::kNone:
        return squared;
      case RobustWeights::kHuber:
        return squared <= limit ? squared : 2.0 * std::sqrt(limit * squared) - limit;
      case RobustWeights::kCauchy:
        return limit * math::Log1p(squared / limit);
    }
    return squared;
  }
  // Must be the derivative of RobustCost by `squared`.
  double RobustWeight(double squared) const {
    const double limit = params_.robust_sigma * params_.robust_sigma * kDegreesOfPoint;
    switch (params_.weights) {
      case RobustWeights::kNone:
        return 1.0;
      case RobustWeights::kHuber:
        return squared <= limit ? 1.0 : std::sqrt(limit / squared);
      case RobustWeights::kCauchy:
        return 1.0 / (1.0 + squared / limit);
    }
    return 1.0;
  }

  // Returns the sum to minimize, infinite where a point is not in front of the cameras.
  double Cost(const Transform& X_FS, const Places& places) const {
    const Transform X_SF = X_FS.inverse();
    double cost = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto r = ResidualsOf(X_SF, points_[i], places[i]);
      if (!r) return std::numeric_limits<double>::infinity();
      cost += RobustCost(r->squared);
    }
    return cost;
  }

  // p_S = R' (p_F - p), with R = R_FS: d p_S = R' (d p_F - e_t + [p_F - p]x e_r).
  Terms TermsOf(const Transform& X_SF, const Point& point, const Vector3& p_F) const {
    Eigen::Matrix3d first_by_point = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d second_by_place = Eigen::Matrix3d::Zero();
    const PairPixel first = *project_(p_F, &first_by_point);
    const PairPixel second = *project_(X_SF * p_F, &second_by_place);
    const PairPixel r_first = point.first - first;
    const PairPixel r_second = point.second - second;
    const double weight = RobustWeight(r_first.dot(point.first_weight * r_first) +
                                       r_second.dot(point.second_weight * r_second));
    const Eigen::Matrix3d second_by_point = second_by_place * X_SF.linear();
    Eigen::Matrix<double, 3, 6> second_by_motion;
    second_by_motion.leftCols<3>() = -second_by_point;
    second_by_motion.rightCols<3>() = second_by_point * Cross(p_F - X_FS_.translation());

    const Eigen::Matrix3d W_first = weight * point.first_weight;
    const Eigen::Matrix3d W_second = weight * point.second_weight;
    const Matrix63 motion_weighed = second_by_motion.transpose() * W_second;
    const Eigen::Matrix3d first_weighed = first_by_point.transpose() * W_first;
    const Eigen::Matrix3d second_weighed = second_by_point.transpose() * W_second;
    Terms terms;
    terms.motion = motion_weighed * second_by_motion;
    terms.motion_side = motion_weighed * r_second;
    terms.both = motion_weighed * second_by_point;
    terms.point = first_weighed * first_by_point + second_weighed * second_by_point;
    terms.point_side = first_weighed * r_first + second_weighed * r_second;
    return terms;
  }

  // The numbers from which a point's step follows once the motion's step is known.
  struct Follower {
    Eigen::Matrix3d inverse;
    Vector3 side;
    Matrix63 both;
  };

  Step FindStep(double damping) const {
    const Transform X_SF = X_FS_.inverse();
    std::vector<Follower> followers;
    followers.reserve(points_.size());
    Matrix6 N = Matrix6::Zero();
    Vector6 side = Vector6::Zero();
    Matrix6 diagonal = Matrix6::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Terms terms = TermsOf(X_SF, points_[i], places_[i]);
      diagonal += terms.motion;
      terms.point.diagonal() *= 1.0 + damping;
      // For a step dx of the motion the point's step dp has
      // terms.point dp = point_side - both' dx.
      const Eigen::Matrix3d inverse = terms.point.inverse();
      const Matrix63 both_inverse = terms.both * inverse;
      N += terms.motion - both_inverse * terms.both.transpose();
      side += terms.motion_side - both_inverse * terms.point_side;
      followers.push_back({inverse, terms.point_side, terms.both});
    }
    Matrix6 damped = N;
    damped.diagonal() += damping * diagonal.diagonal();
    const Vector6 change = math::SolveSymmetric(damped, side);
    Step step{Disturbed(X_FS_, change), places_, change.dot(N * change)};
    for (std::size_t i = 0; i < followers.size(); ++i) {
      const Follower& point = followers[i];
      step.places[i] += point.inverse * (point.side - point.both.transpose() * change);
    }
    return step;
  }

  // Returns the equations' matrix of the motion, with the points eliminated, without damping.
  Matrix6 Information() const {
    const Transform X_SF = X_FS_.inverse();
    Matrix6 N = Matrix6::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Terms terms = TermsOf(X_SF, points_[i], places_[i]);
      N += terms.motion - terms.both * terms.point.inverse() * terms.both.transpose();
    }
    return N;
  }

  void Judge(EstimatedMotion& result) const {
    if (!result.converged) {
      result.reason = NoMotion::kNotConverged;
      return;
    }
    MeasureFit(result);
    if (!(result.fit <= params_.max_fit)) {
      result.reason = NoMotion::kPoorFit;
      return;
    }
    const std::optional<Matrix6> inverse = math::InverseOfPositive(Information());
    const MotionCovariance covariance =
        std::max(result.fit, 1.0) * inverse.value_or(Matrix6::Zero());
    if (!inverse || !IsSure(covariance)) {
      result.reason = NoMotion::kUncertain;
      return;
    }
    result.motion = Motion{X_FS_, 0.5 * (covariance + covariance.transpose())};
  }

  void MeasureFit(EstimatedMotion& result) const {
    const Transform X_SF = X_FS_.inverse();
    double squares_px2 = 0.0;
    double weighted = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto r = ResidualsOf(X_SF, points_[i], places_[i]);
      squares_px2 += r->first.squaredNorm() + r->second.squaredNorm();
      weighted += RobustWeight(r->squared) * r->squared;
    }
    const auto n = static_cast<double>(points_.size());
    constexpr double kMotionUnknowns = 6.0;
    result.rms_px = std::sqrt(squares_px2 / (6.0 * n));
    result.fit = weighted / std::max(kDegreesOfPoint * n - kMotionUnknowns, 1.0);
  }

  // Returns whether the standard deviations in every direction are within their limits.
  bool IsSure(const MotionCovariance& covariance) const {
    const double place = math::LargestEigenvalue(covariance.topLeftCorner<3, 3>());
    const double turn = math::LargestEigenvalue(covariance.bottomRightCorner<3, 3>());
    return place <= params_.max_position_sd_m * params_.max_position_sd_m &&
           turn <= params_.max_rotation_sd_rad * params_.max_rotation_sd_rad;
  }

  static constexpr double kDegreesOfPoint = 3.0;

  PairProjection project_;
  const EstimationParams& params_;
  Transform X_FS_;
  std::vector<Point> points_;
  Places places_;
};

}  // namespace

EstimatedMotion EstimateMotion(const PointsSeenTwice& points, const RectifiedPair& cameras,
                               const EstimationParams& params, const Transform& start) {
  return MotionProblem(points, cameras, params, start).Solve();
}

}  // namespace rockyard::vision
