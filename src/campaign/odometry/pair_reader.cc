#include "campaign/odometry/pair_reader.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <string_view>
#include <vector>

#include "campaign/odometry/pose_text.h"
#include "core/error.h"
#include "core/files.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/rectification.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

std::string PixelsText(const vision::ImageSize& size) {
  return fmt::format("{} x {} pixels", size.columns, size.rows);
}

vision::GrayImage GrayOf(const fs::path& path, std::optional<int> white) {
  return image_files::ToGray(image_files::ReadImage(path), {.white = white}).image;
}

void CheckSizes(const fs::path& path, const vision::GrayImage& image,
                const vision::ImageSize& size) {
  const vision::ImageSize is{image.width(), image.height()};
  if (is == size) return;
  throw core::UserError(
      path.string(),
      fmt::format("has {}, the first image of the sequence {}", PixelsText(is), PixelsText(size)),
      "give images of one size");
}

vision::CameraPair CamerasOf(const OdometryRequest& request, const ImageSequence& sequence,
                             const vision::ImageSize& size) {
  if (request.cameras.empty()) {
    if (!sequence.calibration.empty()) return LoadKittiCalibration(sequence.calibration, size);
    throw core::UserError("--cameras", "is missing",
                          "name a file with the cameras of both images (src/vision/README.md)");
  }
  vision::CameraPair pair = vision::LoadCameraPair(request.cameras);
  for (const auto& [eye, camera] : {std::pair{"left", &pair.left}, {"right", &pair.right}}) {
    if (camera->size == size) continue;
    throw core::UserError(request.cameras.string(),
                          fmt::format("{} is a camera of {}, the images have {}", eye,
                                      PixelsText(camera->size), PixelsText(size)),
                          "give the cameras of these very images");
  }
  return pair;
}

// All pixels are free where there is no file.
vision::Image<std::uint8_t> MaskOf(const fs::path& path, const vision::ImageSize& size) {
  if (path.empty()) return {size.columns, size.rows, 1};
  vision::Image<std::uint8_t> mask = GrayOf(path, std::nullopt);
  CheckSizes(path, mask, size);
  for (std::uint8_t& pixel : mask.values()) pixel = pixel == 0 ? 0 : 1;
  return mask;
}

// Of cameras that cannot be aligned, the file is named too.
perception::AlignedEyes EyesOf(const fs::path& file, const vision::StereoRig& rig) {
  try {
    return {rig, 0};
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      problem.path = fmt::format("{}: {}", file.string(), problem.path);
    }
    throw core::UserError(std::move(problems));
  }
}

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

PairReader::PairReader(const OdometryRequest& request, const ImageSequence& sequence)
    : white_(request.white) {
  const SequencePair& first = sequence.pairs.front();
  const image_files::RawImage raw = image_files::ReadImage(first.left);
  description_ = image_files::DescribeImage(raw);
  advice_ = image_files::ToGray(raw, {.white = white_}).advice;
  size_ = {raw.width(), raw.height()};
  const GrayPair images = Read(first);
  if (images.left == images.right) {
    throw core::UserError(first.right.string(), "shows the same as the left image, pixel by pixel",
                          "give the images of the other eye");
  }
  const vision::CameraPair cameras = CamerasOf(request, sequence, size_);
  resampled_ = !vision::AlignedPair(cameras.left, cameras.right).has_value();
  eyes_ = EyesOf(request.cameras.empty() ? sequence.calibration : request.cameras,
                 {cameras.left, cameras.right, MaskOf(sequence.left_free, size_),
                  MaskOf(sequence.right_free, size_)});
}

GrayPair PairReader::Read(const SequencePair& pair) const {
  GrayPair images{GrayOf(pair.left, white_), GrayOf(pair.right, white_)};
  CheckSizes(pair.left, images.left, size_);
  CheckSizes(pair.right, images.right, size_);
  return images;
}

vision::AlignedImages PairReader::Align(const GrayPair& images) const {
  return {eyes_->Left(images.left), eyes_->Right(images.right)};
}

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
