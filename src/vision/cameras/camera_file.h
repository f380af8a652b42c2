// Files of one camera or of a stereo pair, as JSON (camera_fields.h) or as the text of flight
// calibrations (camera_text.h). The commands for stereo, odometry and cylinders from files read
// pairs; `rockyard calibrate` and the commands that render images write them. No scenario names
// such a file, so that no record depends on it; people keep these files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/json_value.h"
#include "vision/cameras/camera_text.h"

namespace rockyard::vision {

// Returns the camera in a file: JSON where its first character that is no blank is `{`, else the
// text form. Throws UserError with everything that is wrong, each with the file, the place in it (a
// JSON path such as left.C[1], or a line) and what would be right; also where the file is missing,
// unreadable, no regular file, or longer than kLargestCameraFile.
CameraModel LoadCamera(const std::filesystem::path& path);

// Returns the pair in a file, read as LoadCamera reads a camera. The JSON is
// {"left": {...}, "right": {...}}.
CameraPair LoadCameraPair(const std::filesystem::path& path);

// Do with the content of a file what LoadCamera and LoadCameraPair do with the file.
CameraModel ParseCamera(std::string_view content, std::string_view source_name);
CameraPair ParseCameraPair(std::string_view content, std::string_view source_name);

// Return the JSON of a camera or a pair. It reads back to the same bits, but for a pinhole's
// attitude, which a quaternion holds within 1e-15.
core::JsonValue CameraJson(const CameraModel& camera);
core::JsonValue CameraPairJson(const CameraPair& pair);

}  // namespace rockyard::vision
