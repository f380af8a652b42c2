// What FitProblem (fit_problem.h) takes from an eye: the wall of a candidate in bands of rows, each
// averaged to one line of colours, with the background on either side, and the rows of the rims.
// Records of the experiment on sightings depend on which rows and columns are taken.
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
  // The symmetric root of each colour's inverse covariance: noise of all primaries alike, the
  // background's variance beside the wall, and on the wall brightness_sd along the colour.
  std::vector<Eigen::Matrix3d> whitening;
  Eigen::Vector3d left_background = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_background = Eigen::Vector3d::Zero();
};

struct EyeProfile {
  int first_column = 0;
  std::vector<ProfileBand> bands;
  double level = 0.0;  // mean of all primaries in the box's rows of the bands, grey levels
  // Rows of the rims about the middle of the box, to a part of a pixel; edges of pixels are at
  // halves.
  double upper_rim_px = 0.0;
  double lower_rim_px = 0.0;
};

// Returns the profile of a candidate. `sag_px` is by how many rows the middle of a rim lies below
// its ends. Bands consist of rows that show the wall from side to side, or of one row where there
// are none. Requires a box with at least one column of the image on either side.
EyeProfile ProfileOf(const ColourImage& image, const ColourRegion& box, double sag_px,
                     const CylinderFitParams& params);

}  // namespace rockyard::vision
