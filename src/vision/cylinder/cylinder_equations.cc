#include "vision/cylinder/cylinder_equations.h"

#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"
#include "vision/cameras/rectification.h"

namespace rockyard::vision {

namespace {

struct OrderRow {
  CylinderColour left;
  CylinderColour middle;
  CylinderColour right;
};

// In the order of AbsentQuadrant.
constexpr std::array<OrderRow, 4> kOrders = {
    OrderRow{CylinderColour::kMagenta, CylinderColour::kBlue, CylinderColour::kMagenta},
    OrderRow{CylinderColour::kBlue, CylinderColour::kMagenta, CylinderColour::kRed},
    OrderRow{CylinderColour::kMagenta, CylinderColour::kRed, CylinderColour::kMagenta},
    OrderRow{CylinderColour::kRed, CylinderColour::kMagenta, CylinderColour::kBlue},
};

bool Fits(const OrderRow& row, const ColourOrder& seen) {
  return row.middle == seen.middle && row.left == seen.left.value_or(row.left) &&
         row.right == seen.right.value_or(row.right);
}

}  // namespace

double OffsetOf(AbsentQuadrant absent) {
  return 0.5 * std::numbers::pi * static_cast<double>(absent);
}

RowChoice ChooseRow(const ColourOrder& order) {
  RowChoice choice;
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    if (!Fits(kOrders[i], order)) continue;
    if (choice.absent) return {std::nullopt, OrderDoubt::kAnyPink};
    choice.absent = static_cast<AbsentQuadrant>(i);
  }
  return choice;
}

double OrientationOf(AbsentQuadrant absent, const ColourQuantities& k) {
  EXPECT(k.k1 > 0.0 && k.k2 >= 0.0 && k.k3 >= 0.0);
  return math::WrapAngle(OffsetOf(absent) + math::Atan2(k.k1 + k.k2 - k.k3, k.k1 - k.k2 + k.k3));
}

double DistanceBySize(double focal_px, double radius_m, double m_px) {
  EXPECT(m_px > 0.0);
  return 2.0 * focal_px * radius_m / m_px;
}

double DistanceBySizeNear(double focal_px, double radius_m, double m_px) {
  const double d0_m = DistanceBySize(focal_px, radius_m, m_px);
  return 0.5 * (d0_m + std::sqrt(d0_m * d0_m + 4.0 * radius_m * radius_m));
}

double FinestTurn(double m_px) { return 2.0 / m_px; }

double CoarsestTurn(double m_px) { return std::numbers::sqrt2 * FinestTurn(m_px); }

double FinestTurnAt(const ViewOfCylinder& view, double d_m) {
  return 2.0 / view.image_width_px * (d_m / view.radius_m - view.radius_m / d_m) *
         math::Tan(0.5 * view.field_of_view_rad);
}

double CoarsestTurnAt(const ViewOfCylinder& view, double d_m) {
  return std::numbers::sqrt2 * FinestTurnAt(view, d_m);
}

double RelativeStepBySize(const ViewOfCylinder& view, double d_m) {
  return d_m * math::Tan(0.5 * view.field_of_view_rad) / (view.image_width_px * view.radius_m);
}

double RelativeStepByStereo(const ViewOfCylinder& view, double d_m) {
  return 2.0 * d_m * math::Tan(0.5 * view.field_of_view_rad) /
         (view.image_width_px * view.baseline_m);
}

namespace {

// sin^2 of the angle between two lines of sight below which they count as parallel.
constexpr double kParallel = 1e-12;

// Returns the middle of the shortest line between two lines of sight, p_i = o_i + s_i d_i.
std::optional<math::Vector3> NearestPoint(const Ray& a, const Ray& b) {
  const math::Vector3 between = b.origin - a.origin;
  const double cosine = a.direction.dot(b.direction);
  const double sine2 = 1.0 - cosine * cosine;
  if (sine2 < kParallel) return std::nullopt;
  const double along_a = between.dot(a.direction - cosine * b.direction) / sine2;
  const double along_b = between.dot(cosine * a.direction - b.direction) / sine2;
  if (along_a <= 0.0 || along_b <= 0.0) return std::nullopt;
  return 0.5 * (a.origin + along_a * a.direction + b.origin + along_b * b.direction);
}

std::optional<math::Vector3> AnyPointSeenAt(const ColourPair& pair, const Pixel& left_px,
                                            const Pixel& right_px) {
  const auto left = BackProject(pair.left_camera, left_px);
  const auto right = BackProject(pair.right_camera, right_px);
  if (!left || !right) return std::nullopt;
  return NearestPoint(*left, *right);
}

std::optional<math::Vector3> AlignedPointSeenAt(const RectifiedPair& aligned, const Pixel& left_px,
                                                const Pixel& right_px) {
  const auto point = Triangulate(aligned.left, aligned.right, left_px, left_px.x() - right_px.x());
  if (!point) return std::nullopt;
  return point->p_A;
}

}  // namespace

std::optional<EyeGeometry> GeometryOf(const ColourPair& pair) {
  const auto middle = BackProject(pair.left_camera, MiddleOf(pair.left_camera.size));
  if (!middle) return std::nullopt;
  EyeGeometry eyes;
  eyes.centre_L = CentreOf(pair.left_camera);
  const math::Vector3 right_centre_L = CentreOf(pair.right_camera);
  eyes.baseline_m = (right_centre_L - eyes.centre_L).norm();
  eyes.middle_L = 0.5 * (eyes.centre_L + right_centre_L);
  eyes.forward_L = middle->direction;
  if (const auto* linear = std::get_if<Cahv>(&pair.left_camera.lens)) {
    eyes.forward_L = linear->A.normalized();
  }
  PixelJacobian by_point;
  const auto again = Project(pair.left_camera, middle->origin + middle->direction, &by_point);
  if (!again) return std::nullopt;
  // by_point is taken one metre along the ray; the factor makes it one metre of depth.
  eyes.focal_px = by_point.row(0).norm() * middle->direction.dot(eyes.forward_L);
  const Eigen::Matrix<double, 3, 2> by_pixel = DirectionByPixel(by_point);
  eyes.right_L = by_pixel.col(0).normalized();
  eyes.up_L = -by_pixel.col(1).normalized();
  eyes.aligned = AlignedPair(pair.left_camera, pair.right_camera);
  if (eyes.aligned) eyes.focal_px = eyes.aligned->focal_px;
  return eyes;
}

std::optional<SeenPoint> PointSeenAt(const ColourPair& pair, const EyeGeometry& eyes,
                                     const Pixel& left_px, const Pixel& right_px) {
  const auto p_L = eyes.aligned ? AlignedPointSeenAt(*eyes.aligned, left_px, right_px)
                                : AnyPointSeenAt(pair, left_px, right_px);
  if (!p_L) return std::nullopt;
  const double depth_m = (*p_L - eyes.centre_L).dot(eyes.forward_L);
  if (!(depth_m > 0.0)) return std::nullopt;
  return SeenPoint{*p_L, depth_m};
}

}  // namespace rockyard::vision
