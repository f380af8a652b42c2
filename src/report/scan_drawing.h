// One scan of the light stripe sensor, as far as it can be shown: its elevation array as a drawing
// seen from above, as text and as CSV; its images, for people. `rockyard replay` writes and tells
// it. A point of the array is where one stripe (the light plane of a laser) and one row meet; the
// row is one scanline of the image, on which the point is looked for in a range of columns. No
// record depends on it: drawing and text may change, the columns of the CSV are for programs of
// others.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "image_files/raw_image.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/stripe_images.h"

namespace rockyard::report {

// What one point of the array became.
struct ShownPoint {
  messages::StripePixel pixel;  // as it was found
  int searched_first_px = 0;    // columns in which it was looked for
  int searched_last_px = -1;
  messages::ElevationPoint elevation;                // as it was triangulated
  math::Vector3 p_RoP_R = math::Vector3::Zero();     // of the same; undefined where not detected
  math::Vector3 expected_R = math::Vector3::Zero();  // where the point lies on level ground
};

// A closed line on the ground, (x, y) in R, m.
using GroundOutline = std::vector<std::pair<double, double>>;

struct ScanView {
  std::string title;
  messages::StripeCalibration calibration;  // as the rover believes it
  messages::StripeArray<ShownPoint> points;
  messages::HazardReport hazards;  // of this scan alone
  GroundOutline rover;
  std::vector<GroundOutline> rocks;
};

// Returns an SVG file: the rover's outline and the rocks, light planes as lines, found points as
// circles coloured by their elevation (blue below, white at, red above the datum plane) with its
// value in mm, missing points as crosses where level ground would show them, and the stripes with a
// hazard in red. Forward is up.
std::string ScanSvg(const ScanView& scan);

// Returns the elevations in mm, farthest row first, '-' where nothing was found, and the hazards of
// each stripe. Left is left, as the rover sees it.
std::string ScanText(const ScanView& scan);

// One line per point: stripe, row, detected, column_px, elevation_m, x_m, y_m, hazard.
std::string ScanCsv(const ScanView& scan);

// Returns a picture of grey values in proportion to the square root of the counts, so that dark
// parts show; the brightest thousandth is white. The band must hold whole lines.
image_files::Picture FramePicture(const messages::ImageBand& band);

// Returns a picture of `difference`, the averaged differences of lit and dark images: one value per
// pixel of `exposure.lit.front()`, row-major, in the grey scale of FramePicture, negative ones
// black. Drawn over it for the lasers of the exposure's group and camera: blue dots above the
// columns in which each point is looked for, and a cross where it was found, green, or red on a
// stripe with a hazard.
image_files::Picture DifferencePicture(const ScanView& scan,
                                       const messages::StripeExposure& exposure,
                                       std::span<const double> difference);

}  // namespace rockyard::report
