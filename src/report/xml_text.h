// Reports in JUnit's form, for checks; elements of SVG drawings, whose lengths are in px, x to the
// right and y down, for the drawings of trials, sweeps and measurements; and colours of maps and of
// curves. No record depends on them; pictures of looks, stereo and odometry take RampColour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::report {

// One test of a JUnit report.
struct JUnitCase {
  std::string suite;
  std::string name;
  std::string_view element;  // "failure" or "skipped"; empty: passed
  std::string message;
};

// `properties`: XML that stands before the cases.
std::string JUnitReport(std::string_view name, std::span<const JUnitCase> cases,
                        std::string_view properties = "");

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
// In the font of the drawing, with a style of its own.
std::string SvgStyledText(double x, double y, std::string_view text, std::string_view style);
// Styles are attributes, e.g. fill="#fff", and go into the file as they are.
std::string SvgBox(double x, double y, double width, double height, std::string_view style);
std::string SvgLine(SvgPoint from, SvgPoint to, std::string_view style);
std::string SvgPolygon(std::span<const SvgPoint> points, std::string_view style);
std::string SvgPolyline(std::span<const SvgPoint> points, std::string_view style);

// A curve at one x: its height, and the ends of what it may be.
struct SvgBandPoint {
  double x = 0.0;
  double y = 0.0;
  double low = 0.0;
  double high = 0.0;
};

// A line, and the band around it in the same colour.
std::string SvgBand(std::span<const SvgBandPoint> points, std::string_view colour, double opacity,
                    std::string_view stroke);

// Coordinates within count from the frame's upper left corner, and what lies beyond it is cut off.
std::string SvgPart(const SvgFrame& frame, std::string_view elements);

// The attribute that fills with a colour.
std::string SvgFill(const image_files::Rgb& colour);

// A sequential colour ramp that keeps its order for colour-blind readers and in grey print: dark
// violet at 0, green-blue in the middle, yellow at 1; shares beyond are clamped. Luminance grows
// all the way.
image_files::Rgb RampColour(double share);

// The colour of a goodness or certainty: 0 to 255.
image_files::Rgb ByteColour(std::uint8_t value);

// Colours of curves that stay apart for colour-blind readers (Okabe and Ito 2008).
inline constexpr std::array<std::string_view, 7> kCurveColours{
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};

// The colour of a curve; after the last they come again.
constexpr std::string_view CurveColour(std::size_t curve) {
  return kCurveColours[curve % kCurveColours.size()];
}

}  // namespace rockyard::report
