/// @file
/// The interface of what makes range points of a pair of images on board: rockyard's own stereo, or
/// a reader of one's own. Drives at the image fidelity of the stereo sensor read each look by the
/// reader that the scenario chooses (perception.reader), and hand the points to the navigator, or
/// judge hazards by them.
#pragma once

#include <vector>

#include "math/pose.h"
#include "messages/look_images.h"

namespace rockyard::perception {

/// Makes points of images. One object reads all looks of a drive, from one thread.
class PointReader {
 public:
  virtual ~PointReader() = default;

  /// Returns points on surfaces that the two cameras see, m, in R by the cameras that stand in
  /// `images`. Must be a pure function of the images and of the reader's parameters, so that a
  /// drive repeats bit for bit: no clock, and nothing of earlier looks. What it throws makes the
  /// trial a simulator fault, unless a plugin is behind it.
  virtual std::vector<math::Vector3> Points(const messages::LookImages& images) const = 0;
};

}  // namespace rockyard::perception
