// Expected light on one image line, between the renderer and the read-out.
#pragma once

#include <vector>

namespace rockyard::sensing {

// The light on the pixels of one line, in photoelectrons per second.
struct RenderedRow {
  struct LaserPixel {
    int pixel = 0;  // counts from the first column of the line
    int laser = 0;
    double rate_e_s = 0.0;
  };

  int row = 0;
  std::vector<double> sun_e_s;  // per pixel, all lasers off
  std::vector<LaserPixel>
      lasers;  // what each laser adds, where it adds anything; terms to be summed
};

}  // namespace rockyard::sensing
