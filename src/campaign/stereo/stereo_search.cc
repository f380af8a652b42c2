#include "campaign/stereo/stereo_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/stereo.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::campaign {
namespace {

using vision::DisparityImage;
using vision::GrayImage;
using vision::StereoPipelineParams;

// Below this share of matched pixels a pair is looked at twice.
constexpr double kHardlyAny = 0.05;
// Swapped eyes: turned back, the pair has this many times as many matches.
constexpr double kClearlyMore = 3.0;
// A pixel shows texture where the Laplacian is this many grey levels from 0, whatever filter and
// gain the pair is matched with, and an image has texture where this share of its pixels does.
constexpr int kTexture_levels = 4;
constexpr double kTextured = 0.25;
// Share of the image's width that is searched where nobody says otherwise, at least so many
// disparities: a camera pair's overlap at arm's length.
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

// What the pair would show if its eyes were the other way round.
double MatchedShareSwapped(const StereoInput& input, const StereoPipelineParams& params,
                           int threads) {
  vision::StereoProducts products;
  vision::MatchStereo(input.right, input.left, params, threads, products);
  return MatchedShare(products.disparities);
}

}  // namespace

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
  // The peak filter takes one disparity at either end.
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
