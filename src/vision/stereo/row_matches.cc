#include "vision/stereo/row_matches.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "core/check.h"
#include "vision/stereo/dog.h"

namespace rockyard::vision {
namespace {

// The Laplacian, as a gradient along the row does not see the changes across rows.
constexpr DogParams kFilter = kLaplacianDog;

constexpr int kNeighbourhood_px = 3;  // places this near to the best one are the same peak
constexpr int kReturn_px = 1;

struct GridPoint {
  int x;
  int y;
};

// Columns and rows from first to last, both included.
struct Places {
  GridPoint first;
  GridPoint last;

  bool Empty() const { return first.x > last.x || first.y > last.y; }
  bool IsInside(GridPoint p) const {
    return p.x > first.x && p.x < last.x && p.y > first.y && p.y < last.y;
  }
};

// Returns the pixels whose window lies in the image.
Places WithWindows(const GrayImage& image, int half_px) {
  return {{half_px, half_px}, {image.width() - 1 - half_px, image.height() - 1 - half_px}};
}

Places Common(const Places& a, const Places& b) {
  return {{std::max(a.first.x, b.first.x), std::max(a.first.y, b.first.y)},
          {std::min(a.last.x, b.last.x), std::min(a.last.y, b.last.y)}};
}

// The texture T of windows. Sums of differences over a rectangle come from the sums over the
// rectangles between the image's upper left corner and a pixel.
class TextureSums {
 public:
  explicit TextureSums(const GrayImage& image)
      : across_(image.width() + 1, image.height() + 1), down_(across_) {
    for (int y = 0; y + 1 < image.height(); ++y) {
      std::int64_t across = 0;
      std::int64_t down = 0;
      for (int x = 0; x + 1 < image.width(); ++x) {
        across += std::abs(image.At(x + 1, y) - image.At(x, y));
        down += std::abs(image.At(x, y + 1) - image.At(x, y));
        across_.At(x + 1, y + 1) = across_.At(x + 1, y) + across;
        down_.At(x + 1, y + 1) = down_.At(x + 1, y) + down;
      }
    }
  }

  // Returns T of the window around p.
  std::int64_t Around(GridPoint p, int half_px) const {
    return std::min(Sum(across_, p, half_px), Sum(down_, p, half_px));
  }

 private:
  static std::int64_t Sum(const Image<std::int64_t>& sums, GridPoint p, int half_px) {
    const int left = p.x - half_px, right = p.x + half_px;
    const int top = p.y - half_px, bottom = p.y + half_px;
    return sums.At(right, bottom) - sums.At(left, bottom) - sums.At(right, top) +
           sums.At(left, top);
  }

  Image<std::int64_t> across_;
  Image<std::int64_t> down_;
};

std::vector<GridPoint> TexturedPixels(const GrayImage& image, const RowMatchOptions& options) {
  const int half = options.window_side_px / 2;
  const TextureSums texture(image);
  const Places allowed = WithWindows(image, half);
  std::vector<GridPoint> pixels;
  for (int row = 0; row < options.grid_rows; ++row) {
    for (int column = 0; column < options.grid_columns; ++column) {
      const Places cell = Common(allowed, {{image.width() * column / options.grid_columns,
                                            image.height() * row / options.grid_rows},
                                           {image.width() * (column + 1) / options.grid_columns - 1,
                                            image.height() * (row + 1) / options.grid_rows - 1}});
      std::int64_t most = 0;
      GridPoint best{};
      for (int y = cell.first.y; y <= cell.last.y; ++y) {
        for (int x = cell.first.x; x <= cell.last.x; ++x) {
          const std::int64_t here = texture.Around({x, y}, half);
          if (here <= most) continue;
          most = here;
          best = {x, y};
        }
      }
      if (most > 0) pixels.push_back(best);
    }
  }
  return pixels;
}

struct Peak {
  GridPoint place;
  bool unique;
};

// Searches windows of one image in another one.
class Search {
 public:
  Search(const GrayImage& from, const GrayImage& to, const RowMatchOptions& options)
      : from_(&from),
        to_(&to),
        half_(options.window_side_px / 2),
        places_(WithWindows(to, half_)),
        max_ratio_(options.max_ratio) {}

  // Returns the best of the places whose window lies in the image, or nothing where it is at their
  // end.
  std::optional<Peak> Best(GridPoint what, const Places& range) {
    const Places places = Common(places_, range);
    if (places.Empty()) return std::nullopt;
    scores_.clear();
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    GridPoint best = places.first;
    for (int y = places.first.y; y <= places.last.y; ++y) {
      for (int x = places.first.x; x <= places.last.x; ++x) {
        // A score above `enough` is neither the best nor near enough to the best to be its rival.
        const double enough = least / max_ratio_;
        scores_.push_back(Score(what, {x, y}, enough));
        if (scores_.back() >= least) continue;
        least = scores_.back();
        best = {x, y};
      }
    }
    if (!places.IsInside(best)) return std::nullopt;
    return Peak{best, least < max_ratio_ * LeastBeside(best, places)};
  }

  // Returns S, or the part of it at which it rose above `enough`.
  std::int32_t Score(GridPoint a, GridPoint b, double enough) const {
    std::int32_t sum = 0;
    const int side = 2 * half_ + 1;
    for (int k = -half_; k <= half_ && sum <= enough; ++k) {
      const std::uint8_t* const row = &from_->At(a.x - half_, a.y + k);
      const std::uint8_t* const other = &to_->At(b.x - half_, b.y + k);
      for (int i = 0; i < side; ++i) sum += std::abs(row[i] - other[i]);
    }
    return sum;
  }

 private:
  // Returns the least of the scores that do not belong to the peak at `best`.
  double LeastBeside(GridPoint best, const Places& places) const {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    auto score = scores_.begin();
    for (int y = places.first.y; y <= places.last.y; ++y) {
      for (int x = places.first.x; x <= places.last.x; ++x, ++score) {
        const int away = std::max(std::abs(x - best.x), std::abs(y - best.y));
        if (away > kNeighbourhood_px) least = std::min(least, *score);
      }
    }
    return least;
  }

  const GrayImage* from_;
  const GrayImage* to_;
  int half_;
  Places places_;
  double max_ratio_;
  std::vector<std::int32_t> scores_;  // of the places of the last search, row by row
};

// Returns the row of the lowest point less that of `place`, from S in the rows above, at and below.
double RowFraction(const Search& search, GridPoint what, GridPoint place) {
  const auto score = [&](int rows) {
    return static_cast<double>(
        search.Score(what, {place.x, place.y + rows}, std::numeric_limits<double>::infinity()));
  };
  const double above = score(-1), here = score(0), below = score(1);
  const double rise = std::max(above, below) - here;
  return rise > 0.0 ? 0.5 * (above - below) / rise : 0.0;
}

}  // namespace

std::vector<RowMatch> FindRowMatches(const GrayImage& left, const GrayImage& right,
                                     const RowMatchOptions& options) {
  EXPECT(left.width() == right.width() && left.height() == right.height());
  EXPECT(options.grid_columns >= 1 && options.grid_rows >= 1 && options.max_rows_px >= 1);
  EXPECT(options.window_side_px >= 3 && options.window_side_px % 2 == 1);
  EXPECT(options.max_ratio > 0.0 && options.max_ratio <= 1.0);
  if (left.empty()) return {};
  const GrayImage left_filtered = DifferenceOfGaussians(left, kFilter);
  const GrayImage right_filtered = DifferenceOfGaussians(right, kFilter);
  const int least = options.min_disparity_px.value_or(-left.width() / 8);
  const int most = options.max_disparity_px.value_or(left.width() / 4);
  const int rows = options.max_rows_px;
  Search forth(left_filtered, right_filtered, options);
  Search back(right_filtered, left_filtered, options);
  std::vector<RowMatch> matches;
  for (const GridPoint p : TexturedPixels(left_filtered, options)) {
    const auto found = forth.Best(p, {{p.x - most, p.y - rows}, {p.x - least, p.y + rows}});
    if (!found || !found->unique) continue;
    const GridPoint q = found->place;
    const auto again = back.Best(q, {{q.x + least, q.y - rows}, {q.x + most, q.y + rows}});
    if (!again || std::abs(again->place.x - p.x) > kReturn_px ||
        std::abs(again->place.y - p.y) > kReturn_px) {
      continue;
    }
    matches.push_back({p.x, q.x, p.y, q.y + RowFraction(forth, p, q)});
  }
  return matches;
}

}  // namespace rockyard::vision
