// From the images of one exposure to the peaks of one scanline, and to the laser of each.
//
// Matthies 1995, section 6: the image with lasers on less the one with lasers off, averaged over
// 5 x 5 pixels, compared with a threshold. A peak is a run of columns above it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "messages/stripe_images.h"
#include "perception/stripe_finder_params.h"
#include "perception/stripe_search.h"

namespace rockyard::perception {

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

}  // namespace rockyard::perception
