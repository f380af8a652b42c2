#include "report/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/text.h"

namespace rockyard::report {
namespace {

std::string PointsElement(std::string_view name, std::span<const SvgPoint> points,
                          std::string_view style) {
  std::string svg = fmt::format("<{} points=\"", name);
  for (const SvgPoint& point : points) {
    fmt::format_to(std::back_inserter(svg), "{:.1f},{:.1f} ", point.x, point.y);
  }
  return svg + fmt::format("\" {}/>\n", style);
}

}  // namespace

std::string JUnitReport(std::string_view name, std::span<const JUnitCase> cases,
                        std::string_view properties) {
  const auto count = [&](std::string_view element) {
    return std::count_if(cases.begin(), cases.end(),
                         [&](const JUnitCase& each) { return each.element == element; });
  };
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}",
      core::EscapeXml(name), cases.size(), count("failure"), count("skipped"), properties);
  for (const JUnitCase& each : cases) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", core::EscapeXml(each.suite),
                       core::EscapeXml(each.name));
    xml += each.element.empty() ? "/>\n"
                                : fmt::format(">\n    <{} message=\"{}\"/>\n  </testcase>\n",
                                              each.element, core::EscapeXml(each.message));
  }
  return xml + "</testsuite>\n";
}

std::string SvgText(double x, double y, std::string_view text, double size) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.0f}\" font-family=\"sans-serif\">{}</text>\n",
      x, y, size, core::EscapeXml(text));
}

std::string SvgStyledText(double x, double y, std::string_view text, std::string_view style) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style,
                     core::EscapeXml(text));
}

std::string SvgBox(double x, double y, double width, double height, std::string_view style) {
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", x,
                     y, width, height, style);
}

std::string SvgLine(SvgPoint from, SvgPoint to, std::string_view style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x,
                     from.y, to.x, to.y, style);
}

std::string SvgPolygon(std::span<const SvgPoint> points, std::string_view style) {
  return PointsElement("polygon", points, style);
}

std::string SvgPolyline(std::span<const SvgPoint> points, std::string_view style) {
  return PointsElement("polyline", points, style);
}

std::string SvgBand(std::span<const SvgBandPoint> points, std::string_view colour, double opacity,
                    std::string_view stroke) {
  std::vector<SvgPoint> line;
  std::vector<SvgPoint> band;
  for (const SvgBandPoint& point : points) {
    line.push_back({point.x, point.y});
    band.push_back({point.x, point.high});
  }
  for (std::size_t i = points.size(); i-- > 0;) band.push_back({points[i].x, points[i].low});
  return SvgPolygon(band, fmt::format("fill=\"{}\" fill-opacity=\"{}\"", colour, opacity)) +
         SvgPolyline(line, fmt::format("fill=\"none\" {}", stroke));
}

std::string SvgPart(const SvgFrame& frame, std::string_view elements) {
  return fmt::format(
      "<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">\n{}</svg>\n", frame.left,
      frame.top, frame.width, frame.height, elements);
}

std::string SvgFill(const image_files::Rgb& colour) {
  return fmt::format("fill=\"#{:02x}{:02x}{:02x}\"", colour.red, colour.green, colour.blue);
}

namespace {

// Support colours of ramps of this kind (dark violet, blue, blue-green, green, yellow), evenly
// spaced. Must agree with src/web/replay/palette.ts: pages and drawings show the same.
constexpr std::array<image_files::Rgb, 5> kSupport{
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};

std::uint8_t Mix(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

image_files::Rgb RampColour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kSupport.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kSupport.size() - 2);
  const double rest = place - static_cast<double>(below);
  const image_files::Rgb& a = kSupport[below];
  const image_files::Rgb& b = kSupport[below + 1];
  return {Mix(a.red, b.red, rest), Mix(a.green, b.green, rest), Mix(a.blue, b.blue, rest)};
}

image_files::Rgb ByteColour(std::uint8_t value) { return RampColour(value / 255.0); }

}  // namespace rockyard::report
