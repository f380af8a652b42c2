// The files that show what a look of stereo cameras saw.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "campaign/looks/look_capture.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"

namespace rockyard::campaign {

struct LookFile {
  std::string name;  // in its folder
  std::string what;  // it shows, in words
};

// Both write into a folder that is there, and return what they have written; they throw
// core::UserError or std::filesystem::filesystem_error.
//
// Of each look, whose name begins with "front" or "rear": left.png, grid.png, disparity.png,
// elevation.png, cloud.ply (look_pictures.h); pictures but left.png are enlarged to some 512
// pixels.
std::vector<LookFile> WriteLookFiles(const std::filesystem::path& folder,
                                     std::span<const CapturedLook> looks,
                                     const messages::NavigationView& view);
// Of points without images elevation.png and cloud.ply.
std::vector<LookFile> WriteCloudFiles(const std::filesystem::path& folder,
                                      const messages::PointCloud& cloud);

}  // namespace rockyard::campaign
