// Finds the light stripes in images: from what the cameras hand over to a column for each point.
#pragma once

#include <vector>

#include "messages/calibration.h"
#include "messages/camera.h"
#include "messages/measurements.h"
#include "messages/stripe_images.h"
#include "perception/stripe_finder_params.h"
#include "perception/stripe_search.h"

namespace rockyard::perception {

// The program of Matthies 1995, section 6: images with lasers on less images with lasers off,
// averaged over 5 x 5 pixels, thresholded; each point on the image row of its scanline. What is no
// part of the text is assumed, namely the threshold, that a stripe is looked for only in the
// columns of elevations between search_low and search_high, and what happens to several peaks
// (StripeFinderParams) and to several lasers in one image (AssociatePeaks).
class StripeFinder {
 public:
  // Works with the geometry that the rover believes. Cost: that of StripeSearches.
  StripeFinder(const StripeFinderParams& params, const messages::StripeCalibration& calibration);

  // Finds the points. Those whose exposure or image rows are not there are missing. It is a pure
  // function without random numbers. Cost: some operations a pixel.
  messages::StripeScan Find(const messages::StripeImages& images) const;

  // Returns the searched part of a point's scanline, in the camera that measures it.
  messages::ColumnRange searched(std::size_t row, std::size_t stripe) const;

 private:
  void FindIn(const messages::StripeExposure& exposure, std::size_t row,
              messages::StripeScan& scan) const;

  StripeFinderParams params_;
  messages::StripeCalibration calibration_;
  StripeSearches searches_;
};

}  // namespace rockyard::perception
