// The program of Matthies 1995, section 6, that finds light stripes in images: images with lasers
// on less images with lasers off, averaged over 5 x 5 pixels, compared with a threshold. Drives at
// the image fidelity of the light stripe sensor see by it, and captures of a scan show its steps.
//
// The paper leaves three things open, which are assumed: the threshold; where a stripe is looked
// for, namely in the columns of elevations between search_low and search_high only; which of
// several peaks is taken (StripeFinderParams), and for which of several lasers in one image
// (AssociatePeaks).
//
// Words are those of sensing/light_stripe.h and messages/camera.h: a point of the array is
// [row][stripe]; the scanline of a row of points is an image row; columns are pixels along it. The
// datum plane is the plane in R from which elevations count (StripeCalibration::datum_z_m).
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
  double datum_column = 0;  // the column whose elevation is nearest to the datum plane
};

// The searched part of every scanline, for each laser and for both cameras: a stripe appears also
// in the images of the camera that does not measure it.
class StripeSearches {
 public:
  // Tries each column of each scanline, so that it holds for every lens. Requires search_low <= 0
  // <= search_high. It costs 100 ns a column, row, stripe and camera, 3 ms for the published array:
  // build it once.
  explicit StripeSearches(const messages::StripeCalibration& calibration);

  const StripeSearch& At(int camera, std::size_t row, std::size_t stripe) const {
    return searches_[(static_cast<std::size_t>(camera) * size_.rows + row) * size_.stripes +
                     stripe];
  }

 private:
  messages::StripeArraySize size_;
  std::vector<StripeSearch> searches_;  // [camera][row][stripe]
};

// The averaged difference of the images with and without lasers along one image row.
struct ScanlineProfile {
  int first_column = 0;
  std::vector<double> difference;  // digital numbers

  // Returns sqrt(pi / 2) mean |d| of the differences d: the standard deviation of a normal variable
  // with mean zero and this mean absolute value. Sunlight that the subtraction left counts as
  // noise, so that it hides stripes instead of making some up. The stripe itself counts, too, but
  // takes up some ten columns of several hundred.
  double Noise() const;
};

// Averages lit less dark image over window_px x window_px pixels around each column of a row;
// returns none if no band of the exposure holds the row. At the borders of the band it averages the
// pixels that there are. Sums are whole numbers, so that they are exact in any order. Cost: some
// operations for each pixel of window_px rows.
std::optional<ScanlineProfile> AverageDifference(const messages::StripeExposure& exposure, int row,
                                                 int window_px);

// A place where a stripe may be.
struct StripePeak {
  double column_px = 0.0;
  double height_counts = 0.0;  // highest averaged difference
};

// Returns the peaks, left to right: runs of columns above the threshold, at their centres of
// brightness. The threshold is the larger of threshold_counts and noise_multiple times Noise.
std::vector<StripePeak> FindPeaks(const ScanlineProfile& profile, const StripeFinderParams& params);

// Returns which peak belongs to which laser, where several lasers are on in one image: for each
// laser (left to right, as in `searches`) the index of its peak in `peaks` (left to right), or
// none. A peak is assigned to one laser at most, and only within the searched columns of this
// laser; peaks of lasers keep the order of lasers. With kStrongest the assignment with the largest
// sum of peak heights is taken, of equal ones the one nearest to the datum columns. With
// kNearestToDatum it is the assignment with most peaks, of equal ones the one nearest to the datum
// columns. Records depend on ties that are left: BestAssignments in stripe_finder.cc has their
// order.
//
// That stripes keep their order is an assumption: where searched columns overlap, a rock on the
// inner stripe can throw its image past that of a pit on the outer one. Cost: lasers times peaks.
std::vector<std::optional<std::size_t>> AssociatePeaks(std::span<const StripeSearch> searches,
                                                       std::span<const StripePeak> peaks,
                                                       PeakChoice choice);

// The program: from the images of a scan to a column for each point.
class StripeFinder {
 public:
  // Works with the geometry that the rover believes. Cost: that of StripeSearches.
  StripeFinder(const StripeFinderParams& params, const messages::StripeCalibration& calibration);

  // Finds the points. Points whose exposure or image rows are missing are not detected. It is a
  // pure function without random numbers. Cost: some operations for each pixel that is averaged.
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
