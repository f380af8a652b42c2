// What the cameras of the light stripe sensor hand to the stripe finder: the simulated imager
// writes it, and pictures of a scan show it.
#pragma once

#include <cstdint>
#include <vector>

namespace rockyard::messages {

// Consecutive rows of pixels of one camera. Rows and columns count from the pixel on the optical
// axis, rows downwards, columns to the camera's right, as in Camera.
struct ImageBand {
  int first_row = 0;
  int first_column = 0;
  int rows = 0;
  int columns = 0;
  std::vector<std::uint16_t> counts;  // digital numbers, [row][column], row-major

  std::uint16_t At(int row, int column) const {
    return counts[static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column - first_column)];
  }
};

// The same rows of pixels taken twice at one pose: with one group of lasers on, and with all off.
struct StripeExposure {
  int camera = 0;  // index in StripeCalibration::cameras
  int group = 0;   // lasers with this StripeLaser::group were on in `lit`
  std::vector<ImageBand> lit;
  std::vector<ImageBand> dark;  // as many bands with the same rows as `lit`
};

// All images of one scan.
struct StripeImages {
  std::int64_t number = 0;  // counts every scan of the trial from 0
  double exposure_s = 0.0;
  double electrons_per_count = 1.0;
  std::vector<StripeExposure> exposures;
};

}  // namespace rockyard::messages
