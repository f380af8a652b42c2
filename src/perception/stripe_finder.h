// From images to stripes: where one can be, the peaks of a scanline, and whose laser each is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "messages/calibration.h"
#include "messages/camera.h"
#include "messages/measurements.h"
#include "messages/stripe_images.h"
#include "perception/stripe_finder_params.h"

namespace rockyard::perception {

// The part of one scanline of one camera in which one laser's stripe is looked for.
struct StripeSearch {
  messages::ColumnRange
      columns;              // of the elevations from search_low to search_high, inside the imager
  double datum_column = 0;  // where the datum plane shows the stripe, or the column nearest to it
};

// The searched part of every scanline, for each laser and for both cameras: also for the camera
// that does not measure this stripe, in whose images it appears all the same.
class StripeSearches {
 public:
  // Follows each scanline pixel by pixel, so that it holds for every lens. It costs 100 ns a
  // column, row, stripe and camera, 3 ms for the published array: build it once.
  explicit StripeSearches(const messages::StripeCalibration& calibration);

  const StripeSearch& At(int camera, std::size_t row, std::size_t stripe) const {
    return searches_[(static_cast<std::size_t>(camera) * size_.rows + row) * size_.stripes +
                     stripe];
  }

 private:
  messages::StripeArraySize size_;
  std::vector<StripeSearch> searches_;  // [camera][row][stripe]
};

// From the images of one exposure to the peaks of one scanline, and to the laser of each.
//
// Matthies 1995, section 6: the image with lasers on less the one with lasers off, averaged over
// 5 x 5 pixels, compared with a threshold. A peak is a run of columns above it.

// The averaged difference along one image row.
struct ScanlineProfile {
  int first_column = 0;
  std::vector<double> difference;  // digital numbers

  // Returns the standard deviation of a normal variable of mean zero whose mean size is that of the
  // differences: sqrt(pi / 2) mean |d|. Sunlight that the subtraction left counts as noise; so does
  // the stripe itself, which takes up some ten columns of several hundred.
  double Noise() const;
};

// Averages lit less dark image around a row; none if no band of the exposure holds it. At the
// borders of the band the average is that of the pixels that there are. Integer running sums along
// rows and columns make the cost some operations a pixel, whatever the window.
std::optional<ScanlineProfile> AverageDifference(const messages::StripeExposure& exposure, int row,
                                                 int window_px);

// A place where a stripe may be.
struct StripePeak {
  double column_px = 0.0;
  double height_counts = 0.0;  // highest averaged difference
};

// Returns the runs of columns above the threshold, left to right.
std::vector<StripePeak> FindPeaks(const ScanlineProfile& profile, const StripeFinderParams& params);

// Returns, where several lasers are on in one image, for each laser (left to right, as in
// `searches`) the index of its peak in `peaks` (left to right), or none. A peak is taken for a
// laser only within its searched columns, and for one laser only; stripes keep their order. Among
// the assignments that are left, the brightest is taken (sum of peak heights; the one nearer to the
// datum columns if equal), or, with kNearestToDatum, among those with most peaks the one nearest to
// the datum columns. With one laser this is its strongest or nearest peak.
//
// The order of stripes is an assumption: a rock on the inner stripe can throw its image past that
// of a pit on the outer one, where the searched columns overlap. Cost: lasers times peaks.
std::vector<std::optional<std::size_t>> AssociatePeaks(std::span<const StripeSearch> searches,
                                                       std::span<const StripePeak> peaks,
                                                       PeakChoice choice);

// Finds the light stripes in images: from what the cameras hand over to a column for each point.

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
