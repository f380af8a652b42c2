#include "image_files/ply_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/check.h"
#include "image_files/header_text.h"

namespace rockyard::image_files {
namespace {

bool CanBeWritten(const ColouredPoint& point) { return point.position.cast<float>().allFinite(); }

}  // namespace

std::string EncodePly(std::span<const ColouredPoint> points, std::string_view comment) {
  EXPECT(comment.find_first_of("\n\r") == std::string_view::npos);
  constexpr std::size_t kBytesAPoint = 15;
  std::string file = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      comment, std::count_if(points.begin(), points.end(), CanBeWritten));
  file.reserve(file.size() + kBytesAPoint * points.size());
  for (const ColouredPoint& point : points) {
    if (!CanBeWritten(point)) continue;
    for (const double coordinate : point.position) {
      AppendLittleEndian(static_cast<float>(coordinate), file);
    }
    for (const std::uint8_t channel : {point.colour.red, point.colour.green, point.colour.blue}) {
      file += static_cast<char>(channel);
    }
  }
  return file;
}

}  // namespace rockyard::image_files
