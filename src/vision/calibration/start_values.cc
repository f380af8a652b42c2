#include "vision/calibration/start_values.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "math/decompositions.h"
#include "math/functions.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {
namespace {

using core::Problem;
using Eigen::MatrixXd;
using math::Transform;
using math::Vector3;

constexpr double kLeastTilt_deg = 5.0;
// The least spread of surveyed points across the plane that fits best, over the smaller spread
// along it.
constexpr double kLeastDepth = 0.02;

// Returns the matrix that shifts `points`, homogeneous columns, to their mean and scales them to a
// root mean square of 1 a coordinate.
MatrixXd Normalization(const MatrixXd& points) {
  const Eigen::Index size = points.rows() - 1;
  const Eigen::VectorXd mean = points.topRows(size).rowwise().mean();
  double squares = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    squares += (points.col(i).head(size) - mean).squaredNorm();
  }
  const double scale = std::sqrt(static_cast<double>(size * points.cols()) / squares);
  MatrixXd matrix = MatrixXd::Identity(size + 1, size + 1);
  matrix.topLeftCorner(size, size) *= scale;
  matrix.topRightCorner(size, 1) = -scale * mean;
  return matrix;
}

template <class Points>
MatrixXd Homogeneous(const Points& points) {
  const Eigen::Index size = points.front().size();
  MatrixXd columns = MatrixXd::Ones(size + 1, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)).head(size) = points[i];
  }
  return columns;
}

// Returns the matrix P of three rows p1, p2, p3 with pixel ~ P point for homogeneous columns: the
// eigenvector of the least eigenvalue of the equations p1 X - u p3 X = 0, p2 X - v p3 X = 0. Sizes
// are dynamic, and the eigenvector is computed as a singular vector, because Eigen's other
// templates compile for half a minute.
MatrixXd DirectLinear(const MatrixXd& points, const MatrixXd& pixels) {
  const Eigen::Index side = points.rows();
  const MatrixXd of_points = Normalization(points);
  const Eigen::Matrix3d of_pixels = Normalization(pixels);
  MatrixXd gram = MatrixXd::Zero(3 * side, 3 * side);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::VectorXd X = of_points * points.col(i);
    const Vector3 pixel = of_pixels * pixels.col(i);
    MatrixXd rows = MatrixXd::Zero(3 * side, 2);
    rows.col(0).head(side) = X;
    rows.col(1).segment(side, side) = X;
    rows.col(0).tail(side) = -pixel.x() * X;
    rows.col(1).tail(side) = -pixel.y() * X;
    gram += rows * rows.transpose();
  }
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(gram, Eigen::ComputeFullV);
  const MatrixXd matrix = svd.matrixV().rightCols(1).reshaped(side, 3).transpose();
  return of_pixels.inverse() * matrix * of_points;
}

std::vector<Vector3> PointsOf(const ChessboardParams& board, const std::vector<Transform>& X_AT) {
  std::vector<Vector3> points;
  for (const Transform& pose : X_AT) {
    for (std::size_t i = 0; i < board.corners(); ++i) {
      points.emplace_back(pose * CornerPosition(board, i));
    }
  }
  return points;
}

Cahvor CameraFrom(const std::vector<Vector3>& points, const std::vector<CornerImage>& images) {
  std::vector<Pixel> pixels;
  for (const CornerImage& image : images) pixels.insert(pixels.end(), image.begin(), image.end());
  const Cahv linear = LinearCamera(points, pixels);
  return {linear, linear.A, Vector3::Zero()};
}

Problem ParallelTargets() {
  return {"targets",
          fmt::format("show parallel planes, within {:g} deg: the focal length cannot be told from "
                      "the distance",
                      kLeastTilt_deg),
          "tilt the target by 20 to 45 deg, about different axes, from image to image"};
}

// Returns the largest angle between the normals of two targets.
double LargestTilt_deg(const std::vector<Transform>& X_AT) {
  double largest_rad = 0.0;
  for (const Transform& a : X_AT) {
    for (const Transform& b : X_AT) {
      const double cosine = std::min(1.0, std::fabs(a.linear().col(2).dot(b.linear().col(2))));
      largest_rad = std::max(largest_rad, math::Acos(cosine));
    }
  }
  return largest_rad * 180.0 / std::numbers::pi;
}

core::Result<BundleState> FromPlanes(const CalibrationData& data) {
  const std::vector<CornerImage>& images = data.corners.front();
  if (images.size() < 3) {
    return std::vector<Problem>{{"targets",
                                 fmt::format("are seen in {} images, too few for a camera of any "
                                             "principal point",
                                             images.size()),
                                 "give at least 3 images, better 10, or survey the targets"}};
  }
  const Pixel middle = MiddleOf(data.size);
  std::vector<Eigen::Matrix3d> homographies;
  homographies.reserve(images.size());
  for (const CornerImage& image : images) {
    homographies.push_back(PlaneHomography(data.board, image));
  }
  const std::optional<double> focal_px = FocalLength(homographies, middle);
  if (!focal_px) return std::vector<Problem>{ParallelTargets()};
  BundleState state;
  for (const Eigen::Matrix3d& homography : homographies) {
    state.X_AT.push_back(PoseOfBoard(homography, *focal_px, middle));
  }
  if (LargestTilt_deg(state.X_AT) < kLeastTilt_deg) return std::vector<Problem>{ParallelTargets()};
  const Cahv first{{0, 0, 0}, {0, 0, 1}, {*focal_px, 0, middle.x()}, {0, *focal_px, middle.y()}};
  state.cameras.push_back({first, first.A, Vector3::Zero()});
  const std::vector<Vector3> points = PointsOf(data.board, state.X_AT);
  for (std::size_t camera = 1; camera < data.corners.size(); ++camera) {
    state.cameras.push_back(CameraFrom(points, data.corners[camera]));
  }
  return state;
}

bool LieInOnePlane(const std::vector<Vector3>& points) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3& point : points) scatter += (point - mean) * (point - mean).transpose();
  const Vector3 spread = math::SingularValuesOf(scatter).values;
  return spread[2] < kLeastDepth * kLeastDepth * spread[1];
}

core::Result<BundleState> FromSurvey(const CalibrationData& data) {
  BundleState state;
  state.X_AT = data.surveyed_X_AT;
  const std::vector<Vector3> points = PointsOf(data.board, state.X_AT);
  if (LieInOnePlane(points)) {
    return std::vector<Problem>{
        {"targets", "lie in one plane: a camera cannot be told from them",
         "survey targets at different distances or tilted against each other"}};
  }
  for (const std::vector<CornerImage>& images : data.corners) {
    state.cameras.push_back(CameraFrom(points, images));
  }
  return state;
}

}  // namespace

Eigen::Matrix3d PlaneHomography(const ChessboardParams& board, const CornerImage& corners) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.emplace_back(CornerPosition(board, i).head<2>());
  }
  return DirectLinear(Homogeneous(points), Homogeneous(corners));
}

std::optional<double> FocalLength(const std::vector<Eigen::Matrix3d>& homographies,
                                  const Pixel& middle) {
  // Each of the two conditions is a / f^2 + b = 0; f^2 = -(sum a a) / (sum a b).
  double aa = 0.0;
  double ab = 0.0;
  for (const Eigen::Matrix3d& homography : homographies) {
    Eigen::Matrix3d centred = homography;
    centred.topRows<2>() -= middle * homography.row(2);
    const Vector3 m1 = centred.col(0) / centred.col(0).norm();
    const Vector3 m2 = centred.col(1) / centred.col(0).norm();
    const double a1 = m1.head<2>().dot(m2.head<2>());
    const double b1 = m1.z() * m2.z();
    const double a2 = m1.head<2>().squaredNorm() - m2.head<2>().squaredNorm();
    const double b2 = m1.z() * m1.z() - m2.z() * m2.z();
    aa += a1 * a1 + a2 * a2;
    ab += a1 * b1 + a2 * b2;
  }
  const double focal_px = std::sqrt(-aa / ab);
  // No lens is wider than 170 deg or narrower than half a degree, and NaN is none.
  if (!(focal_px > 0.1 * middle.x() && focal_px < 200.0 * middle.x())) return std::nullopt;
  return focal_px;
}

Transform PoseOfBoard(const Eigen::Matrix3d& homography, double focal_px, const Pixel& middle) {
  Eigen::Matrix3d columns = homography;
  columns.topRows<2>() -= middle * homography.row(2);
  columns.topRows<2>() /= focal_px;
  columns *= 2.0 / (columns.col(0).norm() + columns.col(1).norm());
  if (columns(2, 2) < 0.0) columns = -columns;
  Eigen::Matrix3d pair = columns;
  pair.col(2).setZero();
  const math::SingularValues svd = math::SingularValuesOf(pair);
  const Eigen::Matrix3d axes = svd.U * svd.V.transpose();
  Transform X_AT = Transform::Identity();
  X_AT.linear().leftCols<2>() = axes.leftCols<2>();
  X_AT.linear().col(2) = axes.col(0).cross(axes.col(1));
  X_AT.translation() = columns.col(2);
  return X_AT;
}

Cahv LinearCamera(const std::vector<Vector3>& points_A, const std::vector<Pixel>& pixels) {
  Eigen::Matrix<double, 3, 4> P = DirectLinear(Homogeneous(points_A), Homogeneous(pixels));
  P /= P.block<1, 3>(2, 0).norm();
  double depth = 0.0;
  for (const Vector3& point : points_A) depth += P.row(2).dot(point.homogeneous());
  if (depth < 0.0) P = -P;
  const Eigen::Matrix3d M = P.leftCols<3>();
  return {-M.inverse() * P.col(3), M.row(2), M.row(0), M.row(1)};
}

core::Result<BundleState> StartValues(const CalibrationData& data) {
  return data.surveyed_X_AT.empty() ? FromPlanes(data) : FromSurvey(data);
}

}  // namespace rockyard::vision
