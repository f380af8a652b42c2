// Which files are a sequence of image pairs, and its images, one pair after the other, made grey
// and aligned; the cameras of KITTI's calib.txt. EstimatePath reads its input by it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/odometry/estimate_path.h"
#include "perception/aligned_eyes.h"
#include "vision/cameras/camera_file.h"
#include "vision/odometry/odometer.h"

namespace rockyard::campaign {

// The files of one pair of images.
struct SequencePair {
  std::filesystem::path left;
  std::filesystem::path right;
  std::optional<double> time_s;
};

// The files of a sequence, in its order.
struct ImageSequence {
  std::string layout;  // in words: "folders left and right"
  std::vector<SequencePair> pairs;
  // The calib.txt, left_free.png and right_free.png of a folder; empty where there are none.
  std::filesystem::path calibration;
  std::filesystem::path left_free;
  std::filesystem::path right_free;
};

// Returns the pairs of a sequence in their order. `path` is one of
//   a folder with two folders of images: left and right, image_0 and image_1 (KITTI), image_l and
//     image_r; pairs have the same name, in natural order (2 before 10); with times.txt, a time (s)
//     a line, where there is one;
//   a folder with mav0, or mav0 itself (EuRoC): cam0/data.csv and cam1/data.csv list times (ns) and
//     names in data; pairs have the same time;
//   a text file with the two paths of a pair a line, relative to its folder, and a time (s) after
//     them where there is one.
// Throws core::UserError: none of these; an empty folder; images without a partner, by name, all of
// them up to twenty; a time or a path that is none; fewer times than pairs or more; no pair.
// Images are not opened.
ImageSequence FindSequence(const std::filesystem::path& path);

// Returns whether `a` comes before `b` where digits in names count as numbers: "a2" before "a10";
// equal numbers by their texts.
bool NaturallyBefore(std::string_view a, std::string_view b);

struct GrayPair {
  vision::GrayImage left;
  vision::GrayImage right;
};

// Reads pairs of a sequence and aligns them.
class PairReader {
 public:
  // Opens the first pair, for its size and for the cameras. Throws core::UserError: no cameras,
  // cameras of another size or that cannot be aligned, masks of another size, two equal images, and
  // what Read throws of the pair.
  PairReader(const OdometryRequest& request, const ImageSequence& sequence);

  // Returns the images of a pair. Throws core::UserError: an image that cannot be read, or of
  // another size.
  GrayPair Read(const SequencePair& pair) const;
  vision::AlignedImages Align(const GrayPair& images) const;

  // What the first image holds, in words.
  const std::string& description() const { return description_; }
  // The advice of image_files::ToGray on the first image.
  const std::string& advice() const { return advice_; }
  const vision::RectifiedPair& cameras() const { return eyes_->pair(); }
  const vision::Image<std::uint8_t>& left_free() const { return eyes_->left_free(); }
  bool resampled() const { return resampled_; }

 private:
  std::optional<int> white_;
  std::string description_;
  std::string advice_;
  vision::ImageSize size_;  // of every image as it is read
  bool resampled_ = false;
  std::optional<perception::AlignedEyes> eyes_;
};

// Returns the cameras of the first two projections of the file. Each stands on a line, as "P0: "
// and twelve numbers, or the numbers alone: the rows of P = [M | q] with (column, row, 1) ~ M p + q
// (KITTI's odometry benchmark). As CAHV: H, V and A are the rows of M and C = -M^-1 q; the outer
// frame is that of rectified camera 0 (x right, y down, z ahead). The file does not know the size
// of the images. Other lines (P2, Tr) are passed over. Throws core::UserError: unreadable, fewer
// than two projections, a third row of M that is not 0 0 1, no focal length.
vision::CameraPair LoadKittiCalibration(const std::filesystem::path& path,
                                        const vision::ImageSize& size);

}  // namespace rockyard::campaign
