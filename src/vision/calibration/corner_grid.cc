#include "vision/calibration/corner_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <queue>

#include "vision/calibration/smooth_image.h"

namespace rockyard::vision {
namespace {

constexpr std::size_t kMostNear = 16;
constexpr double kLeastDifference = 6.0;  // grey levels across an edge

double Cross(const Pixel& a, const Pixel& b) { return a.x() * b.y() - a.y() * b.x(); }

bool IsEdge(const Image<float>& smooth, const Pixel& a, const Pixel& b) {
  const Pixel along = b - a;
  const double length_px = along.norm();
  const double aside_px = std::clamp(0.2 * length_px, 1.5, 4.0);
  const Pixel aside = aside_px / length_px * Pixel(-along.y(), along.x());
  int bright = 0;
  constexpr int kPlaces = 5;
  for (int i = 0; i < kPlaces; ++i) {
    const Pixel at = a + (0.25 + 0.125 * i) * along;
    const double difference = ValueAt(smooth, at + aside) - ValueAt(smooth, at - aside);
    if (std::fabs(difference) < kLeastDifference) return false;
    if (difference > 0.0) ++bright;
  }
  return bright == 0 || bright == kPlaces;
}

using Neighbours = std::vector<std::vector<std::size_t>>;

Neighbours EdgesAmong(const Image<float>& smooth, const std::vector<Pixel>& corners) {
  Neighbours neighbours(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::vector<std::size_t> others;
    for (std::size_t j = 0; j < corners.size(); ++j) {
      if (j != i) others.push_back(j);
    }
    const auto nearer = [&](std::size_t a, std::size_t b) {
      return (corners[a] - corners[i]).squaredNorm() < (corners[b] - corners[i]).squaredNorm();
    };
    const auto near = static_cast<std::ptrdiff_t>(std::min(kMostNear, others.size()));
    std::partial_sort(others.begin(), others.begin() + near, others.end(), nearer);
    others.resize(static_cast<std::size_t>(near));
    for (const std::size_t j : others) {
      if (IsEdge(smooth, corners[i], corners[j])) neighbours[i].push_back(j);
    }
  }
  return neighbours;
}

struct Place {
  std::size_t corner = 0;
  std::pair<int, int> at;
  Pixel first;   // towards the next corner along the first coordinate
  Pixel second;  // along the second
};

// Grows one grid.
class GridGrowth {
 public:
  GridGrowth(const std::vector<Pixel>& corners, const Neighbours& neighbours,
             std::vector<bool>& taken)
      : corners_(corners), neighbours_(neighbours), taken_(taken) {}

  CornerGrid From(std::size_t seed) {
    if (const std::optional<Place> start = StartAt(seed)) Add(*start);
    while (!waiting_.empty()) {
      const Place place = waiting_.front();
      waiting_.pop();
      for (const std::size_t next : neighbours_[place.corner]) {
        if (!taken_[next]) Step(place, next);
      }
    }
    return std::move(grid_);
  }

 private:
  // Two edges at more than 30 deg to each other, the second to the right hand of the first.
  std::optional<Place> StartAt(std::size_t seed) const {
    for (const std::size_t a : neighbours_[seed]) {
      for (const std::size_t b : neighbours_[seed]) {
        const Pixel first = corners_[a] - corners_[seed];
        const Pixel second = corners_[b] - corners_[seed];
        if (Cross(first, second) > 0.5 * first.norm() * second.norm()) {
          return Place{seed, {0, 0}, first, second};
        }
      }
    }
    return std::nullopt;
  }

  void Add(const Place& place) {
    if (!grid_.emplace(place.at, corners_[place.corner]).second) return;
    taken_[place.corner] = true;
    waiting_.push(place);
  }

  // The step is first times u plus second times v: about (1, 0), (-1, 0), (0, 1) or (0, -1).
  void Step(const Place& from, std::size_t to) {
    const Pixel step = corners_[to] - corners_[from.corner];
    const double area = Cross(from.first, from.second);
    const double u = Cross(step, from.second) / area;
    const double v = Cross(from.first, step) / area;
    constexpr double kAside = 0.35;
    constexpr double kShortest = 0.5;
    constexpr double kLongest = 2.0;
    const double along = std::max(std::fabs(u), std::fabs(v));
    if (std::min(std::fabs(u), std::fabs(v)) > kAside * along) return;
    if (along < kShortest || along > kLongest) return;
    Place place{to, from.at, from.first, from.second};
    if (std::fabs(u) > std::fabs(v)) {
      const int sign = u > 0.0 ? 1 : -1;
      place.at.first += sign;
      place.first = sign * step;
    } else {
      const int sign = v > 0.0 ? 1 : -1;
      place.at.second += sign;
      place.second = sign * step;
    }
    Add(place);
  }

  const std::vector<Pixel>& corners_;
  const Neighbours& neighbours_;
  std::vector<bool>& taken_;
  CornerGrid grid_;
  std::queue<Place> waiting_;
};

}  // namespace

std::vector<CornerGrid> FindGrids(const Image<float>& smooth, const std::vector<Pixel>& corners) {
  const Neighbours neighbours = EdgesAmong(smooth, corners);
  std::vector<bool> taken(corners.size(), false);
  std::vector<CornerGrid> grids;
  for (std::size_t seed = 0; seed < corners.size(); ++seed) {
    if (taken[seed]) continue;
    CornerGrid grid = GridGrowth(corners, neighbours, taken).From(seed);
    if (!grid.empty()) grids.push_back(std::move(grid));
  }
  std::stable_sort(grids.begin(), grids.end(),
                   [](const CornerGrid& a, const CornerGrid& b) { return a.size() > b.size(); });
  return grids;
}

}  // namespace rockyard::vision
