// What the fit takes from an eye: the wall of a candidate in bands of rows, each averaged to one
// line of colours, with the background on either side, and the rows of its rims.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::vision {

struct ProfileBand {
  double row = 0.0;  // its middle
  // Red, green and blue in grey levels, from `first_column` of the profile on.
  std::vector<Eigen::Vector3d> colours;
  // The symmetric root of the inverse covariance of each: noise of all primaries alike, background
  // and, on the wall, brightness (brightness_sd), which moves a colour along itself.
  std::vector<Eigen::Matrix3d> whitening;
  Eigen::Vector3d left_background = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_background = Eigen::Vector3d::Zero();
};

struct EyeProfile {
  int first_column = 0;
  std::vector<ProfileBand> bands;
  double level = 0.0;  // mean of all primaries inside of the box, grey levels
  // Where the rims cross the middle of the box, to a part of a pixel: first row and last row of the
  // wall, pixel edges at halves.
  double upper_rim_px = 0.0;
  double lower_rim_px = 0.0;
};

// `sag_px`: how many rows the middle of a rim lies below its ends; bands are of rows that show the
// wall from side to side, or one row where there are none. Requires a box at least one pixel inside
// of the image.
EyeProfile ProfileOf(const ColourImage& image, const ColourRegion& box, double sag_px,
                     const CylinderFitParams& params);

}  // namespace rockyard::vision
