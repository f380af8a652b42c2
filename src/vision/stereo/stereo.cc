#include "vision/stereo/stereo.h"

#include <future>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "vision/stereo/blob.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/dog.h"

namespace rockyard::vision {
namespace {

std::string SizeOf(const GrayImage& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

// Calls work(first row, end row) for `count` bands of nearly equal height, the first by this thread
// and each other by its own; waits for all, also where one fails.
template <typename Work>
void ForEachBand(int rows, int count, const Work& work) {
  std::vector<std::future<void>> others;
  const auto begin = [&](int band) {
    return static_cast<int>(static_cast<std::int64_t>(rows) * band / count);
  };
  for (int band = 1; band < count; ++band) {
    others.push_back(std::async(std::launch::async, work, begin(band), begin(band + 1)));
  }
  work(0, begin(1));
  for (std::future<void>& other : others) other.get();
}

// Makes `image` the size of `like`; where it has this size already, its values stay.
template <typename Value>
void Fit(const GrayImage& like, Image<Value>& image) {
  if (image.width() != like.width() || image.height() != like.height()) {
    image = Image<Value>(like.width(), like.height());
  }
}

}  // namespace

void MatchStereo(const GrayImage& left, const GrayImage& right, const StereoPipelineParams& params,
                 int threads, StereoProducts& products) {
  EXPECT(threads >= 1);
  if (left.width() != right.width() || left.height() != right.height()) {
    throw core::UserError("right image", "is " + SizeOf(right) + ", the left one " + SizeOf(left),
                          "use two images of one size");
  }
  Fit(left, products.left_filtered);
  Fit(left, products.right_filtered);
  Fit(left, products.disparities);
  ForEachBand(left.height(), threads, [&](int first, int end) {
    DifferenceOfGaussiansRows(left, params.dog, first, end, products.left_filtered);
    DifferenceOfGaussiansRows(right, params.dog, first, end, products.right_filtered);
  });
  // All bands must be filtered before this, as windows reach into the rows of other bands.
  ForEachBand(left.height(), threads, [&](int first, int end) {
    CorrelateRows(products.left_filtered, products.right_filtered, params, first, end,
                  products.disparities);
  });
  // The last stage works on all rows at once, as a region may cross the borders of bands.
  FilterBlobs(params.filters, products.disparities);
}

DisparityImage MatchStereo(const GrayImage& left, const GrayImage& right,
                           const StereoPipelineParams& params) {
  StereoProducts products;
  MatchStereo(left, right, params, 1, products);
  return std::move(products.disparities);
}

}  // namespace rockyard::vision
