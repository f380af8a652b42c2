// Pieces of the JSON text of a replay page.
#pragma once

#include <span>
#include <string>

#include "core/json_pieces.h"
#include "math/pose.h"
#include "replay/data.h"

namespace rockyard::replay {

// The multiple of 1 / digits that is nearest; no "-0".
std::string Rounded(double value, double digits);
// To 0.1 mm or 0.1 ms.
std::string Length(double value_m);
// To 1e-5, also for parts of unit vectors and unit quaternions.
std::string Angle(double value_rad);
// [x, y, z] to 0.1 mm.
std::string Point(const math::Vector3& p);
// Members x, y and heading.
core::JsonObject& AddPose(core::JsonObject& object, const math::Pose2& pose);
std::string PoseText(const math::Pose2& pose);

// Of the program that made it, and the machine.
std::string ProvenanceText(const core::Provenance& provenance);

// As payload.ts names them.
std::string WorldJson(const ReplayWorld& world);
std::string SensorJson(const ReplaySensor& sensor);
std::string MotionJson(std::span<const ReplayLink> links, std::span<const ReplayPose> poses);
std::string ScansJson(std::span<const ReplayScan> scans);
std::string StepsJson(std::span<const ReplayStep> steps);
std::string EyesJson(std::span<const ReplayLook> looks);
std::string EventsJson(std::span<const truth::TraceEvent> events);

}  // namespace rockyard::replay
