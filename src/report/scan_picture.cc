#include "report/scan_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"

namespace rockyard::report {
namespace {

constexpr image_files::Rgb kFound{60, 220, 60};
constexpr image_files::Rgb kHazard{255, 60, 50};
constexpr image_files::Rgb kSearched{80, 140, 255};
constexpr double kWhiteShare = 0.999;  // of the pixels are below white
constexpr int kCrossArm_px = 5;
constexpr int kDotsAbove_px = 9;
constexpr int kDotSpacing_px = 6;

// The value that kWhiteShare of the values do not reach, at least 1 so that an image without light
// stays black.
double WhiteOf(std::vector<double> values) {
  const auto at = static_cast<std::ptrdiff_t>(kWhiteShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return std::max(1.0, values[static_cast<std::size_t>(at)]);
}

image_files::Picture GreyPicture(int width, int height, std::span<const double> values) {
  image_files::Picture picture(width, height);
  const double white = WhiteOf({values.begin(), values.end()});
  std::size_t index = 0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double share = std::clamp(values[index++] / white, 0.0, 1.0);
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(share)));
      picture.At(column, row) = {grey, grey, grey};
    }
  }
  return picture;
}

// Draws by the image coordinates of a band.
class BandCanvas {
 public:
  BandCanvas(const messages::ImageBand& band, image_files::Picture& picture)
      : band_(band), picture_(picture) {}

  void Dot(int column, int row, const image_files::Rgb& colour) {
    const int x = column - band_.first_column;
    const int y = row - band_.first_row;
    const bool inside = x >= 0 && x < picture_.width() && y >= 0 && y < picture_.height();
    if (inside) picture_.At(x, y) = colour;
  }

  void Cross(int column, int row, const image_files::Rgb& colour) {
    for (int arm = 2; arm <= kCrossArm_px; ++arm) {
      Dot(column - arm, row - arm, colour);
      Dot(column + arm, row - arm, colour);
      Dot(column - arm, row + arm, colour);
      Dot(column + arm, row + arm, colour);
    }
  }

 private:
  const messages::ImageBand& band_;
  image_files::Picture& picture_;
};

void DrawPoint(const ShownPoint& point, int row, bool hazard, BandCanvas& canvas) {
  for (int at = point.searched_first_px; at <= point.searched_last_px; at += kDotSpacing_px) {
    canvas.Dot(at, row - kDotsAbove_px, kSearched);
  }
  if (!point.pixel.detected) return;
  canvas.Cross(static_cast<int>(std::lround(point.pixel.column_px)), row,
               hazard ? kHazard : kFound);
}

}  // namespace

image_files::Picture FramePicture(const messages::ImageBand& band) {
  EXPECT(band.counts.size() ==
         static_cast<std::size_t>(band.rows) * static_cast<std::size_t>(band.columns));
  const std::vector<double> values(band.counts.begin(), band.counts.end());
  return GreyPicture(band.columns, band.rows, values);
}

image_files::Picture DifferencePicture(const ScanView& scan,
                                       const messages::StripeExposure& exposure,
                                       std::span<const double> difference) {
  EXPECT(!exposure.lit.empty());
  const messages::ImageBand& band = exposure.lit.front();
  EXPECT(difference.size() == band.counts.size());
  image_files::Picture picture = GreyPicture(band.columns, band.rows, difference);
  BandCanvas canvas(band, picture);
  for (std::size_t stripe = 0; stripe < scan.points.stripes(); ++stripe) {
    const messages::StripeLaser& laser = scan.calibration.lasers[stripe];
    if (laser.camera != exposure.camera || laser.group != exposure.group) continue;
    for (std::size_t row = 0; row < scan.points.rows(); ++row) {
      DrawPoint(scan.points[row][stripe], scan.calibration.scanline_px[row],
                scan.hazards.stripe_hazard[stripe], canvas);
    }
  }
  return picture;
}

}  // namespace rockyard::report
