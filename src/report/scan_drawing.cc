#include "report/scan_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "report/result_table.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

constexpr double kFullColour_m = 0.10;  // elevation of the strongest colour
constexpr double kBehind_m = 0.05;      // of the chassis centre, that is still shown
constexpr double kMargin_m = 0.12;
constexpr double kFooter_m = 0.12;
// Drawn in millimetres: renderers lose text of less than a unit.
constexpr double kUnits = 1000.0;
constexpr double kPixelsPerMetre = 900.0;

// What the drawing holds, in R.
struct Extent {
  double x_min_m = std::numeric_limits<double>::infinity();
  double x_max_m = -std::numeric_limits<double>::infinity();
  double y_min_m = std::numeric_limits<double>::infinity();
  double y_max_m = -std::numeric_limits<double>::infinity();

  void Include(double x_m, double y_m) {
    x_min_m = std::min(x_min_m, x_m);
    x_max_m = std::max(x_max_m, x_m);
    y_min_m = std::min(y_min_m, y_m);
    y_max_m = std::max(y_max_m, y_m);
  }
};

Extent ExtentOf(const ScanView& scan) {
  Extent extent;
  for (const auto& [x, y] : scan.rover) extent.Include(std::max(x, -kBehind_m), y);
  for (const ShownPoint& point : scan.points.points()) {
    extent.Include(point.expected_R.x(), point.expected_R.y());
  }
  extent.x_max_m += kMargin_m;
  extent.y_min_m -= kMargin_m;
  extent.y_max_m += kMargin_m;
  return extent;
}

// SVG coordinates of a point of R: forward is up, left is left.
SvgPoint At(double x_R_m, double y_R_m) { return {-kUnits * y_R_m, -kUnits * x_R_m}; }

std::string Polygon(const GroundOutline& outline, std::string_view style) {
  std::vector<SvgPoint> points;
  for (const auto& [x, y] : outline) points.push_back(At(x, y));
  return SvgPolygon(points, style);
}

std::string Colour(double elevation_m) {
  const double share = std::clamp(elevation_m / kFullColour_m, -1.0, 1.0);
  const int fade = static_cast<int>(std::lround(255.0 * (1.0 - std::abs(share))));
  return share >= 0.0 ? fmt::format("rgb(255,{0},{0})", fade)
                      : fmt::format("rgb({0},{0},255)", fade);
}

std::string Line(const math::Vector3& from_R, const math::Vector3& to_R, std::string_view style) {
  return SvgLine(At(from_R.x(), from_R.y()), At(to_R.x(), to_R.y()), style);
}

// A white rectangle, from its upper left corner.
std::string Rectangle(const SvgPoint& corner, double width_m, double height_m) {
  return SvgBox(corner.x, corner.y, kUnits * width_m, kUnits * height_m, "fill=\"#fff\"");
}

std::string PointMark(const ShownPoint& point) {
  if (!point.elevation.detected) {
    const math::Vector3 arm(0.012, 0.012, 0.0);
    const math::Vector3 other(0.012, -0.012, 0.0);
    constexpr std::string_view kStyle = "stroke=\"#888\" stroke-width=\"4\"";
    return Line(point.expected_R - arm, point.expected_R + arm, kStyle) +
           Line(point.expected_R - other, point.expected_R + other, kStyle);
  }
  const SvgPoint at = At(point.p_RoP_R.x(), point.p_RoP_R.y());
  const double elevation_m = point.elevation.elevation_m;
  return fmt::format(
             "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"14\" fill=\"{}\" stroke=\"#000\" "
             "stroke-width=\"2\"/>\n",
             at.x, at.y, Colour(elevation_m)) +
         SvgText(at.x + 18.0, at.y + 6.0, fmt::format("{:.0f}", 1000.0 * elevation_m), 20.0);
}

std::string Stripes(const ScanView& scan) {
  std::string svg;
  for (std::size_t stripe = 0; stripe < scan.points.stripes(); ++stripe) {
    const bool hazard = scan.hazards.stripe_hazard[stripe];
    svg += Line(
        scan.calibration.lasers[stripe].p_RoE_R,
        scan.points[scan.points.rows() - 1][stripe].expected_R,
        hazard ? "stroke=\"#d22\" stroke-width=\"6\"" : "stroke=\"#e9a0a0\" stroke-width=\"3\"");
  }
  return svg;
}

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

std::string ScanSvg(const ScanView& scan) {
  const Extent extent = ExtentOf(scan);
  const double width_m = extent.y_max_m - extent.y_min_m;
  const double height_m = extent.x_max_m - extent.x_min_m + kFooter_m;
  const SvgPoint corner = At(extent.x_max_m, extent.y_max_m);
  const SvgPoint foot = At(extent.x_min_m, extent.y_max_m);
  const std::string box = fmt::format("{:.1f} {:.1f} {:.1f} {:.1f}", corner.x, corner.y,
                                      kUnits * width_m, kUnits * height_m);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" "
      "viewBox=\"{}\">\n",
      kPixelsPerMetre * width_m, kPixelsPerMetre * height_m, box);
  svg += Rectangle(corner, width_m, height_m);
  for (const GroundOutline& rock : scan.rocks) {
    svg += Polygon(rock, "fill=\"#c9b8a0\" stroke=\"#7a6a50\" stroke-width=\"3\"");
  }
  svg += Polygon(scan.rover, "fill=\"none\" stroke=\"#333\" stroke-width=\"4\"");
  svg += Stripes(scan);
  for (const ShownPoint& point : scan.points.points()) svg += PointMark(point);
  svg += Rectangle(foot, width_m, kFooter_m);
  svg += SvgText(foot.x + 20.0, foot.y + 45.0, scan.title, 26.0);
  svg += SvgText(foot.x + 20.0, foot.y + 85.0,
                 "elevation in mm; cross: not found; red stripe: hazard; forward is up", 22.0);
  return svg + "</svg>\n";
}

std::string ScanText(const ScanView& scan) {
  std::string text = "  elevation [mm], farthest row first, left to right\n";
  for (std::size_t row = scan.points.rows(); row-- > 0;) {
    text += "   ";
    for (const ShownPoint& point : scan.points[row]) {
      text += point.elevation.detected
                  ? fmt::format(" {:>6.0f}", 1000.0 * point.elevation.elevation_m)
                  : fmt::format(" {:>6}", "-");
    }
    text += '\n';
  }
  text += "   ";
  for (const bool hazard : scan.hazards.stripe_hazard) {
    text += fmt::format(" {:>6}", hazard ? "hazard" : "clear");
  }
  return text + '\n';
}

std::string ScanCsv(const ScanView& scan) {
  std::string csv = "stripe,row,detected,column_px,elevation_m,x_m,y_m,hazard\n";
  for (std::size_t stripe = 0; stripe < scan.points.stripes(); ++stripe) {
    for (std::size_t row = 0; row < scan.points.rows(); ++row) {
      const ShownPoint& point = scan.points[row][stripe];
      // What was not found is no number, and leaves its field empty.
      const double found =
          point.elevation.detected ? 1.0 : std::numeric_limits<double>::quiet_NaN();
      csv += CsvLine(stripe, row, point.elevation.detected, found * point.pixel.column_px,
                     found * point.elevation.elevation_m, found * point.p_RoP_R.x(),
                     found * point.p_RoP_R.y(), bool{scan.hazards.stripe_hazard[stripe]});
    }
  }
  return csv;
}

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
