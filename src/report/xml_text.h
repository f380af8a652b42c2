// Text inside XML and SVG files; elements of SVG drawings, whose lengths are in px, x to the right
// and y down.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::report {

// Characters that XML takes for its own are written as entities, control characters as blanks: fit
// for elements and for quoted attributes.
std::string EscapeXml(std::string_view text);

struct SvgPoint {
  double x = 0.0;
  double y = 0.0;
};

// Where a part of a drawing stands.
struct SvgFrame {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
};

// The text may hold any characters: it is escaped.
std::string SvgText(double x, double y, std::string_view text, double size = 13.0);
// Styles are attributes, e.g. fill="#fff", and go into the file as they are.
std::string SvgBox(double x, double y, double width, double height, std::string_view style);
std::string SvgLine(SvgPoint from, SvgPoint to, std::string_view style);
std::string SvgPolygon(std::span<const SvgPoint> points, std::string_view style);
std::string SvgPolyline(std::span<const SvgPoint> points, std::string_view style);

// Coordinates within count from the frame's upper left corner, and what lies beyond it is cut off.
std::string SvgPart(const SvgFrame& frame, std::string_view elements);

// The attribute that fills with a colour.
std::string SvgFill(const image_files::Rgb& colour);

}  // namespace rockyard::report
