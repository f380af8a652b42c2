#include "campaign/cylinder/painted_files.h"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "campaign/cylinder/find_cylinder.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/random.h"
#include "image_files/mutated_files.h"
#include "image_files/png_file.h"
#include "math/angles.h"
#include "vision/cameras/camera_file.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

constexpr double kDistance_m = 2.0;
constexpr double kOrientation_rad = math::DegToRad(30.0);

void WriteBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string ReadBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string PpmOf(const vision::ColourImage& image) {
  std::string bytes =
      "P6\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n255\n";
  for (const vision::Rgb& pixel : image.values()) {
    bytes += static_cast<char>(pixel.red);
    bytes += static_cast<char>(pixel.green);
    bytes += static_cast<char>(pixel.blue);
  }
  return bytes;
}

bool IsFarOff(const vision::CylinderSighting& sighting) {
  const double turn_rad = math::WrapAngle(sighting.orientation_rad - kOrientation_rad);
  return std::abs(turn_rad) > math::DegToRad(10.0) ||
         std::abs(sighting.p_LT_L.x() - kDistance_m) > 0.1 * kDistance_m;
}

CylinderVerdict JudgeRequest(const CylinderRequest& request) {
  try {
    const vision::CylinderFinding finding = FindCylinderInFiles(request).finding;
    if (!finding.sighting) {
      if (finding.miss == vision::CylinderMiss::kNone || finding.reason.empty()) {
        return {CylinderOutcome::kFailed, "a miss without words"};
      }
      return {CylinderOutcome::kMissed, finding.reason};
    }
    if (!finding.sighting->covariance.allFinite() || !finding.sighting->p_LT_L.allFinite()) {
      return {CylinderOutcome::kFailed, "a pose that is not finite"};
    }
    if (request.finder == CylinderFinder::kRobust && IsFarOff(*finding.sighting)) {
      return {CylinderOutcome::kFailed, "a wrong pose"};
    }
    return {CylinderOutcome::kFound, {}};
  } catch (const core::UserError& error) {
    for (const core::Problem& problem : error.problems()) {
      if (problem.path.empty() || problem.reason.empty() || problem.suggestion.empty()) {
        return {CylinderOutcome::kFailed, std::string("a refusal without words: ") + error.what()};
      }
    }
    return {CylinderOutcome::kRefused, error.what()};
  } catch (const std::exception& error) {
    return {CylinderOutcome::kFailed, std::string("another exception: ") + error.what()};
  }
}

}  // namespace

CylinderRequest WritePaintedPair(const fs::path& folder) {
  const vision::PaintedPair pair = Paint(vision::SceneAt(kDistance_m, kOrientation_rad));
  CylinderRequest request;
  request.left = folder / "left.png";
  request.right = folder / "right.png";
  request.cameras = folder / "cameras.json";
  WriteBytes(request.left, image_files::EncodePng(pair.left));
  WriteBytes(request.right, image_files::EncodePng(pair.right));
  WriteBytes(request.cameras,
             core::DumpJson(vision::CameraPairJson({pair.cameras.left, pair.cameras.right})));
  return request;
}

DamagedPairs::DamagedPairs(const fs::path& folder)
    : folder_(folder), request_(WritePaintedPair(folder)) {
  std::string what;
  const std::array<fs::path, 2> paths = {request_.left, request_.right};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    seeds_.at(eye) = {{"eye.png", ReadBytes(paths.at(eye))},
                      {"eye.ppm", PpmOf(ReadColour(paths.at(eye), what))}};
  }
}

CylinderVerdict DamagedPairs::Judge(std::uint64_t seed, std::uint32_t number) const {
  core::RandomStream stream({seed, number}, core::Purpose::kTest, 1);
  const std::size_t eye = stream.NextU32() % 2;
  CylinderRequest request = request_;
  const fs::path damaged = folder_ / "damaged";
  WriteBytes(damaged, image_files::MutatedFile(seeds_.at(eye), seed, number).bytes);
  (eye == 0 ? request.left : request.right) = damaged;
  const CylinderVerdict robust = JudgeRequest(request);
  if (robust.outcome == CylinderOutcome::kFailed) return robust;
  request.finder = CylinderFinder::kPublished;
  const CylinderVerdict published = JudgeRequest(request);
  return published.outcome == CylinderOutcome::kFailed ? published : robust;
}

}  // namespace rockyard::campaign
