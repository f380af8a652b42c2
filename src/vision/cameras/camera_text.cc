#include "vision/cameras/camera_text.h"

#include <fmt/format.h>

#include <utility>

#include "core/archive.h"
#include "core/check.h"
#include "core/error.h"
#include "vision/cameras/camera_fields.h"
#include "vision/cameras/camera_text_lines.h"

namespace rockyard::vision {
namespace {

using core::JsonValue;
using core::Problem;

// A problem of a field, told by its line.
Problem OfLine(const Problem& problem, const CameraBlock& block, std::string_view source_name) {
  const std::string_view field = std::string_view(problem.path).substr(0, problem.path.find('['));
  const auto line = block.lines.find(field);
  const std::string place = line == block.lines.end() ? fmt::format("line {} ff.", block.line)
                                                      : fmt::format("line {}", line->second);
  return {std::string(source_name), fmt::format("{}: {} {}", place, problem.path, problem.reason),
          problem.suggestion};
}

CameraModel ModelIn(const CameraBlock& block, std::string_view source_name) {
  // The other types have theirs by nature, and say so or say 0.
  JsonValue json = block.fields;
  const JsonValue* type = json.Find("type");
  if (type != nullptr && type->text() != "general") json.Erase("linearity");
  CameraFields fields;
  try {
    core::ReadParams(json, fields);
  } catch (const core::UserError& error) {
    std::vector<Problem> problems;
    for (const Problem& problem : error.problems()) {
      problems.push_back(OfLine(problem, block, source_name));
    }
    throw core::UserError(std::move(problems));
  }
  return ModelOf(fields);
}

CameraBlocks BlocksIn(std::string_view text, std::string_view source_name) {
  if (text.size() > kLargestCameraFile) {
    throw core::UserError(
        std::string(source_name),
        fmt::format("has {} bytes, more than the {} allowed", text.size(), kLargestCameraFile),
        "check that this is the right file");
  }
  CameraBlocks blocks = SortLines(text, source_name);
  if (!blocks.problems.empty()) throw core::UserError(std::move(blocks.problems));
  return blocks;
}

std::string Commented(std::string_view comment) {
  std::string lines;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    lines += fmt::format("# {}\n", comment.substr(0, end));
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return lines;
}

std::string ModelLine(const CameraModel& camera) {
  if (std::holds_alternative<Cahv>(camera.lens)) return "Model = CAHV = perspective, linear\n";
  const auto* cahvore = std::get_if<Cahvore>(&camera.lens);
  if (cahvore == nullptr) return "Model = CAHVOR = perspective, distortion\n";
  switch (cahvore->type) {
    case CahvoreType::kPerspective:
      return "Model = CAHVORE1 = perspective, distortion, pupil\n";
    case CahvoreType::kFisheye:
      return "Model = CAHVORE2 = fish-eye\n";
    case CahvoreType::kGeneral:
      break;
  }
  return fmt::format("Model = CAHVORE3,{} = general\n", cahvore->general_linearity);
}

std::string VectorLine(std::string_view key, const math::Vector3& v) {
  return fmt::format("{} = {} {} {}\n", key, v.x(), v.y(), v.z());
}

std::string LinearLines(const Cahv& lens) {
  return VectorLine("C", lens.C) + VectorLine("A", lens.A) + VectorLine("H", lens.H) +
         VectorLine("V", lens.V);
}

std::string LensLines(const Cahv& lens) { return LinearLines(lens); }
std::string LensLines(const Cahvor& lens) {
  return LinearLines(lens.linear) + VectorLine("O", lens.O) + VectorLine("R", lens.R);
}
std::string LensLines(const Cahvore& lens) {
  return LinearLines(lens.linear) + VectorLine("O", lens.O) + VectorLine("R", lens.R) +
         VectorLine("E", lens.E);
}
// The form has no keys for others, which the callers are told.
template <typename Lens>
std::string LensLines(const Lens&) {
  return {};
}

}  // namespace

CameraModel ParseCameraText(std::string_view text, std::string_view source_name) {
  const CameraBlocks sorted = BlocksIn(text, source_name);
  const CameraBlock& block = sorted.blocks.front();
  if (!block.camera.empty()) {
    throw core::UserError(
        std::string(source_name),
        fmt::format("line {} begins a pair, where one camera is wanted", block.line),
        "give the file of one camera");
  }
  return ModelIn(block, source_name);
}

CameraPair ParseCameraPairText(std::string_view text, std::string_view source_name) {
  const CameraBlocks sorted = BlocksIn(text, source_name);
  const auto& blocks = sorted.blocks;
  const bool is_pair =
      blocks.size() == 2 && ((blocks[0].camera == "left" && blocks[1].camera == "right") ||
                             (blocks[0].camera == "right" && blocks[1].camera == "left"));
  if (!is_pair) {
    throw core::UserError(std::string(source_name), "is no pair of a left and a right camera",
                          "begin each camera with a line Camera = left or Camera = right, once");
  }
  const std::size_t left = blocks[0].camera == "left" ? 0 : 1;
  return {ModelIn(blocks[left], source_name), ModelIn(blocks[1 - left], source_name)};
}

std::string CameraText(const CameraModel& camera, std::string_view comment) {
  EXPECT(!std::holds_alternative<BrownPinhole>(camera.lens));
  return Commented(comment) + ModelLine(camera) +
         fmt::format("Dimensions = {} {}\n", camera.size.columns, camera.size.rows) +
         std::visit([](const auto& lens) { return LensLines(lens); }, camera.lens);
}

std::string CameraPairText(const CameraPair& pair, std::string_view comment) {
  return Commented(comment) + "Camera = left\n" + CameraText(pair.left) + "Camera = right\n" +
         CameraText(pair.right);
}

}  // namespace rockyard::vision
