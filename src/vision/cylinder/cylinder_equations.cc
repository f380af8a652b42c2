#include "vision/cylinder/cylinder_equations.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/angles.h"

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
  return math::WrapAngle(OffsetOf(absent) + std::atan2(k.k1 + k.k2 - k.k3, k.k1 - k.k2 + k.k3));
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
         std::tan(0.5 * view.field_of_view_rad);
}

double CoarsestTurnAt(const ViewOfCylinder& view, double d_m) {
  return std::numbers::sqrt2 * FinestTurnAt(view, d_m);
}

double RelativeStepBySize(const ViewOfCylinder& view, double d_m) {
  return d_m * std::tan(0.5 * view.field_of_view_rad) / (view.image_width_px * view.radius_m);
}

double RelativeStepByStereo(const ViewOfCylinder& view, double d_m) {
  return 2.0 * d_m * std::tan(0.5 * view.field_of_view_rad) /
         (view.image_width_px * view.baseline_m);
}

}  // namespace rockyard::vision
