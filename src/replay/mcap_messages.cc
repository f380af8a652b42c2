#include "replay/mcap_messages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "core/base64.h"
#include "core/check.h"

namespace rockyard::replay {
namespace {

using core::JsonList;

constexpr double kNanosecondsOfSecond = 1e9;

}  // namespace

std::string LinkFrame(std::span<const ReplayLink> links, std::size_t link) {
  return std::string(kRoverFrame) + (link == 0 ? "" : "/" + links[link].name);
}

std::uint64_t Nanoseconds(double time_s) {
  return static_cast<std::uint64_t>(std::llround(std::max(0.0, time_s) * kNanosecondsOfSecond));
}

Eigen::Quaterniond Yaw(double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, math::Vector3::UnitZ()));
}

double StandingHeight(std::span<const ReplayPose> poses, double time_s) {
  if (poses.empty()) return 0.0;
  const auto after = std::upper_bound(
      poses.begin(), poses.end(), time_s,
      [](double time, const ReplayPose& pose) { return time < pose.sample.time_s; });
  const ReplayPose& last = after == poses.begin() ? *after : *std::prev(after);
  return last.sample.posture.X_WR.translation().z();
}

std::string TimeJson(double time_s) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const auto time_ns = static_cast<std::int64_t>(Nanoseconds(time_s));
  return ObjectJson("sec", time_ns / kSecond_ns, "nsec", time_ns % kSecond_ns);
}

std::string VectorJson(const math::Vector3& v) {
  return ObjectJson("x", v.x(), "y", v.y(), "z", v.z());
}

std::string TurnJson(const Eigen::Quaterniond& turn) {
  return ObjectJson("x", turn.x(), "y", turn.y(), "z", turn.z(), "w", turn.w());
}

std::string PlaceJson(const math::Vector3& p, const Eigen::Quaterniond& turn) {
  return ObjectJson("position", VectorJson(p), "orientation", TurnJson(turn));
}

std::string ColourJson(const Colour& colour) {
  return ObjectJson("r", colour.red, "g", colour.green, "b", colour.blue, "a", colour.alpha);
}

std::string SolidJson(const std::string& place, const math::Vector3& size_m, const Colour& colour) {
  return ObjectJson("pose", place, "size", VectorJson(size_m), "color", ColourJson(colour));
}

std::string DrumJson(const std::string& place, const math::Vector3& size_m, const Colour& colour,
                     double top_scale) {
  return ObjectJson("pose", place, "size", VectorJson(size_m), "bottom_scale", 1.0, "top_scale",
                    top_scale, "color", ColourJson(colour));
}

std::string LineStripJson(const std::string& points, double lift_m, double width_px,
                          const Colour& colour) {
  constexpr std::int64_t kStrip = 0;  // of foxglove.LineType
  return ObjectJson("type", kStrip, "pose", PlaceJson({0.0, 0.0, lift_m}), "thickness", width_px,
                    "scale_invariant", true, "points", points, "color", ColourJson(colour),
                    "colors", "[]", "indices", "[]");
}

std::string EntityJson(double time_s, std::string_view frame, std::string_view name,
                       const SceneParts& parts) {
  const std::string for_ever = TimeJson(0.0);
  return ObjectJson("timestamp", TimeJson(time_s), "frame_id", core::QuoteJson(frame), "id",
                    core::QuoteJson(name), "lifetime", for_ever, "frame_locked", true, "metadata",
                    "[]", "arrows", "[]", "cubes", JsonList(parts.cubes), "spheres",
                    JsonList(parts.spheres), "cylinders", JsonList(parts.cylinders), "lines",
                    JsonList(parts.lines), "triangles", JsonList(parts.triangles), "texts", "[]",
                    "models", "[]");
}

void AddSceneUpdate(std::string_view topic, double time_s, const std::vector<std::string>& entities,
                    McapMessages& to, const std::string& deletions) {
  to.push_back({std::string(topic), "foxglove.SceneUpdate", time_s,
                ObjectJson("deletions", deletions, "entities", JsonList(entities))});
}

void PackedRows::Add(std::initializer_list<double> row) {
  EXPECT(row.size() == names_.size());
  for (const double number : row) numbers_.push_back(static_cast<float>(number));
}

std::int64_t PackedRows::stride_bytes() const {
  return static_cast<std::int64_t>(names_.size() * sizeof(float));
}

std::string PackedRows::fields() const {
  constexpr std::int64_t kFloat32 = 7;  // of foxglove.NumericType
  std::int64_t number = 0;
  return JsonList(names_, [&](std::string_view name) {
    const std::int64_t offset = number++ * std::int64_t{sizeof(float)};
    return ObjectJson("name", core::QuoteJson(name), "offset", offset, "type", kFloat32);
  });
}

std::string PackedRows::data() const {
  static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");
  const auto bytes = std::as_bytes(std::span(numbers_));
  return core::QuoteJson(
      core::Base64(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
}

}  // namespace rockyard::replay
