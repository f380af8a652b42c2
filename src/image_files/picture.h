// Pictures of coloured pixels.
#pragma once

#include "vision/colour_image.h"

namespace rockyard::image_files {

using Rgb = vision::Rgb;
using Picture = vision::ColourImage;

}  // namespace rockyard::image_files
