#include "vision/odometry/estimate_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/odometry/pair_projection.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

Eigen::Matrix3d Cross(const Vector3& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(),  //
      v.z(), 0.0, -v.x(),       //
      -v.y(), v.x(), 0.0;
  return cross;
}

PairPixel Measured(const StereoMeasurement& m) { return {m.left.x(), m.left.y(), m.disparity_px}; }

Transform Disturbed(const Transform& X_FS, const Vector6& change) {
  Transform moved = X_FS;
  moved.translation() += change.head<3>();
  const Vector3 turn = change.tail<3>();
  const double angle_rad = turn.norm();
  if (angle_rad > 0.0) {
    moved.linear() =
        Eigen::AngleAxisd(angle_rad, turn / angle_rad).toRotationMatrix() * X_FS.linear();
  }
  return moved;
}

// A point of the problem: what was measured, weighed by the inverse covariances, and where it is
// believed to be, in F.
struct Point {
  PairPixel first;
  PairPixel second;
  Eigen::Matrix3d first_weight;
  Eigen::Matrix3d second_weight;
  Vector3 p_F;
};

// What a point adds to the equations: N of the motion, of the point and of both, and the right
// sides.
struct Terms {
  Matrix6 motion = Matrix6::Zero();
  Vector6 motion_side = Vector6::Zero();
  Matrix63 both = Matrix63::Zero();
  Eigen::Matrix3d point = Eigen::Matrix3d::Zero();
  Vector3 point_side = Vector3::Zero();
};

class Problem {
 public:
  Problem(const PointsSeenTwice& points, const RectifiedPair& cameras,
          const EstimationParams& params, const Transform& start)
      : project_(cameras), params_(params), X_FS_(start) {
    for (const PointSeenTwice& point : points) {
      points_.push_back({Measured(point.first), Measured(point.second),
                         point.first.covariance_px2.inverse(),
                         point.second.covariance_px2.inverse(), point.first.p_A});
    }
  }

  EstimatedMotion Solve() {
    EstimatedMotion result;
    double cost = Cost(X_FS_, points_);
    double damping = 1e-4;
    bool converged = false;
    while (std::isfinite(cost) && !converged && result.iterations < params_.max_iterations) {
      ++result.iterations;
      const Step step = FindStep(damping);
      const double next = Cost(step.X_FS, step.points);
      converged = step.decrement <= params_.tolerance * params_.tolerance;
      if (!(next <= cost)) {
        damping *= 10.0;
        continue;
      }
      X_FS_ = step.X_FS;
      points_ = step.points;
      cost = next;
      damping = std::max(damping * 0.1, 1e-12);
    }
    Judge(converged, result);
    return result;
  }

 private:
  struct Step {
    Transform X_FS;
    std::vector<Point> points;
    double decrement = 0.0;  // d' N d
  };

  struct Residuals {
    PairPixel first;
    PairPixel second;
    double squared = 0.0;  // in units of their covariances
  };

  std::optional<Residuals> ResidualsOf(const Transform& X_SF, const Point& point) const {
    const auto first = project_(point.p_F);
    const auto second = project_(X_SF * point.p_F);
    if (!first || !second) return std::nullopt;
    Residuals r{point.first - *first, point.second - *second, 0.0};
    r.squared =
        r.first.dot(point.first_weight * r.first) + r.second.dot(point.second_weight * r.second);
    return r;
  }

  // Of 6 measurements less the 3 coordinates of the point: a mean of 3 where the noise is normal.
  double RobustCost(double squared) const {
    const double limit = params_.robust_sigma * params_.robust_sigma * kDegreesOfPoint;
    switch (params_.weights) {
      case RobustWeights::kNone:
        return squared;
      case RobustWeights::kHuber:
        return squared <= limit ? squared : 2.0 * std::sqrt(limit * squared) - limit;
      case RobustWeights::kCauchy:
        return limit * std::log1p(squared / limit);
    }
    return squared;
  }
  // Its derivative by `squared`.
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

  // Infinite where a point is not in front of the cameras.
  double Cost(const Transform& X_FS, const std::vector<Point>& points) const {
    const Transform X_SF = X_FS.inverse();
    double cost = 0.0;
    for (const Point& point : points) {
      const auto r = ResidualsOf(X_SF, point);
      if (!r) return std::numeric_limits<double>::infinity();
      cost += RobustCost(r->squared);
    }
    return cost;
  }

  // p_S = R' (p_F - p), with R = R_FS: d p_S = R' (d p_F - e_t + [p_F - p]x e_r).
  Terms TermsOf(const Transform& X_SF, const Point& point) const {
    Eigen::Matrix3d first_by_point;
    Eigen::Matrix3d second_by_place;
    const PairPixel first = *project_(point.p_F, &first_by_point);
    const PairPixel second = *project_(X_SF * point.p_F, &second_by_place);
    const PairPixel r_first = point.first - first;
    const PairPixel r_second = point.second - second;
    const double weight = RobustWeight(r_first.dot(point.first_weight * r_first) +
                                       r_second.dot(point.second_weight * r_second));
    const Eigen::Matrix3d second_by_point = second_by_place * X_SF.linear();
    Eigen::Matrix<double, 3, 6> second_by_motion;
    second_by_motion.leftCols<3>() = -second_by_point;
    second_by_motion.rightCols<3>() = second_by_point * Cross(point.p_F - X_FS_.translation());

    const Eigen::Matrix3d W_first = weight * point.first_weight;
    const Eigen::Matrix3d W_second = weight * point.second_weight;
    Terms terms;
    terms.motion = second_by_motion.transpose() * W_second * second_by_motion;
    terms.motion_side = second_by_motion.transpose() * W_second * r_second;
    terms.both = second_by_motion.transpose() * W_second * second_by_point;
    terms.point = first_by_point.transpose() * W_first * first_by_point +
                  second_by_point.transpose() * W_second * second_by_point;
    terms.point_side = first_by_point.transpose() * W_first * r_first +
                       second_by_point.transpose() * W_second * r_second;
    return terms;
  }

  Step FindStep(double damping) const {
    const Transform X_SF = X_FS_.inverse();
    std::vector<Terms> all;
    all.reserve(points_.size());
    Matrix6 N = Matrix6::Zero();
    Vector6 side = Vector6::Zero();
    Matrix6 diagonal = Matrix6::Zero();
    for (const Point& point : points_) {
      all.push_back(TermsOf(X_SF, point));
      Terms& terms = all.back();
      diagonal += terms.motion;
      terms.point.diagonal() *= 1.0 + damping;
      // Whatever the motion, the point follows: terms.point dp = point_side - both' dx.
      const Eigen::Matrix3d inverse = terms.point.inverse();
      N += terms.motion - terms.both * inverse * terms.both.transpose();
      side += terms.motion_side - terms.both * inverse * terms.point_side;
    }
    Matrix6 damped = N;
    damped.diagonal() += damping * diagonal.diagonal();
    const Vector6 change = damped.ldlt().solve(side);
    Step step{Disturbed(X_FS_, change), points_, change.dot(N * change)};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      step.points[i].p_F +=
          all[i].point.inverse() * (all[i].point_side - all[i].both.transpose() * change);
    }
    return step;
  }

  // The equations' matrix of the motion alone, without damping.
  Matrix6 Information() const {
    const Transform X_SF = X_FS_.inverse();
    Matrix6 N = Matrix6::Zero();
    for (const Point& point : points_) {
      const Terms terms = TermsOf(X_SF, point);
      N += terms.motion - terms.both * terms.point.inverse() * terms.both.transpose();
    }
    return N;
  }

  void Judge(bool converged, EstimatedMotion& result) const {
    if (!converged) {
      result.reason = NoMotion::kNotConverged;
      return;
    }
    MeasureFit(result);
    if (!(result.fit <= params_.max_fit)) {
      result.reason = NoMotion::kPoorFit;
      return;
    }
    const Matrix6 N = Information();
    const Eigen::LDLT<Matrix6> solver(N);
    const MotionCovariance covariance =
        std::max(result.fit, 1.0) * MotionCovariance(solver.solve(Matrix6::Identity()));
    if (!solver.isPositive() || !IsSure(covariance)) {
      result.reason = NoMotion::kUncertain;
      return;
    }
    result.motion = Motion{X_FS_, 0.5 * (covariance + covariance.transpose())};
  }

  void MeasureFit(EstimatedMotion& result) const {
    const Transform X_SF = X_FS_.inverse();
    double squares_px2 = 0.0;
    double weighted = 0.0;
    for (const Point& point : points_) {
      const auto r = ResidualsOf(X_SF, point);
      squares_px2 += r->first.squaredNorm() + r->second.squaredNorm();
      weighted += RobustWeight(r->squared) * r->squared;
    }
    const auto n = static_cast<double>(points_.size());
    constexpr double kMotionUnknowns = 6.0;
    result.rms_px = std::sqrt(squares_px2 / (6.0 * n));
    result.fit = weighted / std::max(kDegreesOfPoint * n - kMotionUnknowns, 1.0);
  }

  // The largest standard deviation in any direction.
  bool IsSure(const MotionCovariance& covariance) const {
    const auto largest = [](const Eigen::Matrix3d& part) {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(part, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
    };
    const double place = largest(covariance.topLeftCorner<3, 3>());
    const double turn = largest(covariance.bottomRightCorner<3, 3>());
    return place <= params_.max_position_sd_m * params_.max_position_sd_m &&
           turn <= params_.max_rotation_sd_rad * params_.max_rotation_sd_rad;
  }

  static constexpr double kDegreesOfPoint = 3.0;

  PairProjection project_;
  const EstimationParams& params_;
  Transform X_FS_;
  std::vector<Point> points_;
};

}  // namespace

EstimatedMotion EstimateMotion(const PointsSeenTwice& points, const RectifiedPair& cameras,
                               const EstimationParams& params, const Transform& start) {
  return Problem(points, cameras, params, start).Solve();
}

}  // namespace rockyard::vision
