#include "scalar_stages.h"

#include "vision/stereo/disparity.h"

namespace rockyard::vision {
namespace {

constexpr std::int16_t kOutside = Dropped(Drop::kOutside);
constexpr std::int16_t kLineOfSight = Dropped(Drop::kLineOfSight);
constexpr std::int16_t kRangeEnd = Dropped(Drop::kRangeEnd);
constexpr std::int16_t kPeak = Dropped(Drop::kPeak);
constexpr std::int16_t kContrast = Dropped(Drop::kContrast);
constexpr std::uint16_t kNone = 0xFFFF;

int AbsoluteDifference(int a, int b) { return a > b ? a - b : b - a; }

int Inside(int i, int size) { return i < 0 ? 0 : i < size ? i : size - 1; }

void Reduce(const std::uint8_t* image, int width, int height, int level, std::uint8_t* out) {
  const int side = 1 << level;
  for (int y = 0; y + side <= height; y += side) {
    for (int x = 0; x + side <= width; x += side) {
      int sum = 1 << (2 * level - 1);
      for (int k = 0; k < side; ++k) {
        const std::uint8_t* const row = image + (y + k) * width + x;
        for (int i = 0; i < side; ++i) sum += row[i];
      }
      *out++ = static_cast<std::uint8_t>(sum >> (2 * level));
    }
  }
}

// Column sums of a square around row y, from those around the row above.
void SlideDown(const std::uint8_t* image, int width, int height, int half, int y,
               std::int32_t* sums) {
  const std::uint8_t* const in = image + Inside(y + half, height) * width;
  const std::uint8_t* const out = image + Inside(y - 1 - half, height) * width;
  for (int x = 0; x < width; ++x) sums[x] += in[x] - out[x];
}

void StartSums(const std::uint8_t* image, int width, int height, int half, std::int32_t* sums) {
  for (int x = 0; x < width; ++x) sums[x] = 0;
  for (int k = -half; k <= half; ++k) {
    const std::uint8_t* const row = image + Inside(k - 1, height) * width;
    for (int x = 0; x < width; ++x) sums[x] += row[x];
  }
}

// Sum of the square around x = -1, in a row whose columns repeat beyond its ends.
std::int32_t FirstSum(const std::int32_t* sums, int width, int half) {
  std::int32_t sum = 0;
  for (int i = -half; i <= half; ++i) sum += sums[Inside(i - 1, width)];
  return sum;
}

void WeighRow(const std::int32_t* narrow, const std::int32_t* wide, int width,
              const ScalarFilter& filter, std::uint8_t* out) {
  const int near = filter.narrow_side / 2;
  const int far = filter.wide_side / 2;
  std::int32_t s = FirstSum(narrow, width, near);
  std::int32_t w = FirstSum(wide, width, far);
  for (int x = 0; x < width; ++x) {
    s += narrow[Inside(x + near, width)] - narrow[Inside(x - 1 - near, width)];
    w += wide[Inside(x + far, width)] - wide[Inside(x - 1 - far, width)];
    int value = (s * filter.narrow_weight - w * filter.wide_weight + (1 << 19)) >> 20;
    if (value > filter.limit) value = filter.limit;
    if (value < -filter.limit) value = -filter.limit;
    out[x] = static_cast<std::uint8_t>(value + filter.limit);
  }
}

void Filter(const std::uint8_t* image, int width, int height, const ScalarFilter& filter,
            std::int32_t* sums, std::uint8_t* out) {
  std::int32_t* const narrow = sums;
  std::int32_t* const wide = sums + width;
  StartSums(image, width, height, filter.narrow_side / 2, narrow);
  StartSums(image, width, height, filter.wide_side / 2, wide);
  for (int y = 0; y < height; ++y) {
    SlideDown(image, width, height, filter.narrow_side / 2, y, narrow);
    SlideDown(image, width, height, filter.wide_side / 2, y, wide);
    WeighRow(narrow, wide, width, filter, out + y * width);
  }
}

// Disparities, counted from the smallest, whose windows lie in both images.
int FirstCandidate(const ScalarRows& rows, int x) {
  const int first = x + rows.after - rows.width + 1 - rows.min_disparity;
  return first > 0 ? first : 0;
}
int EndCandidate(const ScalarRows& rows, int x) {
  const int end = x - rows.before - rows.min_disparity + 1;
  return end < rows.disparities ? end : rows.disparities;
}

void SlideColumns(const ScalarRows& rows, const std::uint8_t* left_in, const std::uint8_t* right_in,
                  const std::uint8_t* left_out, const std::uint8_t* right_out) {
  for (int x = 0; x < rows.width; ++x) {
    std::uint16_t* const columns = rows.columns + x * rows.disparities;
    const int right = x - rows.min_disparity;
    const int first = right >= rows.width ? right - rows.width + 1 : 0;
    const int end = right + 1 < rows.disparities ? right + 1 : rows.disparities;
    const int in = left_in[x];
    const int out = left_out[x];
    for (int i = first; i < end; ++i) {
      columns[i] =
          static_cast<std::uint16_t>(columns[i] + AbsoluteDifference(in, right_in[right - i]) -
                                     AbsoluteDifference(out, right_out[right - i]));
    }
  }
}

void SlideAlong(const ScalarRows& rows) {
  const int n = rows.disparities;
  for (int i = 0; i < n; ++i) {
    int sum = 0;
    for (int x = 0; x < rows.before + rows.after; ++x) sum += rows.columns[x * n + i];
    rows.scores[(rows.before - 1) * n + i] = static_cast<std::uint16_t>(sum);
  }
  for (int x = rows.before; x + rows.after < rows.width; ++x) {
    const std::uint16_t* const in = rows.columns + (x + rows.after) * n;
    const std::uint16_t* const out = rows.columns + (x - 1 - rows.before) * n;
    const std::uint16_t* const last = rows.scores + (x - 1) * n;
    std::uint16_t* const scores = rows.scores + x * n;
    const bool leaves = x > rows.before;
    for (int i = 0; i < n; ++i) {
      scores[i] = static_cast<std::uint16_t>(last[i] + in[i] - (leaves ? out[i] : 0));
    }
  }
}

void Prepare(const ScalarRows& rows, const std::uint8_t* left_in, const std::uint8_t* right_in,
             const std::uint8_t* left_out, const std::uint8_t* right_out) {
  SlideColumns(rows, left_in, right_in, left_out, right_out);
  SlideAlong(rows);
}

void Compare(const ScalarRows& rows) {
  for (int x = 0; x < rows.width; ++x) {
    rows.left_best[x] = kNone;
    rows.right_best[x] = kNone;
  }
  for (int x = rows.before; x + rows.after < rows.width; ++x) {
    const std::uint16_t* const scores = rows.scores + x * rows.disparities;
    const int end = EndCandidate(rows, x);
    std::uint16_t best = kNone;
    int index = 0;
    for (int i = FirstCandidate(rows, x); i < end; ++i) {
      const int right = x - rows.min_disparity - i;
      if (scores[i] < best) {
        best = scores[i];
        index = i;
      }
      if (scores[i] < rows.right_best[right]) {
        rows.right_best[right] = scores[i];
        rows.right_index[right] = static_cast<std::int16_t>(i);
      }
    }
    rows.left_best[x] = best;
    rows.left_index[x] = static_cast<std::int16_t>(index);
  }
}

std::int16_t DecidePixel(const ScalarRows& rows, const PeakLimits& limits, int x) {
  if (rows.left_best[x] == kNone) return kOutside;
  const int index = rows.left_index[x];
  const int back = rows.right_index[x - rows.min_disparity - index];
  if (AbsoluteDifference(back, index) > limits.line_of_sight) return kLineOfSight;
  if (index == FirstCandidate(rows, x) || index + 1 == EndCandidate(rows, x)) return kRangeEnd;
  const std::uint16_t* const scores = rows.scores + x * rows.disparities + index;
  const int below = scores[-1];
  const int best = scores[0];
  const int above = scores[1];
  const int curvature = below - 2 * best + above;
  if (below <= best || above <= best || curvature < limits.curvature) return kPeak;
  if (256 * curvature < limits.ratio_256 * best) return kContrast;
  return static_cast<std::int16_t>(kDisparityOne * (rows.min_disparity + index) +
                                   SubPixel(limits.interpolation, below, best, above));
}

void Decide(const ScalarRows& rows, const PeakLimits& limits, std::int16_t* disparities) {
  for (int x = 0; x < rows.width; ++x) disparities[x] = DecidePixel(rows, limits, x);
}

}  // namespace

const ScalarStages& ROCKYARD_SCALAR_STAGES() {
  static constexpr ScalarStages kStages{Reduce, Filter, Prepare, Compare, Decide};
  return kStages;
}

}  // namespace rockyard::vision
