// Lack of sharpness: the lens, and charge that diffuses to neighbouring pixels.
#pragma once

#include <vector>

#include "rendering/rendered_row.h"

namespace rockyard::rendering {

// Spreads the light of every pixel over its neighbours on the line, with weights in proportion to
// exp(-k^2 / 2 s^2) at k columns, s in pixels. It does so along the line only: each line is
// rendered by itself. Light of lamps that leaves the line is lost; sunlight goes on beyond its ends
// as at its ends.
class ImageBlur {
 public:
  explicit ImageBlur(double sigma_px);  // 0: sharp, changes nothing

  void Apply(RenderedRow& row) const;

 private:
  std::vector<double> weights_;  // of neighbours on one side, from the pixel itself on
};

}  // namespace rockyard::rendering
