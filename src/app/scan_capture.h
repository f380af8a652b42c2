// Everything that can be shown of one scan, taken at the moment when it happens.
#pragma once

#include <cstddef>
#include <vector>

#include "messages/stripe_images.h"
#include "perception/stripe_search.h"
#include "perception/triangulation.h"
#include "report/scan_view.h"
#include "scenario/scenario.h"
#include "trial/scan_watcher.h"

namespace rockyard::app {

// One exposure with what the rover makes of it before it looks for stripes.
struct CapturedExposure {
  messages::StripeExposure frames;  // whole images, one band each
  std::vector<double> difference;   // averaged, row-major, counts
};

struct CapturedScan {
  report::ScanView view;
  std::vector<CapturedExposure> exposures;
};

class ScanCapture {
 public:
  explicit ScanCapture(const scenario::Scenario& scenario);

  // What the rover makes of a scan by itself, without a second one. Cost: some milliseconds.
  report::ScanView View(const trial::WatchedScan& watched) const;

  // The same with whole images of every camera and group of lasers, rendered also where the scan
  // came from the geometric model. Cost: some seconds.
  CapturedScan Capture(const trial::WatchedScan& watched) const;

 private:
  report::ShownPoint ShowPoint(const trial::WatchedScan& watched, std::size_t row,
                               std::size_t stripe) const;
  std::vector<double> Difference(const messages::StripeExposure& frames) const;

  scenario::Scenario scenario_;
  messages::StripeCalibration calibration_;  // as the rover believes it
  perception::Triangulator triangulator_;
  perception::StripeSearches searches_;
};

}  // namespace rockyard::app
