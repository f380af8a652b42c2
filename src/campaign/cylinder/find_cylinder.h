// What `rockyard cylinder` does: two colour images to the place and the orientation of the coloured
// cylinder (Matthies 1995, section 5 and appendix A).
#pragma once

#include <filesystem>
#include <string>

#include "campaign/cylinder/cylinder_request.h"
#include "vision/colour_image.h"

namespace rockyard::campaign {

// Reads both images and the cameras, looks for the cylinder and writes, where a folder is asked
// for, regions.png and cylinder.json. Throws core::UserError, before anything is written, for
// whatever is wrong with the input: files that cannot be read, grey images, images of two sizes or
// of another size than their cameras, one image twice, settings that mean nothing. A cylinder that
// is not found is no error: the finding says why.
CylinderResult FindCylinderInFiles(const CylinderRequest& request);

// A colour image file as 8 bits of each primary, round(255 sample / full scale); `what` becomes
// what was read and done. Throws core::UserError.
vision::ColourImage ReadColour(const std::filesystem::path& path, std::string& what);

}  // namespace rockyard::campaign
