#include "campaign/looks/picture_lines.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace rockyard::campaign {
namespace {

using image_files::Picture;
using math::Vector3;
using vision::Pixel;

constexpr double kNearestDepth_m = 0.05;
constexpr int kSideToSee_px = 512;

// The part of 0 <= s <= 1 in which from + s (to - from) lies in [low, high].
struct Share {
  double first = 0.0;
  double last = 1.0;

  void Keep(double from, double to, double low, double high) {
    const double along = to - from;
    if (along == 0.0) {
      if (from < low || from > high) last = -1.0;
      return;
    }
    const double a = (low - from) / along;
    const double b = (high - from) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  bool empty() const { return first > last; }
};

// A square with its upper left corner at (x, y), as far as it lies within the picture.
void DrawDot(int x, int y, int width_px, const image_files::Rgb& colour, Picture& picture) {
  for (int row = y; row < std::min(y + width_px, picture.height()); ++row) {
    for (int column = x; column < std::min(x + width_px, picture.width()); ++column) {
      picture.At(column, row) = colour;
    }
  }
}

}  // namespace

Picture Enlarged(const Picture& picture, int factor) {
  EXPECT(factor >= 1);
  Picture large(picture.width() * factor, picture.height() * factor);
  for (int y = 0; y < large.height(); ++y) {
    for (int x = 0; x < large.width(); ++x) {
      large.At(x, y) = picture.At(x / factor, y / factor);
    }
  }
  return large;
}

int FactorToSee(int width, int height) {
  return std::max(1, kSideToSee_px / std::max({width, height, 1}));
}

std::optional<PictureSegment> ImageOfLine(const vision::Cahv& camera, const Vector3& from_A,
                                          const Vector3& to_A) {
  const Vector3 along = to_A - from_A;
  const double from_m = (from_A - camera.C).dot(camera.A);
  const double to_m = (to_A - camera.C).dot(camera.A);
  Share seen;
  seen.Keep(from_m, to_m, kNearestDepth_m, std::max({kNearestDepth_m, from_m, to_m}));
  if (seen.empty()) return std::nullopt;
  const auto a = vision::Project(camera, from_A + seen.first * along);
  const auto b = vision::Project(camera, from_A + seen.last * along);
  if (!a || !b) return std::nullopt;
  return PictureSegment{*a, *b};
}

void DrawLine(const PictureSegment& line, const image_files::Rgb& colour, int width_px,
              Picture& picture) {
  EXPECT(width_px >= 1);
  const auto& [from, to] = line;
  Share inside;
  inside.Keep(from.x(), to.x(), 0.0, picture.width() - 1.0);
  inside.Keep(from.y(), to.y(), 0.0, picture.height() - 1.0);
  if (inside.empty()) return;
  const Pixel first = from + inside.first * (to - from);
  const Pixel last = from + inside.last * (to - from);
  const int steps =
      std::max(1, static_cast<int>(std::ceil((last - first).lpNorm<Eigen::Infinity>())));
  for (int i = 0; i <= steps; ++i) {
    const Pixel at = first + (last - first) * i / steps;
    // Within by construction, but for rounding.
    const int x = std::clamp(static_cast<int>(std::lround(at.x())), 0, picture.width() - 1);
    const int y = std::clamp(static_cast<int>(std::lround(at.y())), 0, picture.height() - 1);
    DrawDot(x, y, width_px, colour, picture);
  }
}

}  // namespace rockyard::campaign
