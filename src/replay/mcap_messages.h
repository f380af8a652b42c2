// Messages of a trace as MCAP (trace_mcap.h), and the pieces of JSON that they share: what
// mcap_scene.cc, mcap_motion.cc and mcap_percepts.cc write. Must agree: the schemas of
// mcap_schemas.h.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json_pieces.h"
#include "core/json_text.h"
#include "math/pose.h"
#include "replay/data.h"

namespace rockyard::replay {

// A message on its way into the file.
struct McapMessage {
  std::string topic;
  std::string schema;  // its name
  double time_s = 0.0;
  std::string json;
};
using McapMessages = std::vector<McapMessage>;

// Add messages of what stands around the rover; of its shape and motion; of what it sees and
// decides, and what happens to it.
void AddSceneMessages(const ReplayData& data, McapMessages& to);
void AddMotionMessages(const ReplayData& data, McapMessages& to);
void AddPerceptMessages(const ReplayData& data, McapMessages& to);

// Returns an object of keys and their values in turn. Texts among the values must be JSON already.
inline std::string_view ValueJson(std::string_view json) { return json; }
inline std::string ValueJson(double number) { return core::JsonNumber(number); }
inline std::string ValueJson(std::int64_t number) { return std::to_string(number); }
inline std::string_view ValueJson(std::same_as<bool> auto flag) { return flag ? "true" : "false"; }
inline void AddMembers(core::JsonObject& /*object*/) {}
template <typename Value, typename... Others>
void AddMembers(core::JsonObject& object, std::string_view key, const Value& value,
                const Others&... others) {
  AddMembers(object.Add(key, ValueJson(value)), others...);
}
template <typename... Members>
std::string ObjectJson(const Members&... members) {
  core::JsonObject object;
  AddMembers(object, members...);
  return object.Text();
}

// The frames W and R. What the rover believes is written in W, too.
inline constexpr std::string_view kWorldFrame = "world";
inline constexpr std::string_view kRoverFrame = "rover";
// Returns the frame of a link; that of the chassis is R.
std::string LinkFrame(std::span<const ReplayLink> links, std::size_t link);

std::uint64_t Nanoseconds(double time_s);
Eigen::Quaterniond Yaw(double angle_rad);
// Returns how high the rover stood, where what is believed has no height of its own.
double StandingHeight(std::span<const ReplayPose> poses, double time_s);

std::string TimeJson(double time_s);
std::string VectorJson(const math::Vector3& v);
std::string TurnJson(const Eigen::Quaterniond& turn);
std::string PlaceJson(const math::Vector3& p,
                      const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity());

struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};
std::string ColourJson(const Colour& colour);

// Return primitives of a scene: a cube, or a sphere, which with unequal sizes is an ellipsoid; a
// cylinder about z, or a frustum; a line through points in W, raised by lift_m, whose `points` are
// a list in JSON.
std::string SolidJson(const std::string& place, const math::Vector3& size_m, const Colour& colour);
std::string DrumJson(const std::string& place, const math::Vector3& size_m, const Colour& colour,
                     double top_scale = 1.0);
std::string LineStripJson(const std::string& points, double lift_m, double width_px,
                          const Colour& colour);

// What an entity of a scene is made of, each as JSON.
struct SceneParts {
  std::vector<std::string> cubes = {};
  std::vector<std::string> spheres = {};
  std::vector<std::string> cylinders = {};
  std::vector<std::string> lines = {};
  std::vector<std::string> triangles = {};
};
// Returns what is drawn in a frame until an entity with its name replaces it.
std::string EntityJson(double time_s, std::string_view frame, std::string_view name,
                       const SceneParts& parts);
// Adds an update of a scene; `deletions` is a list in JSON.
void AddSceneUpdate(std::string_view topic, double time_s, const std::vector<std::string>& entities,
                    McapMessages& to, const std::string& deletions = "[]");

// Rows of 32-bit floats, as point clouds and grids hold them.
class PackedRows {
 public:
  explicit PackedRows(std::vector<std::string_view> names) : names_(std::move(names)) {}

  // Adds a row; it must have a number for each name.
  void Add(std::initializer_list<double> row);

  std::int64_t stride_bytes() const;
  std::string fields() const;  // a list in JSON
  std::string data() const;    // base64, in quotes

 private:
  std::vector<std::string_view> names_;
  std::vector<float> numbers_;
};

}  // namespace rockyard::replay
