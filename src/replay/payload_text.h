// Pieces of the JSON text of a replay page (ReplayJson), whose parts several files here write;
// trace files take the provenance.
#pragma once

#include <span>
#include <string>

#include "core/json_pieces.h"
#include "math/pose.h"
#include "replay/data.h"

namespace rockyard::replay {

// Returns the nearest multiple of 1 / digits, never "-0"; null where the value is not finite.
std::string Rounded(double value, double digits);
// Returns a length to 0.1 mm; also a time to 0.1 ms, or a curvature to 1e-4 per metre.
std::string Length(double value_m);
// Returns an angle, or a part of a unit vector or unit quaternion, to 1e-5.
std::string Angle(double value_rad);
// Returns [x, y, z] to 0.1 mm.
std::string Point(const math::Vector3& p);
// Adds the members x, y and heading; PoseText returns an object of these three.
core::JsonObject& AddPose(core::JsonObject& object, const math::Pose2& pose);
std::string PoseText(const math::Pose2& pose);

// Returns the program that made a page or file, and the machine.
std::string ProvenanceText(const core::Provenance& provenance);

// Return members of the page's data. Must agree: src/web/replay/payload.ts.
std::string WorldJson(const ReplayWorld& world);
std::string SensorJson(const ReplaySensor& sensor);
std::string MotionJson(std::span<const ReplayLink> links, std::span<const ReplayPose> poses);
std::string ScansJson(std::span<const ReplayScan> scans);
std::string StepsJson(std::span<const ReplayStep> steps);
std::string EyesJson(std::span<const ReplayLook> looks);
// `every`: one of so many overlays of the drive is there already.
std::string OverlaysJson(std::span<const ReplayOverlay> overlays, std::size_t every);
std::string EventsJson(std::span<const truth::TraceEvent> events);

}  // namespace rockyard::replay
