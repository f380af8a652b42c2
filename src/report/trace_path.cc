#include "report/trace_path.h"

#include <cmath>

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
