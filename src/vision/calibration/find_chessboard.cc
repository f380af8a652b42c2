#include "vision/calibration/find_chessboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <queue>
#include <utility>

#include "vision/calibration/corner_candidates.h"

namespace rockyard::vision {
namespace {

constexpr double kSmoothing_px = 1.5;
constexpr double kFirstRadius_px = 4.0;
// The radius of a window about a corner over the way to its nearest neighbour: below a half, so
// that the edges inside belong to this corner alone.
constexpr double kShareOfSquare = 0.45;
constexpr double kLeastRadius_px = 3.0;
constexpr double kMostRadius_px = 12.0;

// Corners that belong together, by their places in a grid of unknown origin and orientation. The
// grid is never mirrored: the second coordinate's direction is to the right hand of the first's, as
// down is to the right hand of rightwards.
using CornerGrid = std::map<std::pair<int, int>, Pixel>;

constexpr std::size_t kMostNear = 16;
constexpr double kLeastDifference = 6.0;  // grey levels across an edge

double Cross(const Pixel& a, const Pixel& b) { return a.x() * b.y() - a.y() * b.x(); }

// Returns whether the line from a to b is an edge all along: brightness differs across it at five
// places, with the same sign. Longer lines of a board change the sign halfway, and diagonals have
// no difference.
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

// Grows one grid from a corner with two edges, along edges. The directions of an edge's grid lines
// are handed on from corner to corner, so that perspective and distortion may turn them slowly.
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
  // Starts at two edges of `seed` more than 30 deg apart, the second to the right hand of the
  // first.
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

  // Adds the corner `to` where the step to it is u first + v second with (u, v) about (1, 0),
  // (-1, 0), (0, 1) or (0, -1).
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

// Returns the grids among `corners`, largest first. `smooth` is the image smoothed by about 1.5 px.
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

// Returns the corners row by row where the grid has the board's shape, as it lies or turned by a
// quarter.
std::optional<std::vector<Pixel>> Sorted(const CornerGrid& grid, const ChessboardParams& board) {
  if (grid.size() != board.corners()) return std::nullopt;
  std::pair<int, int> low = grid.begin()->first;
  std::pair<int, int> high = low;
  for (const auto& [at, corner] : grid) {
    low = {std::min(low.first, at.first), std::min(low.second, at.second)};
    high = {std::max(high.first, at.first), std::max(high.second, at.second)};
  }
  const int first = high.first - low.first + 1;
  const int second = high.second - low.second + 1;
  const bool lies = first == board.columns && second == board.rows;
  const bool turned = first == board.rows && second == board.columns;
  if (!lies && !turned) return std::nullopt;
  std::vector<Pixel> corners(board.corners());
  for (const auto& [at, corner] : grid) {
    const int column = lies ? at.first - low.first : at.second - low.second;
    const int row = lies ? at.second - low.second : high.first - at.first;
    corners[static_cast<std::size_t>(row * board.columns + column)] = corner;
  }
  return corners;
}

double SquareBrightness(const Image<float>& smooth, const std::vector<Pixel>& corners,
                        std::size_t columns, std::size_t first) {
  return ValueAt(smooth, 0.25 * (corners[first] + corners[first + 1] + corners[first + columns] +
                                 corners[first + columns + 1]));
}

// Turns the order of the corners by half a turn where the square at the origin is not darker than
// its neighbour.
void TurnToDarkOrigin(const Image<float>& smooth, const ChessboardParams& board,
                      std::vector<Pixel>& corners) {
  const auto columns = static_cast<std::size_t>(board.columns);
  if (SquareBrightness(smooth, corners, columns, 0) >
      SquareBrightness(smooth, corners, columns, 1)) {
    std::reverse(corners.begin(), corners.end());
  }
}

double WindowRadius(const std::vector<Pixel>& corners, std::size_t columns, std::size_t index) {
  double nearest_px = kMostRadius_px / kShareOfSquare;
  const auto look = [&](std::size_t other) {
    nearest_px = std::min(nearest_px, (corners[other] - corners[index]).norm());
  };
  if (index % columns > 0) look(index - 1);
  if (index % columns + 1 < columns) look(index + 1);
  if (index >= columns) look(index - columns);
  if (index + columns < corners.size()) look(index + columns);
  return std::max(kLeastRadius_px, kShareOfSquare * nearest_px);
}

std::optional<std::vector<Pixel>> Refined(const GrayImage& image, const ChessboardParams& board,
                                          const std::vector<Pixel>& corners) {
  std::vector<Pixel> refined;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double radius_px = WindowRadius(corners, static_cast<std::size_t>(board.columns), i);
    const std::optional<Pixel> corner = RefineCorner(image, corners[i], radius_px);
    if (!corner) return std::nullopt;
    refined.push_back(*corner);
  }
  return refined;
}

}  // namespace

core::Result<std::vector<Pixel>> FindChessboard(const GrayImage& image,
                                                const ChessboardParams& board) {
  const Image<float> smooth = Smoothed(image, kSmoothing_px);
  std::vector<Pixel> candidates;
  for (const Pixel& candidate : CornerCandidates(smooth)) {
    const std::optional<Pixel> corner = RefineCorner(image, candidate, kFirstRadius_px);
    if (corner) candidates.push_back(*corner);
  }
  const std::vector<CornerGrid> grids = FindGrids(smooth, candidates);
  for (const CornerGrid& grid : grids) {
    std::optional<std::vector<Pixel>> corners = Sorted(grid, board);
    if (!corners) continue;
    TurnToDarkOrigin(smooth, board, *corners);
    corners = Refined(image, board, *corners);
    if (corners) return *std::move(corners);
  }
  const std::size_t most = grids.empty() ? 0 : grids.front().size();
  return std::vector<core::Problem>{
      {"image",
       fmt::format("shows no chessboard of {} x {} inner corners: the largest grid found has {}",
                   board.rows, board.columns, most),
       "show the whole board, sharp, with squares of 12 px or more, and check rows and columns"}};
}

}  // namespace rockyard::vision
