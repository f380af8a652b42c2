#include "campaign/odometry/kitti_calibration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <optional>
#include <string_view>
#include <vector>

#include "campaign/odometry/number_lines.h"
#include "core/error.h"
#include "core/whole_file.h"

namespace rockyard::campaign {
namespace {

constexpr std::size_t kNumbers = 12;
constexpr const char* kForm = "give \"P0: \" and \"P1: \" with the twelve numbers of each camera";

using Projection = Eigen::Matrix<double, 3, 4>;

// The projection of a line that is one; nothing of other lines.
std::optional<Projection> ProjectionOf(std::string_view line) {
  std::vector<std::string_view> words = WordsOf(line);
  if (!words.empty() && words.front().ends_with(':')) {
    if (words.front() != "P0:" && words.front() != "P1:") return std::nullopt;
    words.erase(words.begin());
  }
  if (words.size() != kNumbers) return std::nullopt;
  Projection P;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (!ParseNumber(words[i], P(static_cast<int>(i / 4), static_cast<int>(i % 4)))) {
      return std::nullopt;
    }
  }
  return P;
}

vision::CameraModel CameraOfProjection(const std::filesystem::path& path, const Projection& P,
                                       const vision::ImageSize& size) {
  const Eigen::Matrix3d M = P.leftCols<3>();
  if (M.row(2) != Eigen::RowVector3d(0.0, 0.0, 1.0) || !(M(0, 0) > 0.0) || !(M(1, 1) > 0.0)) {
    throw core::UserError(path.string(), "holds a projection that is none of a rectified camera",
                          kForm);
  }
  vision::Cahv camera;
  camera.H = M.row(0).transpose();
  camera.V = M.row(1).transpose();
  camera.A = M.row(2).transpose();
  camera.C = -M.inverse() * P.col(3);
  return {camera, size};
}

}  // namespace

vision::CameraPair LoadKittiCalibration(const std::filesystem::path& path,
                                        const vision::ImageSize& size) {
  const std::string text = core::ReadTextFile(path, kLargestText, "KITTI's calib.txt");
  std::vector<Projection> found;
  for (const std::string_view line : LinesOf(text)) {
    const auto projection = ProjectionOf(line);
    if (projection && found.size() < 2) found.push_back(*projection);
  }
  if (found.size() < 2) {
    throw core::UserError(
        path.string(), fmt::format("holds {} projections of cameras 0 and 1", found.size()), kForm);
  }
  return {CameraOfProjection(path, found[0], size), CameraOfProjection(path, found[1], size)};
}

}  // namespace rockyard::campaign
