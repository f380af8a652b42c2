#include "campaign/stereo/stereo_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/rectification.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/rectification_table.h"
#include "vision/stereo/stereo.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using vision::DisparityImage;
using vision::GrayImage;
using vision::Image;
using vision::StereoPipelineParams;

// The smallest side of an image that is matched, px.
constexpr int kLeastSide_px = 16;

std::string SizeText(int columns, int rows) { return fmt::format("{} x {}", columns, rows); }

GrayImage ReadGray(const fs::path& path, const StereoRequest& request, StereoInput& input) {
  const image_files::RawImage raw = image_files::ReadImage(path);
  image_files::GrayConversion gray = image_files::ToGray(raw, {.white = request.white});
  input.read.push_back(fmt::format("{}; {}", image_files::DescribeImage(raw), gray.what_was_done));
  if (input.advice.empty()) input.advice = gray.advice;
  return std::move(gray.image);
}

void CheckPair(const StereoRequest& request, const GrayImage& left, const GrayImage& right) {
  if (left.width() != right.width() || left.height() != right.height()) {
    throw core::UserError(
        request.right.string(),
        fmt::format("has {} pixels, the left image {}", SizeText(right.width(), right.height()),
                    SizeText(left.width(), left.height())),
        "give two images that were taken together, of one size");
  }
  if (left == right) {
    throw core::UserError(request.right.string(),
                          "shows the same as the left image, pixel by pixel",
                          "give the image of the other eye");
  }
}

GrayImage Reduced(const fs::path& path, GrayImage image, int level) {
  GrayImage reduced = level == 0 ? std::move(image) : vision::ReduceImage(image, level);
  if (reduced.width() < kLeastSide_px || reduced.height() < kLeastSide_px) {
    throw core::UserError(
        path.string(),
        fmt::format("leaves {} pixels at pyramid level {}",
                    SizeText(reduced.width(), reduced.height()), level),
        fmt::format("use a lower level, or images of at least {} pixels a side", kLeastSide_px));
  }
  return reduced;
}

vision::CameraModel CameraOf(const fs::path& file, std::string_view eye,
                             const vision::CameraModel& camera, const GrayImage& image, int level) {
  if (camera.size.columns != image.width() || camera.size.rows != image.height()) {
    throw core::UserError(file.string(),
                          fmt::format("{} is a camera of {} pixels, the image has {}", eye,
                                      SizeText(camera.size.columns, camera.size.rows),
                                      SizeText(image.width(), image.height())),
                          "give the cameras of these very images, not of larger or smaller ones");
  }
  return vision::Reduced(camera, 1 << level);
}

// Returns the image that the aligned camera would have taken, and which of its pixels come from the
// image.
std::pair<GrayImage, Image<std::uint8_t>> Resampled(const GrayImage& image,
                                                    const vision::CameraModel& real,
                                                    const vision::Cahv& aligned,
                                                    const vision::ImageSize& size) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  Image<vision::SourcePosition> positions(size.columns, size.rows, {kNowhere, kNowhere});
  for (int y = 0; y < size.rows; ++y) {
    for (int x = 0; x < size.columns; ++x) {
      const auto source = vision::SourceOf(real, aligned, vision::Pixel(x, y));
      if (source) positions.At(x, y) = {source->x(), source->y()};
    }
  }
  const vision::RectificationTable table(positions, image.width(), image.height());
  return {table.Rectify(image), table.Inside()};
}

// Aligns the cameras. Problems of vision::Rectify name left, right and so on; they are told with
// the file.
vision::RectifiedPair RectifyOrThrow(const fs::path& file, const vision::CameraPair& cameras) {
  core::Result<vision::RectifiedPair> found = vision::Rectify(cameras.left, cameras.right);
  if (found.ok()) return *found;
  std::vector<core::Problem> problems = found.problems();
  for (core::Problem& problem : problems) {
    problem.path = fmt::format("{}: {}", file.string(), problem.path);
  }
  throw core::UserError(std::move(problems));
}

// Takes the images of a pair without cameras: as they are, or with the rows of the right one moved
// to those of the left one.
void TakeImages(const StereoRequest& request, GrayImage left, GrayImage right, StereoInput& input) {
  if (request.align) {
    core::Result<vision::RowAlignment> found = vision::FindRowAlignment(left, right);
    if (!found.ok()) {
      std::vector<core::Problem> problems = found.problems();
      for (core::Problem& problem : problems) problem.path = request.right.string();
      throw core::UserError(std::move(problems));
    }
    input.alignment = *found;
    const vision::RectificationTable table =
        vision::MakeRowTable(found->correction, right.width(), right.height());
    right = table.Rectify(right);
    input.left_inside = Image<std::uint8_t>(left.width(), left.height(), 1);
    input.right_inside = table.Inside();
  }
  input.left = std::move(left);
  input.right = std::move(right);
}

// Below this share of matched pixels a pair is looked at twice.
constexpr double kHardlyAny = 0.05;
// Eyes are taken for swapped where the pair has this many times as many matches when they are
// turned back.
constexpr double kClearlyMore = 3.0;
// A pixel shows texture where the Laplacian is this many grey levels from 0, whatever filter and
// gain the pair is matched with, and an image has texture where this share of its pixels does.
constexpr int kTexture_levels = 4;
constexpr double kTextured = 0.25;
// Where nobody says otherwise, 1 / kWidthShare of the image's width is searched, at least so many
// disparities: the overlap of a camera pair at arm's length.
constexpr int kWidthShare = 8;
constexpr int kLeastDisparities = 16;

core::JsonValue DocumentOf(const StereoRequest& request) {
  core::JsonValue document = core::JsonValue::Object();
  for (const std::string& setting : request.settings) core::ApplyOverride(document, setting);
  return document;
}

bool NamesRange(const StereoRequest& request) {
  const core::JsonValue document = DocumentOf(request);
  const core::JsonValue* correlator = document.Find("correlator");
  return correlator != nullptr && (correlator->Find("min_disparity_px") != nullptr ||
                                   correlator->Find("disparities") != nullptr);
}

double MatchedShare(const DisparityImage& disparities) {
  const auto matched =
      std::count_if(disparities.values().begin(), disparities.values().end(), vision::IsValid);
  return static_cast<double>(matched) / static_cast<double>(disparities.values().size());
}

bool HasTexture(const GrayImage& image) {
  constexpr int kMiddle = static_cast<int>(vision::kLaplacianDog.limit);
  const GrayImage filtered = vision::DifferenceOfGaussians(image, vision::kLaplacianDog);
  const auto textured =
      std::count_if(filtered.values().begin(), filtered.values().end(), [](std::uint8_t value) {
        return std::abs(static_cast<int>(value) - kMiddle) >= kTexture_levels;
      });
  return static_cast<double>(textured) >= kTextured * static_cast<double>(filtered.values().size());
}

// Returns the share of matches that the pair would have if its eyes were the other way round.
double MatchedShareSwapped(const StereoInput& input, const StereoPipelineParams& params,
                           int threads) {
  vision::StereoProducts products;
  vision::MatchStereo(input.right, input.left, params, threads, products);
  return MatchedShare(products.disparities);
}

}  // namespace

StereoInput ReadStereoInput(const StereoRequest& request, int pyramid_level) {
  if (request.align && !request.cameras.empty()) {
    throw core::UserError("--align", "is for pairs without cameras",
                          "leave one of --align and --cameras out");
  }
  StereoInput input;
  GrayImage left = ReadGray(request.left, request, input);
  GrayImage right = ReadGray(request.right, request, input);
  CheckPair(request, left, right);
  std::optional<vision::CameraPair> cameras;
  if (!request.cameras.empty()) {
    const vision::CameraPair pair = vision::LoadCameraPair(request.cameras);
    cameras = {CameraOf(request.cameras, "left", pair.left, left, pyramid_level),
               CameraOf(request.cameras, "right", pair.right, right, pyramid_level)};
  }
  left = Reduced(request.left, std::move(left), pyramid_level);
  right = Reduced(request.right, std::move(right), pyramid_level);
  if (!cameras) {
    TakeImages(request, std::move(left), std::move(right), input);
    return input;
  }
  if (const auto aligned = vision::AlignedPair(cameras->left, cameras->right)) {
    input.cameras = *aligned;
    input.left = std::move(left);
    input.right = std::move(right);
    return input;
  }
  input.cameras = RectifyOrThrow(request.cameras, *cameras);
  const vision::RectifiedPair& pair = *input.cameras;
  std::tie(input.left, input.left_inside) = Resampled(left, cameras->left, pair.left, pair.size);
  std::tie(input.right, input.right_inside) =
      Resampled(right, cameras->right, pair.right, pair.size);
  return input;
}

StereoPipelineParams StereoParamsOf(const StereoRequest& request) {
  StereoPipelineParams params;
  core::ReadParams(DocumentOf(request), params);
  return params;
}

StereoPipelineParams WithRange(const StereoRequest& request, const StereoInput& input,
                               StereoPipelineParams params) {
  if (request.depths) {
    if (!input.cameras) {
      throw core::UserError("--nearest", "means nothing without cameras",
                            "give --cameras, or the range in pixels: --param "
                            "correlator.min_disparity_px=0 --param correlator.disparities=64");
    }
    params.correlator = vision::SearchDepths(
        {.focal_px = input.cameras->focal_px, .baseline_m = input.cameras->baseline_m},
        request.depths->nearest_m, request.depths->farthest_m, params.correlator);
    return params;
  }
  if (NamesRange(request)) return params;
  // One disparity more is searched at either end, since the peak filter takes one there.
  const int searched = std::max(kLeastDisparities, input.left.width() / kWidthShare);
  params.correlator.min_disparity_px = -1;
  params.correlator.disparities = std::min(searched + 2, 512);
  return params;
}

void CheckThatTheyMatch(const StereoRequest& request, const StereoInput& input,
                        const StereoPipelineParams& params, const DisparityImage& disparities) {
  const double share = MatchedShare(disparities);
  if (share >= kHardlyAny) return;
  if (!HasTexture(input.left) || !HasTexture(input.right)) return;
  const std::string found =
      fmt::format("{:.1f} % of the pixels have a match in the right image", 100.0 * share);
  if (MatchedShareSwapped(input, params, request.threads) >
      std::max(kHardlyAny, kClearlyMore * share)) {
    throw core::UserError(request.left.string(), found + "; with the eyes swapped many more have",
                          "give the left eye's image first");
  }
  throw core::UserError(
      request.left.string(),
      fmt::format("{}, searched from {} to {} px", found, params.correlator.min_disparity_px,
                  params.correlator.min_disparity_px + params.correlator.disparities - 1),
      input.cameras
          ? "check that the cameras are those of these images and that both see the same; widen "
            "the range (--nearest)"
          : "check that rows are aligned (--cameras or --align) and that both see the same; widen "
            "the range "
            "(--param correlator.disparities=...)");
}

}  // namespace rockyard::campaign
