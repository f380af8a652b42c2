// What was found, drawn into both images.
#pragma once

#include "image_files/raw_image.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::campaign {

// Both images side by side, with the bounding boxes of the regions: the whole white, quadrants in
// pure colours of their classes. Where nothing was found it is the images alone.
image_files::Picture CylinderPicture(const vision::ColourImage& left,
                                     const vision::ColourImage& right,
                                     const vision::CylinderFinding& finding);

}  // namespace rockyard::campaign
