// The images of one scan of the light stripe sensor, for people.
#pragma once

#include <span>

#include "image_files/raw_image.h"
#include "messages/stripe_images.h"
#include "report/scan_view.h"

namespace rockyard::report {

// Grey values in proportion to the square root of the counts, so that dark parts show; the
// brightest thousandth is white. The band must hold whole lines.
image_files::Picture FramePicture(const messages::ImageBand& band);

// Averaged differences of two images, one value per pixel of `exposure.lit.front()`, row-major, in
// the same grey scale, negative ones black. Drawn over it for the lasers of the exposure's group
// and camera: blue dots above the columns in which each point is looked for, and a cross where it
// was found, green, or red on a stripe with a hazard.
image_files::Picture DifferencePicture(const ScanView& scan,
                                       const messages::StripeExposure& exposure,
                                       std::span<const double> difference);

}  // namespace rockyard::report
