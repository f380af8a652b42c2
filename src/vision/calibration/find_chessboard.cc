#include "vision/calibration/find_chessboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "vision/calibration/corner_candidates.h"
#include "vision/calibration/corner_grid.h"
#include "vision/calibration/smooth_image.h"

namespace rockyard::vision {
namespace {

constexpr double kSmoothing_px = 1.5;
constexpr double kFirstRadius_px = 4.0;
// A window about a corner, as a share of the way to its nearest neighbour: edges that belong to it
// alone.
constexpr double kShareOfSquare = 0.45;
constexpr double kLeastRadius_px = 3.0;
constexpr double kMostRadius_px = 12.0;

// The corners row by row, where the grid has the board's shape: as it lies or a quarter turned.
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

// The square at the origin is dark, its neighbour bright.
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
