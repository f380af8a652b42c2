// What MCAP files hold, read back, and a made-up drive: for tests of those that write them.
#pragma once

#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "replay/data.h"
#include "replay/trace_mcap.h"

namespace rockyard::replay {

struct McapRecord {
  char op = 0;
  std::string_view content;
};

template <typename Unsigned>
Unsigned NumberAt(std::string_view bytes, std::size_t place) {
  Unsigned number{};
  std::memcpy(&number, bytes.substr(place, sizeof number).data(), sizeof number);
  return number;
}

// Returns the records one after another, up to the magic behind the last one.
inline std::vector<McapRecord> McapRecords(std::string_view bytes) {
  std::vector<McapRecord> records;
  while (bytes.size() > 9) {
    const auto length = NumberAt<std::uint64_t>(bytes, 1);
    records.push_back({bytes[0], bytes.substr(9, length)});
    bytes.remove_prefix(9 + length);
  }
  return records;
}

struct ReadMessage {
  std::string topic;
  double time_s = 0.0;
  std::string text;

  nlohmann::json json() const { return nlohmann::json::parse(text); }
};

// Returns the messages of all chunks in their order.
inline std::vector<ReadMessage> McapMessagesIn(std::string_view file) {
  std::vector<ReadMessage> messages;
  std::vector<std::string> topics;  // by channel
  for (const auto& [op, chunk] : McapRecords(file.substr(8))) {
    if (op != '\x06') continue;
    for (const auto& [inner, content] : McapRecords(chunk.substr(40))) {
      if (inner == '\x04') {
        topics.emplace_back(content.substr(8, NumberAt<std::uint32_t>(content, 4)));
      } else if (inner == '\x05') {
        messages.push_back({topics.at(NumberAt<std::uint16_t>(content, 0)),
                            1e-9 * static_cast<double>(NumberAt<std::uint64_t>(content, 6)),
                            std::string(content.substr(22))});
      }
    }
  }
  return messages;
}

inline ReplayPose MomentAt(double time_s, const math::Vector3& p_W, double angle_rad) {
  ReplayPose pose;
  pose.sample.time_s = time_s;
  pose.sample.posture.X_WR.translation() = p_W;
  pose.sample.estimate = {.x_m = p_W.x() + 0.5, .y_m = p_W.y(), .heading_rad = 0.2};
  pose.joint_rad = {angle_rad, 2.0 * angle_rad};
  return pose;
}

// Two moments on flat ground, 4 m by 2 m at a height of 1 m; an arm on a rocker on the chassis.
inline ReplayData SmallDrive() {
  ReplayData data;
  data.course.x_max_m = 4.0;
  data.course.y_max_m = 2.0;
  data.ground = {.step_m = 2.0, .nx = 3, .ny = 2, .z_m = std::vector<double>(6, 1.0)};
  data.links = {{"chassis", -1, {0, 0, 0}, {0, 1, 0}, {}},
                {"rocker", 0, {0.1, 0.2, 0.3}, {0, 2, 0}, {}},
                {"arm", 1, {-0.4, 0.0, 0.1}, {1, 0, 0}, {}}};
  data.poses = {MomentAt(0.0, {0.0, 0.0, 1.0}, 0.0), MomentAt(2.5, {1.0, 0.5, 1.25}, 0.3)};
  return data;
}

inline std::vector<ReadMessage> Of(const ReplayData& data, std::string_view topic) {
  std::vector<ReadMessage> found;
  for (ReadMessage& message : McapMessagesIn(TraceMcap(data))) {
    if (message.topic == topic) found.push_back(std::move(message));
  }
  return found;
}

inline nlohmann::json EntityOf(const ReplayData& data, std::string_view topic,
                               std::size_t entity = 0) {
  return Of(data, topic).at(0).json()["entities"].at(entity);
}

inline double Real(const nlohmann::json& json) { return json.get<double>(); }
inline math::Vector3 VectorOf(const nlohmann::json& json) {
  return {Real(json["x"]), Real(json["y"]), Real(json["z"])};
}
inline Eigen::Quaterniond TurnOf(const nlohmann::json& json) {
  return {Real(json["w"]), Real(json["x"]), Real(json["y"]), Real(json["z"])};
}

inline std::vector<math::Vector3> PlacesOf(const nlohmann::json& primitives) {
  std::vector<math::Vector3> places;
  for (const nlohmann::json& one : primitives) places.push_back(VectorOf(one["pose"]["position"]));
  return places;
}

// Vectors less than a picometre apart.
MATCHER_P(IsNear, expected, "") { return (arg - expected).norm() < 1e-12; }

}  // namespace rockyard::replay
