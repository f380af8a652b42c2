#include "vision/odometry/motion_of_set.h"

#include <utility>

namespace rockyard::vision {
namespace {

constexpr int kRounds = 5;
constexpr std::size_t kFewest = 3;

PointsSeenTwice Chosen(const PointsSeenTwice& points, const std::vector<std::size_t>& members) {
  PointsSeenTwice chosen;
  chosen.reserve(members.size());
  for (const std::size_t member : members) chosen.push_back(points[member]);
  return chosen;
}

}  // namespace

SetMotion MotionOfSet(const PointsSeenTwice& points, const RectifiedPair& cameras,
                      const ConsistentSet& set, const SelectionParams& selection,
                      const EstimationParams& estimation) {
  SetMotion found{EstimateMotion(Chosen(points, set.members), cameras, estimation, set.X_FS),
                  set.members};
  for (int round = 0; round < kRounds && found.estimated.converged; ++round) {
    std::vector<std::size_t> members =
        PointsWith(points, cameras, found.estimated.X_FS, selection.inlier_px);
    if (members == found.members || members.size() < kFewest) break;
    const std::int64_t iterations = found.estimated.iterations;
    found.estimated =
        EstimateMotion(Chosen(points, members), cameras, estimation, found.estimated.X_FS);
    found.estimated.iterations += iterations;
    found.members = std::move(members);
  }
  return found;
}

}  // namespace rockyard::vision
