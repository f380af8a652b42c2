#include "vision/cameras/camera_fields.h"

#include <cmath>
#include <span>
#include <string_view>

#include "core/check.h"

namespace rockyard::vision {
namespace {

using core::FieldInfo;
using core::FieldVisitor;
using math::Vector3;

enum ModelIndex { kCahvModel, kCahvorModel, kCahvoreModel, kBrownModel };
constexpr std::array<std::string_view, 4> kModelNames = {"cahv", "cahvor", "cahvore", "brown"};
constexpr std::array<std::string_view, 3> kTypeNames = {"perspective", "fisheye", "general"};

// Axes are printed with six digits or so.
constexpr double kUnitTolerance = 1e-3;
// The sine of the angle between rows and columns: they are square to each other but for the skew.
constexpr double kSmallestSine = 0.1;

constexpr std::string_view kGiveIt = "give it: a calibration has no default";

FieldInfo Within(std::string_view doc, double limit) {
  return {.doc = doc, .min = -limit, .max = limit, .origin = core::Origin::kSetting};
}

bool AllKnown(std::span<const double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

void Numbers(FieldVisitor& v, std::string_view name, std::span<double> values,
             const FieldInfo& info) {
  v.FixedReals(name, values, info);
  v.Require(name, AllKnown(values), "is missing", kGiveIt);
}

void UnitVector(FieldVisitor& v, std::string_view name, std::span<double> values,
                std::string_view doc) {
  Numbers(v, name, values, Within(doc, 1.0 + kUnitTolerance));
  double squared = 0.0;
  for (const double value : values) squared += value * value;
  v.Require(name, !AllKnown(values) || std::fabs(std::sqrt(squared) - 1.0) <= kUnitTolerance,
            "is not of length 1", "divide it by its length");
}

void Choose(FieldVisitor& v, std::string_view name, int& index,
            std::span<const std::string_view> names, std::string_view doc,
            std::string_view suggestion) {
  v.ChoiceOf(name, index, names, {.doc = doc, .origin = core::Origin::kSetting});
  v.Require(name, index >= 0, "is missing", suggestion);
}

Vector3 VectorOf(const Triple& triple) { return {triple[0], triple[1], triple[2]}; }
Triple TripleOf(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

// Whether pixels and directions belong to each other one by one: H' and V' have lengths and are not
// parallel.
bool SpansImage(const CameraFields& fields) {
  const Vector3 A = VectorOf(fields.A);
  const Vector3 H = VectorOf(fields.H_px);
  const Vector3 V = VectorOf(fields.V_px);
  const double focal_h = A.cross(H).norm();
  const double focal_v = A.cross(V).norm();
  return focal_h > 0.0 && focal_v > 0.0 &&
         std::fabs(H.cross(V).dot(A)) >= kSmallestSine * focal_h * focal_v;
}

void VisitLinear(FieldVisitor& v, CameraFields& fields) {
  constexpr double kFarthest_m = 1e7;
  constexpr double kLongest_px = 1e7;
  Numbers(v, "C", fields.C_m, Within("centre, m", kFarthest_m));
  UnitVector(v, "A", fields.A, "unit normal of the image plane");
  Numbers(v, "H", fields.H_px, Within("horizontal vector, pixels", kLongest_px));
  Numbers(v, "V", fields.V_px, Within("vertical vector, pixels", kLongest_px));
  const bool known = AllKnown(fields.A) && AllKnown(fields.H_px) && AllKnown(fields.V_px);
  v.Require("H", !known || SpansImage(fields), "lies in one plane with V and A",
            "give H = f_h H' + c_h A with H' across the columns of V'");
}

void VisitLens(FieldVisitor& v, CameraFields& fields) {
  constexpr double kLargest = 1e4;
  UnitVector(v, "O", fields.O, "unit vector of the optical axis");
  Numbers(v, "R", fields.R, Within("radial distortion, of 1, tau and tau^2", kLargest));
  v.Require("R", !(fields.R[0] <= -1.0), "has a first number of -1 or less: no image is left",
            "use a first number above -1");
}

void VisitPupil(FieldVisitor& v, CameraFields& fields) {
  Numbers(v, "E", fields.E_m, Within("shift of the entrance pupil, m", 10.0));
  Choose(v, "type", fields.type, kTypeNames, "which lens: linearity 1, 0 or a parameter",
         "one of: perspective, fisheye, general");
  if (fields.type != static_cast<int>(CahvoreType::kGeneral)) return;
  v.Real("linearity", fields.linearity, Within("linearity of type general", 1.0));
  v.Require("linearity", std::isfinite(fields.linearity), "is missing", kGiveIt);
}

void VisitBrown(FieldVisitor& v, CameraFields& fields) {
  Numbers(v, "position_m", fields.position_m, Within("centre, m", 1e7));
  UnitVector(v, "rotation_wxyz", fields.rotation_wxyz, "unit quaternion of X_AC");
  Numbers(v, "focal_px", fields.focal_px,
          {.doc = "fx and fy, pixels", .min = 1e-3, .max = 1e7, .origin = core::Origin::kSetting});
  Numbers(v, "centre_px", fields.centre_px, Within("cx and cy, pixels", 1e7));
  Numbers(v, "radial", fields.radial, Within("k1, k2 and k3", 1e4));
  Numbers(v, "tangential", fields.tangential, Within("p1 and p2", 1e4));
}

CameraFields LinearFields(const CameraModel& camera, const Cahv& lens, ModelIndex model) {
  CameraFields fields;
  fields.model = model;
  fields.columns = camera.size.columns;
  fields.rows = camera.size.rows;
  fields.C_m = TripleOf(lens.C);
  fields.A = TripleOf(lens.A);
  fields.H_px = TripleOf(lens.H);
  fields.V_px = TripleOf(lens.V);
  return fields;
}

CameraFields BrownFields(const CameraModel& camera, const BrownPinhole& lens) {
  const Eigen::Quaterniond rotation(lens.X_AC.linear());
  CameraFields fields;
  fields.model = kBrownModel;
  fields.columns = camera.size.columns;
  fields.rows = camera.size.rows;
  fields.position_m = TripleOf(lens.X_AC.translation());
  fields.rotation_wxyz = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  fields.focal_px = {lens.fx_px, lens.fy_px};
  fields.centre_px = {lens.cx_px, lens.cy_px};
  fields.radial = {lens.k1, lens.k2, lens.k3};
  fields.tangential = {lens.p1, lens.p2};
  return fields;
}

BrownPinhole BrownOf(const CameraFields& fields) {
  const auto& q = fields.rotation_wxyz;
  BrownPinhole lens;
  lens.X_AC.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  lens.X_AC.translation() = VectorOf(fields.position_m);
  lens.fx_px = fields.focal_px[0];
  lens.fy_px = fields.focal_px[1];
  lens.cx_px = fields.centre_px[0];
  lens.cy_px = fields.centre_px[1];
  lens.k1 = fields.radial[0];
  lens.k2 = fields.radial[1];
  lens.k3 = fields.radial[2];
  lens.p1 = fields.tangential[0];
  lens.p2 = fields.tangential[1];
  return lens;
}

AnyLens LensOf(const CameraFields& fields) {
  if (fields.model == kBrownModel) return BrownOf(fields);
  const Cahv linear{VectorOf(fields.C_m), VectorOf(fields.A), VectorOf(fields.H_px),
                    VectorOf(fields.V_px)};
  if (fields.model == kCahvModel) return linear;
  if (fields.model == kCahvorModel) return Cahvor{linear, VectorOf(fields.O), VectorOf(fields.R)};
  Cahvore lens{linear, VectorOf(fields.O), VectorOf(fields.R), VectorOf(fields.E_m)};
  lens.type = static_cast<CahvoreType>(fields.type);
  if (lens.type == CahvoreType::kGeneral) lens.general_linearity = fields.linearity;
  return lens;
}

}  // namespace

void CameraFields::Visit(FieldVisitor& v) {
  Choose(v, "model", model, kModelNames, "camera model", "one of: cahv, cahvor, cahvore, brown");
  const FieldInfo side = {.doc = "size of the image",
                          .min = 1,
                          .max = kLongestSide_px,
                          .origin = core::Origin::kSetting};
  v.Integer("columns", columns, side);
  v.Require("columns", columns > 0, "is missing", kGiveIt);
  v.Integer("rows", rows, side);
  v.Require("rows", rows > 0, "is missing", kGiveIt);
  // Of an unknown model all fields are known names, and what they lack is not told.
  const bool any = model < 0;
  if (any || model <= kCahvoreModel) VisitLinear(v, *this);
  if (any || model == kCahvorModel || model == kCahvoreModel) VisitLens(v, *this);
  if (any || model == kCahvoreModel) VisitPupil(v, *this);
  if (any || model == kBrownModel) VisitBrown(v, *this);
}

void CameraPairFields::Visit(FieldVisitor& v) {
  v.Group("left", left, "the camera whose image disparities belong to");
  v.Group("right", right, "the other camera");
}

CameraModel ModelOf(const CameraFields& fields) {
  EXPECT(fields.model >= 0 && fields.columns > 0 && fields.rows > 0);
  return {LensOf(fields), {static_cast<int>(fields.columns), static_cast<int>(fields.rows)}};
}

CameraFields FieldsOf(const CameraModel& camera) {
  EXPECT(!std::holds_alternative<LensCamera>(camera.lens));
  if (const auto* cahv = std::get_if<Cahv>(&camera.lens)) {
    return LinearFields(camera, *cahv, kCahvModel);
  }
  if (const auto* cahvor = std::get_if<Cahvor>(&camera.lens)) {
    CameraFields fields = LinearFields(camera, cahvor->linear, kCahvorModel);
    fields.O = TripleOf(cahvor->O);
    fields.R = TripleOf(cahvor->R);
    return fields;
  }
  if (const auto* brown = std::get_if<BrownPinhole>(&camera.lens)) {
    return BrownFields(camera, *brown);
  }
  const auto& cahvore = std::get<Cahvore>(camera.lens);
  CameraFields fields = LinearFields(camera, cahvore.linear, kCahvoreModel);
  fields.O = TripleOf(cahvore.O);
  fields.R = TripleOf(cahvore.R);
  fields.E_m = TripleOf(cahvore.E);
  fields.type = static_cast<int>(cahvore.type);
  fields.linearity = cahvore.general_linearity;
  return fields;
}

}  // namespace rockyard::vision
