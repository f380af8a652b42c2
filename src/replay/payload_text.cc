#include "replay/payload_text.h"

#include <array>
#include <cmath>

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonNumber;
using core::JsonObject;

constexpr double kLengthDigits = 1e4;
constexpr double kAngleDigits = 1e5;

}  // namespace

std::string Rounded(double value, double digits) {
  const double rounded = std::round(value * digits) / digits;
  return JsonNumber(rounded == 0.0 ? 0.0 : rounded);
}

std::string Length(double value_m) { return Rounded(value_m, kLengthDigits); }
std::string Angle(double value_rad) { return Rounded(value_rad, kAngleDigits); }

std::string Point(const math::Vector3& p) {
  return JsonList(std::array{Length(p.x()), Length(p.y()), Length(p.z())});
}

JsonObject& AddPose(JsonObject& object, const math::Pose2& pose) {
  return object.Add("x", Length(pose.x_m))
      .Add("y", Length(pose.y_m))
      .Add("heading", Angle(pose.heading_rad));
}

std::string PoseText(const math::Pose2& pose) {
  JsonObject object;
  return AddPose(object, pose).Text();
}

std::string ProvenanceText(const core::Provenance& p) {
  return JsonObject()
      .AddText("version", p.version)
      .AddText("commit", p.commit)
      .AddText("compiler", p.compiler)
      .AddText("flags", p.flags)
      .AddText("build_type", p.build_type)
      .AddText("host", p.host)
      .AddText("cpu_level", p.cpu_level)
      .Text();
}

}  // namespace rockyard::replay
