#include "vision/cameras/camera_file.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "vision/cameras/camera_fields.h"

namespace rockyard::vision {
namespace {

using core::Problem;
using core::UserError;

std::string ContentOf(const std::filesystem::path& path) {
  return core::ReadTextFile(path, kLargestCameraFile, "a file of cameras");
}

bool IsJson(std::string_view content) {
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && content[first] == '{';
}

template <typename Fields>
Fields FieldsIn(std::string_view content, std::string_view source_name) {
  Fields fields;
  const core::JsonValue json =
      core::ParseJson(content, source_name, {.max_bytes = kLargestCameraFile});
  try {
    core::ReadParams(json, fields);
  } catch (const UserError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      problem.path = fmt::format("{}: {}", source_name, problem.path);
    }
    throw UserError(std::move(problems));
  }
  return fields;
}

}  // namespace

CameraModel ParseCamera(std::string_view content, std::string_view source_name) {
  if (!IsJson(content)) return ParseCameraText(content, source_name);
  return ModelOf(FieldsIn<CameraFields>(content, source_name));
}

CameraPair ParseCameraPair(std::string_view content, std::string_view source_name) {
  if (!IsJson(content)) return ParseCameraPairText(content, source_name);
  const auto fields = FieldsIn<CameraPairFields>(content, source_name);
  return {ModelOf(fields.left), ModelOf(fields.right)};
}

CameraModel LoadCamera(const std::filesystem::path& path) {
  return ParseCamera(ContentOf(path), path.string());
}

CameraPair LoadCameraPair(const std::filesystem::path& path) {
  return ParseCameraPair(ContentOf(path), path.string());
}

core::JsonValue CameraJson(const CameraModel& camera) {
  return core::WriteParams(FieldsOf(camera));
}

core::JsonValue CameraPairJson(const CameraPair& pair) {
  return core::WriteParams(CameraPairFields{FieldsOf(pair.left), FieldsOf(pair.right)});
}

}  // namespace rockyard::vision
