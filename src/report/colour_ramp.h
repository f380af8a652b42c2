// A sequential colour ramp that keeps its order for colour-blind readers and in grey print.
#pragma once

#include <cstdint>

#include "image_files/raw_image.h"

namespace rockyard::report {

// Dark violet at 0, green-blue in the middle, yellow at 1; shares beyond are clamped. Luminance
// grows all the way.
image_files::Rgb RampColour(double share);

// The colour of a goodness or certainty: 0 to 255.
image_files::Rgb ByteColour(std::uint8_t value);

}  // namespace rockyard::report
