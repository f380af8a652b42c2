// What a look of stereo cameras saw, as pictures, points and files, in the manner of figures 1 and
// 3 of Goldberg 2002. `replay --step` and replay pages show it; other commands draw lines and
// enlarge pictures by it. No record depends on it.
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

// Everything that can be shown of one look, kept from the moment when it happens
// (trial::WatchedStereo). Memory: 50 kB with images of 128 x 128 pixels, and the points.
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

  // Returns the looks of a decision that followed `cloud`: that with this cloud, and where it was a
  // look behind, before it the last look ahead. They come in the order in which they were taken.
  // Forgets what came before.
  std::vector<CapturedLook> LooksOf(const messages::PointCloud& cloud);

 private:
  std::vector<CapturedLook> looks_;
};

// Sides of the pictures of a LookRecord are at most this long, px: larger images are reduced by
// powers of two.
inline constexpr int kLargestRecordSide_px = 160;

// Returns what a replay page keeps of a look at `time_s`, with its pictures. Cost: some
// milliseconds.
replay::ReplayLook LookRecord(const trial::WatchedStereo& watched, double time_s);

// Returns the picture with every pixel as a square of `factor` >= 1 pixels.
image_files::Picture Enlarged(const image_files::Picture& picture, int factor);

// Returns the largest whole factor that makes the longer side at most 512 pixels long; 1 for longer
// sides.
int FactorToSee(int width, int height);

// A line in a picture; pixel (0, 0) is the middle of the first one.
using PictureSegment = std::pair<vision::Pixel, vision::Pixel>;

// Returns the image of the line between two points in the camera's outer frame, as far as the line
// is at least 0.05 m in front of the camera's centre; nothing where none of it is.
std::optional<PictureSegment> ImageOfLine(const vision::Cahv& camera, const math::Vector3& from_A,
                                          const math::Vector3& to_A);

// Draws what of the line lies within the picture. Its width of `width_px` >= 1 reaches to the right
// and below. Its ends must be finite.
void DrawLine(const PictureSegment& line, const image_files::Rgb& colour, int width_px,
              image_files::Picture& picture);

// Returns the grey that the left image has under lines: neither as dark as the lower end of the
// ramp of colours nor as light as its upper one.
std::uint8_t Muted(std::uint8_t grey);

// Returns the left image, enlarged (FactorToSee) and Muted, with the cells of the navigator's map
// that hold points as outlines at their elevations: in the colour of their goodness
// (report::ByteColour), dark grey where it is unknown. The map lies where the rover believes it,
// seen by the camera that it believes to have; nearer cells are drawn over farther ones.
image_files::Picture GridPicture(const CapturedLook& look, const messages::NavigationView& view);

// Points of a look from above, in R.
struct ElevationImage {
  vision::ElevationGrid grid;      // the way of looking is up in it
  vision::Image<float> heights_m;  // NaN where no point is
};

// Returns the points from above, in cells of 5 cm, or larger ones where there would be more than
// 1000 along a side. No points, no cells.
ElevationImage ElevationsOf(const messages::PointCloud& cloud);

// Returns the points in R, each in the grey of the pixel of the left image that it comes from.
std::vector<image_files::ColouredPoint> GreyPoints(const CapturedLook& look);

// Returns the points in R, in colours of their heights (HeightColour).
std::vector<image_files::ColouredPoint> HeightPoints(const messages::PointCloud& cloud,
                                                     const HeightSpan& span);

// Returns "front" or "rear", for the cameras that look there.
std::string_view CamerasOf(messages::LookDirection direction);

struct LookFile {
  std::string name;  // in its folder
  std::string what;  // it shows, in words
};

// Writes left.png, grid.png, disparity.png, elevation.png and cloud.ply of each look
// (src/campaign/README.md), with "front-" or "rear-" before the name; pictures but left.png are
// enlarged to some 512 pixels. The folder must be there. Returns what was written. Throws
// core::UserError or std::filesystem::filesystem_error.
std::vector<LookFile> WriteLookFiles(const std::filesystem::path& folder,
                                     std::span<const CapturedLook> looks,
                                     const messages::NavigationView& view);
// Writes elevation.png and cloud.ply of points without images, as WriteLookFiles does.
std::vector<LookFile> WriteCloudFiles(const std::filesystem::path& folder,
                                      const messages::PointCloud& cloud);

}  // namespace rockyard::campaign
