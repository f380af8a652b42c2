#include "scalar_pipeline.h"

#include <algorithm>
#include <cstddef>

#include "core/check.h"
#include "vision/stereo/dog.h"

namespace rockyard::vision {
namespace {

ScalarFilter FilterOf(const DogParams& params) {
  EXPECT(params.kind == DogKind::kLaplacian);
  const DogWeights weights = MakeDogWeights(params);
  return {static_cast<int>(params.narrow_side_px), static_cast<int>(params.wide_side_px),
          weights.first, weights.second, static_cast<int>(params.limit)};
}

}  // namespace

StereoPipelineParams AsPrinted() {
  return {.dog = kLaplacianDog, .filters = {.interpolation = Interpolation::kQuadratic}};
}

ScalarPipeline::ScalarPipeline(const ScalarStages& stages, int width,
                               const StereoPipelineParams& params)
    : stages_(&stages),
      filter_(FilterOf(params.dog)),
      limits_(MakePeakLimits(params.filters, params.correlator)),
      rows_{} {
  const int side = static_cast<int>(params.correlator.window_side_px);
  EXPECT(side >= 2 && width >= side);
  rows_.width = width;
  rows_.before = side / 2;
  rows_.after = side - 1 - side / 2;
  rows_.min_disparity = static_cast<int>(params.correlator.min_disparity_px);
  rows_.disparities = static_cast<int>(params.correlator.disparities);
  const auto pixels = static_cast<std::size_t>(width);
  const std::size_t entries = pixels * static_cast<std::size_t>(rows_.disparities);
  columns_.resize(entries);
  scores_.resize(entries);
  left_best_.resize(pixels);
  right_best_.resize(pixels);
  left_index_.resize(pixels);
  right_index_.resize(pixels);
  sums_.resize(2 * pixels);
  zeros_.resize(pixels);
  rows_.columns = columns_.data();
  rows_.scores = scores_.data();
  rows_.left_best = left_best_.data();
  rows_.right_best = right_best_.data();
  rows_.left_index = left_index_.data();
  rows_.right_index = right_index_.data();
}

GrayImage ScalarPipeline::Reduce(const GrayImage& image, int level) const {
  if (level == 0) return image;
  GrayImage out(image.width() >> level, image.height() >> level);
  stages_->reduce(image.values().data(), image.width(), image.height(), level, out.values().data());
  return out;
}

void ScalarPipeline::Filter(const GrayImage& image, GrayImage& out) {
  EXPECT(image.width() == rows_.width && out.width() == image.width());
  EXPECT(out.height() == image.height());
  stages_->filter(image.values().data(), image.width(), image.height(), filter_, sums_.data(),
                  out.values().data());
}

void ScalarPipeline::Correlate(const GrayImage& left, const GrayImage& right, RowStage last,
                               DisparityImage& out) {
  EXPECT(left.width() == rows_.width && right.width() == left.width());
  EXPECT(right.height() == left.height() && out.height() == left.height());
  const int side = rows_.before + 1 + rows_.after;
  std::fill(columns_.begin(), columns_.end(), 0);
  std::fill(out.values().begin(), out.values().end(), Dropped(Drop::kOutside));
  for (int y = 0; y < left.height(); ++y) {
    const bool full = y >= side;
    stages_->prepare(rows_, left.Row(y).data(), right.Row(y).data(),
                     full ? left.Row(y - side).data() : zeros_.data(),
                     full ? right.Row(y - side).data() : zeros_.data());
    if (y + 1 < side || last == RowStage::kPrepare) continue;
    stages_->compare(rows_);
    if (last == RowStage::kDecide) stages_->decide(rows_, limits_, out.Row(y - rows_.after).data());
  }
}

}  // namespace rockyard::vision
