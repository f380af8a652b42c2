// What a look of stereo cameras saw, as pictures, points and files, in the manner of figures 1
// and 3 of Goldberg 2002.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/looks/look_capture.h"
#include "campaign/stereo/stereo_products.h"
#include "image_files/float_files.h"
#include "image_files/raw_image.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "vision/image.h"
#include "vision/stereo/elevation_map.h"

namespace rockyard::campaign {

// The grey of the left image under lines: neither as dark as the lower end of the ramp of colours
// nor as light as its upper one.
std::uint8_t Muted(std::uint8_t grey);

// The left image, enlarged (FactorToSee) and Muted, with the cells of the navigator's map that
// hold points as outlines at their elevations: in the colour of their goodness
// (report::ByteColour), in grey where they have none. The map lies where the rover believes it,
// seen by the camera that it believes to have; what is nearer is drawn over what is farther.
image_files::Picture GridPicture(const CapturedLook& look, const messages::NavigationView& view);

// Points of a look from above, in R.
struct ElevationImage {
  vision::ElevationGrid grid;      // the way of looking is up in it
  vision::Image<float> heights_m;  // NaN where no point is
};

// Cells of 5 cm, or larger ones where there would be more than 1000 along a side. No points, no
// cells.
ElevationImage ElevationsOf(const messages::PointCloud& cloud);

// The points in R, each in the grey of the pixel of the left image that it comes from.
std::vector<image_files::ColouredPoint> GreyPoints(const CapturedLook& look);

// The points in R, in colours of their heights (HeightColour).
std::vector<image_files::ColouredPoint> HeightPoints(const messages::PointCloud& cloud,
                                                     const HeightSpan& span);

// "front" or "rear": the cameras that look there.
std::string_view CamerasOf(messages::LookDirection direction);

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
