#include "vision/cylinder/cylinder_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// Bands lie within the middle half of the wall, and within the middle four fifths of the rows that
// show the wall from side to side.
constexpr double kMiddleShare = 0.5;
constexpr double kFullShare = 0.8;
constexpr int kMostBands = 3;
// Columns beside the box: mixed ones, and behind these the least number that tells the background.
constexpr int kMixed_px = 2;
constexpr int kLeastBackground_px = 4;
// The share of the box's width on either side that is left out where the rims are found.
// kRimsAhead (fit_problem.cc) must follow from it.
constexpr double kRimShare = 0.2;
constexpr int kBackgroundRows = 4;

Eigen::Vector3d ColourAt(const ColourImage& image, int x, int y) {
  const Rgb& pixel = image.At(x, y);
  return {static_cast<double>(pixel.red), static_cast<double>(pixel.green),
          static_cast<double>(pixel.blue)};
}

// Returns the mean over a rectangle, ends inclusive.
Eigen::Vector3d MeanColour(const ColourImage& image, int left, int right, int top, int bottom) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) sum += ColourAt(image, x, y);
  }
  return sum / ((right - left + 1.0) * (bottom - top + 1.0));
}

// The mean colour of some columns and the variance of a primary between them.
struct Background {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double variance = 0.0;
};

Background BackgroundOf(const std::vector<Eigen::Vector3d>& colours, int first, int last) {
  Background background;
  const int count = last - first + 1;
  EXPECT(count >= 1);
  for (int i = first; i <= last; ++i) background.mean += colours[static_cast<std::size_t>(i)];
  background.mean /= count;
  for (int i = first; i <= last; ++i) {
    background.variance +=
        (colours[static_cast<std::size_t>(i)] - background.mean).squaredNorm() / (3.0 * count);
  }
  return background;
}

// Returns the root of (variance I + (brightness_sd c)(brightness_sd c)^T)^-1 for a colour c.
Eigen::Matrix3d Whitening(double variance, double brightness_sd, const Eigen::Vector3d& colour) {
  const Eigen::Vector3d along = colour.normalized();
  const double bright = brightness_sd * brightness_sd * colour.squaredNorm();
  const double kept = std::sqrt(variance / (variance + bright));
  return (Eigen::Matrix3d::Identity() - (1.0 - kept) * along * along.transpose()) /
         std::sqrt(variance);
}

// Fills in the background and the whitening. `box_first` and `box_last` are the first and the last
// column of the band in the box.
void AddBackground(int box_first, int box_last, double inside_variance, double brightness_sd,
                   ProfileBand& band) {
  const int last = static_cast<int>(band.colours.size()) - 1;
  const int left_end = std::max(box_first - 1 - kMixed_px, 0);
  const int right_start = std::min(box_last + 1 + kMixed_px, last);
  const Background left = BackgroundOf(band.colours, 0, left_end);
  const Background right = BackgroundOf(band.colours, right_start, last);
  band.left_background = left.mean;
  band.right_background = right.mean;
  band.whitening.resize(band.colours.size());
  for (int i = 0; i <= last; ++i) {
    double variance = inside_variance;
    if (i <= box_first) variance += (i < box_first - 1 ? 1.0 : 0.5) * left.variance;
    if (i >= box_last) variance += (i > box_last + 1 ? 1.0 : 0.5) * right.variance;
    const bool is_wall = i >= box_first && i <= box_last;
    band.whitening[static_cast<std::size_t>(i)] = Whitening(
        variance, is_wall ? brightness_sd : 0.0, band.colours[static_cast<std::size_t>(i)]);
  }
}

// Returns how many rows from `end` towards `middle` show the wall. Each counts by the share at
// which its colour lies between that beyond the rim and that of the wall.
double RowsOfWall(const ColourImage& image, int left, int right, int end, int middle,
                  const Eigen::Vector3d& wall) {
  const int step = end < middle ? 1 : -1;
  const int background_last = end + step * (kBackgroundRows - 1);
  const Eigen::Vector3d beyond = MeanColour(image, left, right, std::min(end, background_last),
                                            std::max(end, background_last));
  const Eigen::Vector3d change = wall - beyond;
  double rows = 0.0;
  for (int y = end; y != middle; y += step) {
    const Eigen::Vector3d colour = MeanColour(image, left, right, y, y);
    const double share = change.dot(colour - beyond) / std::max(change.squaredNorm(), 1.0);
    rows += std::clamp(share, 0.0, 1.0);
  }
  return rows;
}

void FindRims(const ColourImage& image, const ColourRegion& box, EyeProfile& profile) {
  const int aside_px = static_cast<int>(kRimShare * box.Width());
  const int left = box.left + aside_px;
  const int right = box.right - aside_px;
  const int middle = (box.top + box.bottom) / 2;
  const int quarter = box.Height() / 4;
  const Eigen::Vector3d wall =
      MeanColour(image, left, right, box.top + quarter, box.bottom - quarter);
  const int above = std::max(box.top - kMixed_px - kBackgroundRows, 0);
  const int below = std::min(box.bottom + kMixed_px + kBackgroundRows, image.height() - 1);
  profile.upper_rim_px = middle - 0.5 - RowsOfWall(image, left, right, above, middle, wall);
  profile.lower_rim_px = middle + 0.5 + RowsOfWall(image, left, right, below, middle, wall);
}

// Returns the first and the last row of the bands, within the box; at least one row. Where the
// middle of a rim lies `sag_px` below its ends, the wall is seen from side to side between the
// upper rim's middle and the lower rim's ends; with a negative sag, between the upper rim's ends
// and the lower rim's middle.
std::pair<int, int> RowsOfBands(const ColourRegion& box, const EyeProfile& profile, double sag_px) {
  const double top = profile.upper_rim_px - std::min(sag_px, 0.0);
  const double bottom = profile.lower_rim_px - std::max(sag_px, 0.0);
  const double middle = 0.5 * (top + bottom);
  const double rows = std::min(kMiddleShare * (profile.lower_rim_px - profile.upper_rim_px),
                               kFullShare * (bottom - top));
  const int first =
      std::clamp(static_cast<int>(std::ceil(middle - 0.5 * rows)), box.top, box.bottom);
  const int last = static_cast<int>(std::floor(middle + 0.5 * rows));
  return {first, std::clamp(last, first, box.bottom)};
}

}  // namespace

EyeProfile ProfileOf(const ColourImage& image, const ColourRegion& box, double sag_px,
                     const CylinderFitParams& params) {
  EXPECT(box.left >= 1 && box.right < image.width() - 1 && box.top >= 0 &&
         box.bottom < image.height());
  EyeProfile profile;
  const int around_px = 1 + kMixed_px + std::max(kLeastBackground_px, box.Width() / 16);
  profile.first_column = std::max(box.left - around_px, 0);
  const int last_column = std::min(box.right + around_px, image.width() - 1);
  FindRims(image, box, profile);
  const auto [first_row, last_row] = RowsOfBands(box, profile, sag_px);
  profile.level = MeanColour(image, box.left, box.right, first_row, last_row).mean();
  const int rows = last_row - first_row + 1;
  const int bands = std::min(rows, kMostBands);
  for (int i = 0; i < bands; ++i) {
    const int top = first_row + rows * i / bands;
    const int bottom = first_row + rows * (i + 1) / bands - 1;
    ProfileBand band;
    band.row = 0.5 * (top + bottom);
    for (int x = profile.first_column; x <= last_column; ++x) {
      band.colours.push_back(MeanColour(image, x, x, top, bottom));
    }
    const double surface_grey = params.surface_noise * profile.level;
    const double inside_variance =
        params.noise_grey * params.noise_grey / (bottom - top + 1) + surface_grey * surface_grey;
    AddBackground(box.left - profile.first_column, box.right - profile.first_column,
                  inside_variance, params.brightness_sd, band);
    profile.bands.push_back(std::move(band));
  }
  return profile;
}

}  // namespace rockyard::vision
