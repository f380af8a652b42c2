#include "vision/cylinder/cylinder_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rockyard::vision {
namespace {

// The most regions of an eye that are looked at, largest first: more are noise.
constexpr std::size_t kMostRegions = 24;
// Of the width over the height, by what elevation and mixed rims make of it.
constexpr double kNarrowest = 0.5;
constexpr double kWidest = 1.7;
// Pixels between a region and the border that the fit needs of the background.
constexpr int kBorder_px = 3;
// Rows and columns with less than this share of the median's pixels are stray.
constexpr double kStray = 0.35;

struct EyeRegions {
  std::vector<ColourRegion> whole;      // inside of the image
  std::optional<ColourRegion> clipped;  // the largest that ends at the border, of several classes
  int largest_px = 0;
};

// The first and last of counts that are no stray ones.
std::pair<int, int> WithoutStray(const std::vector<int>& counts) {
  std::vector<int> sorted = counts;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto is_full = [&](int count) { return count >= kStray * *middle; };
  const auto first = std::find_if(counts.begin(), counts.end(), is_full);
  const auto last = std::find_if(counts.rbegin(), counts.rend(), is_full);
  return {static_cast<int>(first - counts.begin()),
          static_cast<int>(counts.size()) - 1 - static_cast<int>(last - counts.rbegin())};
}

ColourRegion Trimmed(const ClassImage& labels, ColourRegion region) {
  std::vector<int> in_columns(static_cast<std::size_t>(region.Width()), 0);
  std::vector<int> in_rows(static_cast<std::size_t>(region.Height()), 0);
  for (int y = region.top; y <= region.bottom; ++y) {
    for (int x = region.left; x <= region.right; ++x) {
      if (labels.At(x, y) == kBackground) continue;
      ++in_columns[static_cast<std::size_t>(x - region.left)];
      ++in_rows[static_cast<std::size_t>(y - region.top)];
    }
  }
  const auto [first_column, last_column] = WithoutStray(in_columns);
  const auto [first_row, last_row] = WithoutStray(in_rows);
  region.right = region.left + last_column;
  region.left += first_column;
  region.bottom = region.top + last_row;
  region.top += first_row;
  return region;
}

bool HasShape(const ColourRegion& region, const ColourCylinder& cylinder,
              const CandidateParams& params) {
  const double ratio = cylinder.diameter_m / cylinder.height_m;
  const double error_px = params.box_error_px;
  const double box_px = static_cast<double>(region.Width()) * region.Height();
  return region.Width() + error_px >= kNarrowest * ratio * (region.Height() - error_px) &&
         region.Width() - error_px <= kWidest * ratio * (region.Height() + error_px) &&
         region.pixels >= params.least_fill * box_px;
}

bool IsAtBorder(const ColourRegion& region, const ClassImage& labels) {
  return region.left < kBorder_px || region.top < kBorder_px ||
         region.right >= labels.width() - kBorder_px ||
         region.bottom >= labels.height() - kBorder_px;
}

// Whether at least two classes have a tenth of the region each. A view of the cylinder shows two or
// three quadrants, of which the second widest has at least (1 - sin 45 deg) / 2 = 15 % of the
// width.
bool HasTwoColours(const ColourRegion& region, const ClassImage& labels) {
  std::array<int, kCylinderColours + 1> counts{};
  for (int y = region.top; y <= region.bottom; ++y) {
    for (int x = region.left; x <= region.right; ++x) ++counts.at(labels.At(x, y));
  }
  return std::count_if(counts.begin() + 1, counts.end(),
                       [&](int count) { return 10 * count >= region.pixels; }) >= 2;
}

EyeRegions RegionsIn(const ClassImage& labels, const ColourCylinder& cylinder,
                     const CandidateParams& params) {
  EyeRegions found;
  std::vector<ColourRegion> regions = FindRegions(labels, WholeOf(labels), RegionColours::kAny);
  std::erase_if(regions, [&](const ColourRegion& region) {
    found.largest_px = std::max(found.largest_px, region.pixels);
    return region.pixels < params.least_whole_px;
  });
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  for (const ColourRegion& region : regions) {
    if (IsAtBorder(region, labels)) {
      if (!found.clipped && HasTwoColours(region, labels)) found.clipped = region;
      continue;
    }
    const ColourRegion trimmed = Trimmed(labels, region);
    if (HasShape(trimmed, cylinder, params) && HasTwoColours(trimmed, labels)) {
      found.whole.push_back(trimmed);
    }
    if (found.whole.size() == kMostRegions) break;
  }
  return found;
}

Pixel MiddleOfBox(const ColourRegion& region) {
  return {0.5 * (region.left + region.right), 0.5 * (region.top + region.bottom)};
}

// How far two sides are apart for their size.
bool AreLike(double a, double b, double tolerance, double error_px) {
  return std::abs(a - b) <= tolerance * std::max(a, b) + error_px;
}

bool AreLikeBoxes(const ColourRegion& a, const ColourRegion& b, const CandidateParams& params) {
  return AreLike(a.Width(), b.Width(), params.size_tolerance, params.box_error_px) &&
         AreLike(a.Height(), b.Height(), params.height_tolerance, params.box_error_px);
}

bool RowsMeet(const ColourPair& pair, const SeenPoint& point, const RegionPair& regions,
              const CandidateParams& params) {
  const auto in_left = Project(pair.left_camera, point.p_L);
  const auto in_right = Project(pair.right_camera, point.p_L);
  if (!in_left || !in_right) return false;
  const double apart_px = std::abs((in_left->y() - MiddleOfBox(regions.left).y()) -
                                   (in_right->y() - MiddleOfBox(regions.right).y()));
  return apart_px <= params.box_error_px;
}

// What became of pairs of regions, for the reason where none is left.
struct PairTally {
  int behind = 0;
  std::string other_size;

  CylinderMiss Miss(std::string& reason) const {
    if (behind > 0) {
      reason =
          "both images show the same region, and lines of sight to it do not meet before the "
          "cameras: are the images swapped?";
      return CylinderMiss::kSwappedEyes;
    }
    if (!other_size.empty()) {
      reason = other_size;
      return CylinderMiss::kNotACylinder;
    }
    reason = "no region of one image is like one of the other";
    return CylinderMiss::kUnlikeEyes;
  }
};

// Adds the pair if it may be the cylinder.
void TryPair(const ColourPair& pair, const EyeGeometry& eyes, const ColourCylinder& cylinder,
             const CandidateParams& params, RegionPair regions, CandidateSearch& search,
             PairTally& tally) {
  if (!AreLikeBoxes(regions.left, regions.right, params)) return;
  const auto point = PointSeenAt(pair, eyes, MiddleOfBox(regions.left), MiddleOfBox(regions.right));
  if (!point) {
    const double rows_px = std::abs(MiddleOfBox(regions.left).y() - MiddleOfBox(regions.right).y());
    if (rows_px <= params.box_error_px) ++tally.behind;
    return;
  }
  if (!RowsMeet(pair, *point, regions, params)) return;
  const double px_a_m = eyes.focal_px / point->depth_m;
  const double width_px = 0.5 * (regions.left.Width() + regions.right.Width());
  const double height_px = 0.5 * (regions.left.Height() + regions.right.Height());
  if (!AreLike(width_px, px_a_m * cylinder.diameter_m, params.size_tolerance,
               params.box_error_px) ||
      !AreLike(height_px, px_a_m * cylinder.height_m, params.height_tolerance,
               params.box_error_px)) {
    tally.other_size = fmt::format(
        "a region of {:.0f} x {:.0f} pixels {:.2f} m away is {:.3f} m wide and {:.3f} m high",
        width_px, height_px, point->depth_m, width_px / px_a_m, height_px / px_a_m);
    return;
  }
  regions.point = *point;
  search.pairs.push_back(regions);
}

}  // namespace

CandidateSearch FindCandidates(const ColourPair& pair, const EyeGeometry& eyes,
                               const ColourCylinder& cylinder, const ClassImage& left,
                               const ClassImage& right, const CandidateParams& params) {
  const EyeRegions in_left = RegionsIn(left, cylinder, params);
  const EyeRegions in_right = RegionsIn(right, cylinder, params);
  CandidateSearch search;
  PairTally tally;
  for (const ColourRegion& a : in_left.whole) {
    for (const ColourRegion& b : in_right.whole) {
      TryPair(pair, eyes, cylinder, params, {a, b, {}}, search, tally);
    }
  }
  if (!search.pairs.empty()) return search;
  if (in_left.clipped || in_right.clipped) {
    search.miss = CylinderMiss::kClipped;
    search.reason = fmt::format("a region of the colours ends at the border of the {} image",
                                in_left.clipped ? "left" : "right");
  } else if (in_left.whole.empty() && in_right.whole.empty()) {
    search.reason = fmt::format(
        "no region has two of the colours, the cylinder's shape and {} pixels; the largest has {}",
        params.least_whole_px, std::max(in_left.largest_px, in_right.largest_px));
  } else {
    search.miss = tally.Miss(search.reason);
  }
  return search;
}

}  // namespace rockyard::vision
