#include "campaign/odometry/pair_reader.h"

#include <fmt/format.h>

#include "campaign/odometry/kitti_calibration.h"
#include "core/error.h"
#include "image_files/luminance.h"
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

}  // namespace rockyard::campaign
