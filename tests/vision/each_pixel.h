// Images by their pixels.
#pragma once

#include <cstdint>

#include "vision/image.h"

namespace rockyard::vision {

// Row by row; `work` takes column and row.
template <typename Work>
void ForEachPixel(int width, int height, const Work& work) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) work(x, y);
  }
}

// The image whose pixels have the value of their column and row.
template <typename Value = std::uint8_t, typename Grey>
Image<Value> ImageOf(int width, int height, const Grey& grey) {
  Image<Value> image(width, height);
  ForEachPixel(width, height,
               [&](int x, int y) { image.At(x, y) = static_cast<Value>(grey(x, y)); });
  return image;
}

}  // namespace rockyard::vision
