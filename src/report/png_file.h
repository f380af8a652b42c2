// Pictures of pixels, and PNG files of them (libpng).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rockyard::report {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

// Row-major, from the upper left corner.
class Picture {
 public:
  // Black. width and height at least 1.
  Picture(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  Rgb& At(int column, int row) { return pixels_[Index(column, row)]; }
  const Rgb& At(int column, int row) const { return pixels_[Index(column, row)]; }
  bool Holds(int column, int row) const {
    return column >= 0 && column < width_ && row >= 0 && row < height_;
  }

 private:
  std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }

  int width_;
  int height_;
  std::vector<Rgb> pixels_;
};

// The bytes of a PNG file, 8 bits a channel. Throws std::runtime_error where libpng fails.
std::string EncodePng(const Picture& picture);

}  // namespace rockyard::report
