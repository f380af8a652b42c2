// On-board visual odometry: from the images of a pair to the motion of R. Drives whose visual
// odometry has the image fidelity read their images by it. Records of those drives depend on its
// bits and draws (kRansac, by vision::VisualOdometer).
#pragma once

#include <optional>

#include "core/random.h"
#include "math/pose.h"
#include "perception/aligned_eyes.h"
#include "vision/odometry/odometer.h"
#include "vision/stereo/stereo_rig.h"

namespace rockyard::perception {

// A vision::VisualOdometer with the cameras that the rover believes to have, in R.
class VisualOdometry {
 public:
  // `rig` is told in R, so that motions are those of R. Throws core::UserError where the cameras
  // cannot be aligned.
  VisualOdometry(const vision::OdometerParams& params, const vision::StereoRig& rig,
                 int pyramid_level, core::TrialKey key)
      : eyes_(rig, pyramid_level), odometer_(params, eyes_.pair(), eyes_.left_free(), key) {}

  // Takes the images of the next pair, of the rig's size. `predicted` is that of
  // vision::VisualOdometer::Add.
  vision::OdometryStep Add(const vision::GrayImage& left, const vision::GrayImage& right,
                           const std::optional<math::Transform>& predicted) {
    return odometer_.Add({eyes_.Left(left), eyes_.Right(right)}, predicted);
  }

  // Begins a new path with the next pair, as after operators moved the rover by hand.
  void Renew() { odometer_.Renew(); }

  const vision::RectifiedPair& pair() const { return eyes_.pair(); }

 private:
  AlignedEyes eyes_;  // must come first: the odometer is made of it
  vision::VisualOdometer odometer_;
};

}  // namespace rockyard::perception
