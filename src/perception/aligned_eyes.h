// The images of a camera pair as its calibration has them: reduced, with rows that are epipolar
// lines. Stereo and visual odometry see through it, in drives and in recorded pairs. Records of
// drives by images depend on its bits, and on images of aligned cameras not being resampled.
#pragma once

#include <cstdint>
#include <optional>

#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/rectification_table.h"
#include "vision/stereo/stereo_rig.h"

namespace rockyard::perception {

// Images are reduced by 2^level, and resampled unless the cameras are aligned already. `rig` is
// what the rover believes of its cameras; the images are those of the true cameras, which may have
// drifted. Pixels that are not free are not blanked: whoever matches leaves them out.
class AlignedEyes {
 public:
  // Throws core::UserError where the cameras cannot be aligned.
  AlignedEyes(const vision::StereoRig& rig, int pyramid_level);

  // Return images of the rig's size, reduced and aligned.
  vision::GrayImage Left(const vision::GrayImage& image) const { return Aligned(left_, image); }
  vision::GrayImage Right(const vision::GrayImage& image) const { return Aligned(right_, image); }

  // Returns the cameras of the aligned images.
  const vision::RectifiedPair& pair() const { return pair_; }
  // Return the pixels of the aligned images that are free (1): they show neither the carrier of the
  // cameras nor what a camera did not see (0).
  const vision::Image<std::uint8_t>& left_free() const { return left_.free; }
  const vision::Image<std::uint8_t>& right_free() const { return right_.free; }

 private:
  struct Eye {
    std::optional<vision::RectificationTable> table;  // none where nothing is resampled
    vision::Image<std::uint8_t> free;                 // of the aligned image
  };

  Eye MakeEye(const vision::CameraModel& reduced, const vision::Cahv& aligned,
              const vision::Image<std::uint8_t>& free) const;
  vision::GrayImage Aligned(const Eye& eye, const vision::GrayImage& image) const;

  int pyramid_level_;
  vision::RectifiedPair pair_;
  Eye left_;
  Eye right_;
};

}  // namespace rockyard::perception
