// What a look of stereo cameras saw, as pictures, points and files, in the manner of figures 1
// and 3 of Goldberg 2002.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/stereo/match_pair.h"
#include "image_files/float_files.h"
#include "image_files/raw_image.h"
#include "math/pose.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "perception/stereo_points.h"
#include "replay/data.h"
#include "trial/watchers.h"
#include "vision/cameras/cahv.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/elevation_map.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

// Everything that can be shown of one look of stereo cameras, kept from the moment when it happens,
// and what a replay page keeps of it.

// See trial::WatchedStereo. 50 kB with images of 128 x 128 pixels, and the points.
struct CapturedLook {
  math::Transform X_WR = math::Transform::Identity();
  perception::StereoSight sight;
  vision::RectifiedPair pair;
  vision::StereoPipelineParams matching;
  messages::PointCloud cloud;
};

CapturedLook Capture(const trial::WatchedStereo& watched);

// The looks on which the decisions of a navigator rest.
class LookMemory {
 public:
  void Add(CapturedLook look);

  // Of a decision that followed `cloud`: its look, and where that was a look behind the last one
  // ahead before it; in the order in which they were taken. Forgets what came before.
  std::vector<CapturedLook> LooksOf(const messages::PointCloud& cloud);

 private:
  std::vector<CapturedLook> looks_;
};

// Sides of its pictures are at most this long, px: larger images are reduced by powers of two.
inline constexpr int kLargestRecordSide_px = 160;

// The look at `time_s` with its pictures. Cost: some milliseconds.
replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s);

// Pictures of pixels made larger, and lines on them.

// Every pixel as a square of `factor` >= 1 pixels.
image_files::Picture Enlarged(const image_files::Picture& picture, int factor);

// The factor that makes the longer side at least 512 pixels long, or nearly: 1 for larger ones.
int FactorToSee(int width, int height);

// Pixels of the picture, (0, 0) in the middle of the first one.
using PictureSegment = std::pair<vision::Pixel, vision::Pixel>;

// The image of the line between two points in the camera's outer frame, where it is at least 0.05 m
// in front of the camera's centre; nothing where none of it is.
std::optional<PictureSegment> ImageOfLine(const vision::Cahv& camera, const math::Vector3& from_A,
                                          const math::Vector3& to_A);

// Draws what of the line lies within the picture, `width_px` >= 1 wide, to the right of it and
// below. Its ends are finite.
void DrawLine(const PictureSegment& line, const image_files::Rgb& colour, int width_px,
              image_files::Picture& picture);

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
// elevation.png, cloud.ply (src/campaign/README.md); pictures but left.png are enlarged to some 512
// pixels.
std::vector<LookFile> WriteLookFiles(const std::filesystem::path& folder,
                                     std::span<const CapturedLook> looks,
                                     const messages::NavigationView& view);
// Of points without images elevation.png and cloud.ply.
std::vector<LookFile> WriteCloudFiles(const std::filesystem::path& folder,
                                      const messages::PointCloud& cloud);

}  // namespace rockyard::campaign
