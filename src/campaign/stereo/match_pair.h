// What `rockyard stereo` does, for that command: a pair of image files to disparities, points and
// pictures (Goldberg 2002 section 2). `render` and pictures of looks share its colours. No record
// depends on it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "core/json_value.h"
#include "image_files/float_files.h"
#include "image_files/raw_image.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/elevation_map.h"
#include "vision/stereo/row_alignment.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {

// Returns a picture of disparities: yellow is near, violet far, over the range that was searched;
// dropped pixels are black.
image_files::Picture DisparityPicture(const vision::DisparityImage& disparities,
                                      const vision::CorrelatorParams& range);

// Returns the points of all pixels with a disparity above zero, in the cameras' outer frame, with
// the grey of the left image.
std::vector<image_files::ColouredPoint> PointsOf(const vision::DisparityImage& disparities,
                                                 const vision::GrayImage& left,
                                                 const vision::RectifiedPair& cameras);

// The span of the middle 98 % of heights.
struct HeightSpan {
  double low_m = 0.0;
  double high_m = 0.0;
};
// Returns the span of the heights; nothing where no height is known.
std::optional<HeightSpan> HeightSpanOf(const vision::Image<float>& heights_m);

// Returns the colour of a height: violet at the lower end of the span, yellow at the upper one.
image_files::Rgb HeightColour(double height_m, const HeightSpan& span);

// Returns a picture in HeightColour over HeightSpanOf; cells without a point are black.
image_files::Picture ElevationPicture(const vision::Image<float>& heights_m);

struct StereoRequest {
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path out;  // a folder, which is made
  ExistingFiles existing = ExistingFiles::kRefuse;
  std::filesystem::path cameras;      // of the images as they are; empty: they are aligned
  bool align = false;                 // rows, by matches of the pair itself; without cameras only
  std::vector<std::string> settings;  // PATH=VALUE of vision::StereoPipelineParams

  struct Depths {  // m, along the axes of the aligned cameras
    double nearest_m = 0.0;
    double farthest_m = 0.0;  // may be infinite
  };
  std::optional<Depths> depths;  // the range that is searched; else that of the settings, or 1/8 of
                                 // the width of the image from infinity on

  std::optional<int> white;  // the sample that becomes 255 (image_files::ToGray)

  std::filesystem::path reference;      // known disparities of the left image; empty: none
  double reference_samples_a_px = 1.0;  // image_files::ReadDisparity

  double cell_m = 0.1;  // of the elevation map
  int threads = 1;
};

struct StereoResult {
  std::vector<std::string> read;  // left, right: what the files hold and what was made of them
  vision::ImageSize size;         // of the images that were matched
  std::optional<vision::RectifiedPair> cameras;
  std::optional<vision::RowAlignment> alignment;  // of the right image's rows, where asked for
  vision::StereoPipelineParams params;            // with the range that was searched
  vision::DropCounts counts{};
  std::optional<vision::StereoScore> score;
  std::int64_t points = 0;
  std::vector<std::string> notes;  // what a user should know before believing it

  std::vector<OutputFile> files;

  // Returns the share of all pixels that have a disparity.
  double Density() const;
};

// Reads, aligns and matches the images, checks what was found, and writes into the folder, which is
// made: disparity.pfm, disparity.png, picture.png, stereo.json; with cameras also left.png and
// right.png (aligned), points.ply, and where there are points elevation.pfm and elevation.png.
// Throws core::UserError, before anything is written, for whatever is wrong with the input.
StereoResult MatchPair(const StereoRequest& request);

// Returns the file stereo.json: inputs, size, cameras, parameters, range, how many pixels each
// filter dropped, the score against known disparities, points, files. Programs read it (--json).
// Must stay: its members; others may only be added.
core::JsonValue StereoJson(const StereoRequest& request, const StereoResult& result);

}  // namespace rockyard::campaign
