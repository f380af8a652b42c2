#include "vision/cameras/camera_fields.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "core/check.h"

namespace rockyard::vision {
namespace {

using core::FieldInfo;
using core::FieldVisitor;
using core::Setting;

using math::Vector3;

// Places in kModelNames: both lists have one order. Models with C, A, H and V must come first, as
// Visit compares places.
enum ModelIndex { kCahvModel, kCahvorModel, kCahvoreModel, kBrownModel };
constexpr std::array<std::string_view, 4> kModelNames = {"cahv", "cahvor", "cahvore", "brown"};
// In the order of CahvoreType; LineSorter::TakeType (camera_text.cc) writes the same names.
constexpr std::array<std::string_view, 3> kTypeNames = {"perspective", "fisheye", "general"};

// The tolerance of a unit vector's length: files print axes with six digits or so.
constexpr double kUnitTolerance = 1e-3;
// The smallest sine of the angle between rows and columns, which are square but for the skew.
constexpr double kSmallestSine = 0.1;

FieldInfo Within(std::string_view doc, double limit) { return core::Setting(doc, {-limit, limit}); }

bool AllKnown(std::span<const double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

// A visitor that remembers which fields are missing, so that RequireAll tells them in one problem.
class CalibrationFields {
 public:
  explicit CalibrationFields(FieldVisitor& v) : v_(v) {}

  void Numbers(std::string_view name, std::span<double> values, const FieldInfo& info) {
    v_.FixedReals(name, values, info);
    Note(name, AllKnown(values));
  }

  void UnitVector(std::string_view name, std::span<double> values, std::string_view doc) {
    Numbers(name, values, Within(doc, 1.0 + kUnitTolerance));
    double squared = 0.0;
    for (const double value : values) squared += value * value;
    Require(name, !AllKnown(values) || std::fabs(std::sqrt(squared) - 1.0) <= kUnitTolerance,
            "is not of length 1", "divide it by its length");
  }

  void Number(std::string_view name, double& value, const FieldInfo& info) {
    v_.Real(name, value, info);
    Note(name, std::isfinite(value));
  }

  void Side(std::string_view name, std::int64_t& value) {
    v_.Integer(name, value, Setting("size of the image, pixels", {1, kLongestSide_px}));
    Note(name, value > 0);
  }

  void Choose(std::string_view name, int& index, std::span<const std::string_view> names,
              std::string_view doc) {
    v_.ChoiceOf(name, index, names, Setting(doc));
    Note(name, index >= 0);
  }

  // Requires a condition on known fields; callers pass true where a field is missing.
  void Require(std::string_view name, bool holds, std::string_view reason,
               std::string_view suggestion) {
    v_.Require(name, holds, reason, suggestion);
  }

  void RequireAll() {
    const std::string reason = others_.empty() ? "is missing" : "is missing, as well as " + others_;
    v_.Require(first_, first_.empty(), reason, "give all of it: a calibration has no defaults");
  }

 private:
  void Note(std::string_view name, bool known) {
    if (known) return;
    if (first_.empty()) {
      first_ = name;
    } else {
      others_ += others_.empty() ? "" : ", ";
      others_ += name;
    }
  }

  FieldVisitor& v_;
  std::string_view first_;
  std::string others_;
};

Vector3 VectorOf(const Triple& triple) { return {triple[0], triple[1], triple[2]}; }
Triple TripleOf(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

// Returns whether each pixel has a direction of its own: the focal lengths are not 0, and rows and
// columns are not near to parallel.
bool SpansImage(const CameraFields& fields) {
  const Vector3 A = VectorOf(fields.A);
  const Vector3 H = VectorOf(fields.H_px);
  const Vector3 V = VectorOf(fields.V_px);
  const double focal_h = A.cross(H).norm();
  const double focal_v = A.cross(V).norm();
  return focal_h > 0.0 && focal_v > 0.0 &&
         std::fabs(H.cross(V).dot(A)) >= kSmallestSine * focal_h * focal_v;
}

void VisitLinear(CalibrationFields& v, CameraFields& fields) {
  constexpr double kFarthest_m = 1e7;
  constexpr double kLongest_px = 1e7;
  v.Numbers("C", fields.C_m, Within("centre, m", kFarthest_m));
  v.UnitVector("A", fields.A, "unit normal of the image plane");
  v.Numbers("H", fields.H_px, Within("horizontal vector, pixels", kLongest_px));
  v.Numbers("V", fields.V_px, Within("vertical vector, pixels", kLongest_px));
  const bool known = AllKnown(fields.A) && AllKnown(fields.H_px) && AllKnown(fields.V_px);
  v.Require("H", !known || SpansImage(fields), "lies in one plane with V and A",
            "give H = f_h H' + c_h A with H' across the columns of V'");
}

void VisitLens(CalibrationFields& v, CameraFields& fields) {
  constexpr double kLargest = 1e4;
  v.UnitVector("O", fields.O, "unit vector of the optical axis");
  v.Numbers("R", fields.R, Within("radial distortion, of 1, tau and tau^2", kLargest));
  v.Require("R", !(fields.R[0] <= -1.0), "has a first number of -1 or less: no image is left",
            "use a first number above -1");
}

void VisitPupil(CalibrationFields& v, CameraFields& fields) {
  v.Numbers("E", fields.E_m, Within("shift of the entrance pupil, m", 10.0));
  v.Choose("type", fields.type, kTypeNames, "which lens: linearity 1, 0 or a parameter");
  if (fields.type != static_cast<int>(CahvoreType::kGeneral)) return;
  v.Number("linearity", fields.linearity, Within("linearity of type general", 1.0));
}

void VisitBrown(CalibrationFields& v, CameraFields& fields) {
  v.Numbers("position_m", fields.position_m, Within("centre, m", 1e7));
  v.UnitVector("rotation_wxyz", fields.rotation_wxyz, "unit quaternion of X_AC");
  v.Numbers("focal_px", fields.focal_px, Setting("fx and fy, pixels", {1e-3, 1e7}));
  v.Numbers("centre_px", fields.centre_px, Within("cx and cy, pixels", 1e7));
  v.Numbers("radial", fields.radial, Within("k1, k2 and k3", 1e4));
  v.Numbers("tangential", fields.tangential, Within("p1 and p2", 1e4));
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

void CameraFields::Visit(FieldVisitor& visitor) {
  CalibrationFields v(visitor);
  v.Choose("model", model, kModelNames, "camera model");
  // For an unknown model only the missing model is told; all fields are visited, so that their
  // names are known.
  const bool any = model < 0;
  if (any) v.RequireAll();
  v.Side("columns", columns);
  v.Side("rows", rows);
  if (any || model <= kCahvoreModel) VisitLinear(v, *this);
  if (any || model == kCahvorModel || model == kCahvoreModel) VisitLens(v, *this);
  if (any || model == kCahvoreModel) VisitPupil(v, *this);
  if (any || model == kBrownModel) VisitBrown(v, *this);
  v.RequireAll();
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
