// Where in an image the stripe of a point can be, as the rover's calibration has it.
#pragma once

#include <vector>

#include "messages/calibration.h"
#include "messages/camera.h"

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

}  // namespace rockyard::perception
