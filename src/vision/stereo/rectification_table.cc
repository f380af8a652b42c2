#include "vision/stereo/rectification_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace rockyard::vision {
namespace {

constexpr double kPositionSteps = 256.0;

struct Coordinate {
  std::int32_t whole;  // of the first of the two pixels, at most size - 2
  std::uint16_t fraction;
};

// Splits a position from 0 to size - 1.
Coordinate Split(double position_px, int size) {
  const auto steps = std::llround(position_px * kPositionSteps);
  const auto whole = static_cast<std::int32_t>(
      std::min<std::int64_t>(steps / 256, static_cast<std::int64_t>(size) - 2));
  return {whole, static_cast<std::uint16_t>(steps - std::int64_t{256} * whole)};
}

// Returns whether a position is inside; false where it is no number.
bool InSource(double position_px, int size) {
  return position_px >= 0.0 && position_px <= size - 1;
}

}  // namespace

RectificationTable::RectificationTable(const Image<SourcePosition>& positions, int source_width,
                                       int source_height)
    : source_width_(source_width),
      source_height_(source_height),
      entries_(positions.width(), positions.height()) {
  EXPECT(source_width >= 2 && source_height >= 2);
  for (std::size_t i = 0; i < positions.values().size(); ++i) {
    const SourcePosition& position = positions.values()[i];
    if (!InSource(position.x_px, source_width) || !InSource(position.y_px, source_height)) continue;
    const Coordinate x = Split(position.x_px, source_width);
    const Coordinate y = Split(position.y_px, source_height);
    entries_.values()[i] = {y.whole * source_width + x.whole, x.fraction, y.fraction};
  }
}

void RectificationTable::RectifyRows(const GrayImage& source, int first_row, int end_row,
                                     GrayImage& out) const {
  EXPECT(source.width() == source_width_ && source.height() == source_height_);
  EXPECT(out.width() == entries_.width() && out.height() == entries_.height());
  const std::span<const std::uint8_t> pixels = source.values();
  for (int y = first_row; y < end_row; ++y) {
    const std::span<const RectificationEntry> row = entries_.Row(y);
    const std::span<std::uint8_t> out_row = out.Row(y);
    for (std::size_t x = 0; x < row.size(); ++x) {
      const RectificationEntry& entry = row[x];
      if (entry.upper_left == RectificationEntry::kOutside) {
        out_row[x] = 0;
        continue;
      }
      const std::uint8_t* const p00 = pixels.data() + entry.upper_left;
      const std::uint8_t* const p01 = p00 + source_width_;
      const std::uint32_t top = p00[0] * (256U - entry.fx) + p00[1] * std::uint32_t{entry.fx};
      const std::uint32_t bottom = p01[0] * (256U - entry.fx) + p01[1] * std::uint32_t{entry.fx};
      out_row[x] = static_cast<std::uint8_t>(
          (top * (256U - entry.fy) + bottom * entry.fy + (1U << 15)) >> 16);
    }
  }
}

GrayImage RectificationTable::Rectify(const GrayImage& source) const {
  GrayImage out(entries_.width(), entries_.height());
  RectifyRows(source, 0, out.height(), out);
  return out;
}

Image<std::uint8_t> RectificationTable::Inside() const {
  Image<std::uint8_t> inside(entries_.width(), entries_.height());
  for (std::size_t i = 0; i < inside.values().size(); ++i) {
    inside.values()[i] = entries_.values()[i].upper_left != RectificationEntry::kOutside ? 1 : 0;
  }
  return inside;
}

}  // namespace rockyard::vision
