// Expected light on one image line, between the renderer and the read-out.
#pragma once

#include <vector>

namespace rockyard::rendering {

// The light on the pixels of one line, in photoelectrons per second.
struct RenderedRow {
  // What one lamp adds to one pixel.
  struct LampPixel {
    int pixel = 0;  // counts from the first column of the line
    int lamp = 0;
    double rate_e_s = 0.0;
  };

  int row = 0;
  std::vector<double> sun_e_s;   // per pixel, all lamps off
  std::vector<LampPixel> lamps;  // where a lamp adds anything; terms to be summed
};

}  // namespace rockyard::rendering
