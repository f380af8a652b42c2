#include "report/trace_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rockyard::report {
namespace {

using truth::TraceSample;

constexpr double kFinestSpacing_m = 0.005;
constexpr double kCoarsestSpacing_m = 10.0;

// The path of pose_of(sample), broken at reflections.
template <typename PoseOf>
TracePath PathOf(const truth::Trace& trace, PoseOf pose_of) {
  TracePath path(1);
  auto event = trace.events.begin();
  for (const TraceSample& sample : trace.samples) {
    for (; event != trace.events.end() && event->time_s < sample.time_s; ++event) {
      if (event->kind == "reflection" && !path.back().empty()) path.emplace_back();
    }
    path.back().push_back(pose_of(sample));
  }
  return path;
}

// Keeps both ends, and between them points that are at least `spacing_m` apart.
PathPiece ThinnedPiece(const PathPiece& piece, double spacing_m) {
  PathPiece kept;
  for (const math::Pose2& pose : piece) {
    if (kept.empty() || Apart_m(kept.back(), pose) >= spacing_m) kept.push_back(pose);
  }
  if (!piece.empty() && Apart_m(kept.back(), piece.back()) > 0.0) kept.push_back(piece.back());
  return kept;
}

// From the point to the piece of a line between two others.
double OffLine_m(const math::Pose2& point, const math::Pose2& from, const math::Pose2& to) {
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  const double square_m2 = dx_m * dx_m + dy_m * dy_m;
  if (square_m2 == 0.0) return Apart_m(point, from);
  const double along = (dx_m * (point.x_m - from.x_m) + dy_m * (point.y_m - from.y_m)) / square_m2;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(point.x_m - from.x_m - share * dx_m, point.y_m - from.y_m - share * dy_m);
}

// Of each stretch between two kept points the one that is furthest off is kept too, until none is
// further off than the tolerance.
PathPiece SimplifiedPiece(const PathPiece& piece, double tolerance_m) {
  if (piece.size() < 3) return piece;
  std::vector<bool> kept(piece.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, piece.size() - 1}};
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    std::size_t furthest = from;
    double most_m = tolerance_m;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off_m = OffLine_m(piece[i], piece[from], piece[to]);
      if (off_m > most_m) {
        most_m = off_m;
        furthest = i;
      }
    }
    if (furthest == from) continue;
    kept[furthest] = true;
    stretches.emplace_back(from, furthest);
    stretches.emplace_back(furthest, to);
  }
  PathPiece simplified;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (kept[i]) simplified.push_back(piece[i]);
  }
  return simplified;
}

}  // namespace

math::Pose2 BelievedPose(const TraceSample& sample) {
  return {sample.estimate.x_m, sample.estimate.y_m, sample.estimate.heading_rad};
}

TracePath TruePath(const truth::Trace& trace) {
  return PathOf(trace, [](const TraceSample& sample) { return sample.pose; });
}

TracePath BelievedPath(const truth::Trace& trace) { return PathOf(trace, BelievedPose); }

double Apart_m(const math::Pose2& a, const math::Pose2& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

TracePath Simplified(const TracePath& path, double tolerance_m) {
  TracePath simplified;
  simplified.reserve(path.size());
  for (const PathPiece& piece : path) simplified.push_back(SimplifiedPiece(piece, tolerance_m));
  return simplified;
}

TracePath Thinned(const TracePath& path, std::size_t most_points) {
  for (double spacing_m = kFinestSpacing_m;; spacing_m *= 1.5) {
    TracePath thinned;
    std::size_t points = 0;
    for (const PathPiece& piece : path) {
      thinned.push_back(ThinnedPiece(piece, spacing_m));
      points += thinned.back().size();
    }
    if (points <= most_points || spacing_m > kCoarsestSpacing_m) return thinned;
  }
}

}  // namespace rockyard::report
