#include "report/xml_text.h"

#include <fmt/format.h>

#include <iterator>

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

std::string EscapeXml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

std::string SvgText(double x, double y, std::string_view text, double size) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.0f}\" font-family=\"sans-serif\">{}</text>\n",
      x, y, size, EscapeXml(text));
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

std::string SvgPart(const SvgFrame& frame, std::string_view elements) {
  return fmt::format(
      "<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">\n{}</svg>\n", frame.left,
      frame.top, frame.width, frame.height, elements);
}

std::string SvgFill(const image_files::Rgb& colour) {
  return fmt::format("fill=\"#{:02x}{:02x}{:02x}\"", colour.red, colour.green, colour.blue);
}

}  // namespace rockyard::report
