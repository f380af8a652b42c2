#include "vision/odometry/consistent_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "vision/odometry/pair_projection.h"
#include "vision/odometry/rigid_motion.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;
using Members = std::vector<std::size_t>;

constexpr std::size_t kSample = 3;

std::optional<Transform> MotionOf(const PointsSeenTwice& points, const Members& members) {
  std::vector<Vector3> first;
  std::vector<Vector3> second;
  for (const std::size_t i : members) {
    first.push_back(points[i].first.p_A);
    second.push_back(points[i].second.p_A);
  }
  return RigidMotion(first, second);
}

class Ransac {
 public:
  Ransac(const PointsSeenTwice& points, const RectifiedPair& cameras, const SelectionParams& params,
         core::RandomStream& stream)
      : points_(points), project_(cameras), params_(params), stream_(stream) {}

  std::optional<ConsistentSet> Find() {
    ConsistentSet best;
    std::int64_t needed = params_.max_draws;
    for (; best.draws < needed; ++best.draws) {
      const std::optional<Transform> X_FS = MotionOf(points_, Draw());
      if (!X_FS) continue;
      Members members = MembersOf(*X_FS);
      if (members.size() <= best.members.size()) continue;
      best.members = std::move(members);
      best.X_FS = *X_FS;
      needed = std::min(needed, DrawsFor(best.members.size()));
    }
    if (best.members.size() < kSample) return std::nullopt;
    for (int again = 0; again < 2; ++again) Refine(best);
    return best;
  }

 private:
  // Three different points.
  Members Draw() {
    Members sample;
    while (sample.size() < kSample) {
      const auto i =
          static_cast<std::size_t>(stream_.Uniform() * static_cast<double>(points_.size()));
      if (std::find(sample.begin(), sample.end(), i) == sample.end()) sample.push_back(i);
    }
    return sample;
  }

  bool IsWith(const PointSeenTwice& point, const Transform& X_SF) const {
    const std::optional<PairPixel> expected = project_(X_SF * point.first.p_A);
    if (!expected) return false;
    const double rows = expected->y() - point.second.left.y();
    const double left = expected->x() - point.second.left.x();
    const double right = left - (expected->z() - point.second.disparity_px);
    const double most = params_.inlier_px * params_.inlier_px;
    return left * left + rows * rows <= most && right * right + rows * rows <= most;
  }

  Members MembersOf(const Transform& X_FS) const {
    const Transform X_SF = X_FS.inverse();
    Members members;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (IsWith(points_[i], X_SF)) members.push_back(i);
    }
    return members;
  }

  std::int64_t DrawsFor(std::size_t members) const {
    const double share = static_cast<double>(members) / static_cast<double>(points_.size());
    const double miss = std::log1p(-share * share * share);
    if (!(miss < 0.0)) return params_.max_draws;
    if (std::isinf(miss)) return 1;
    const double draws = std::ceil(std::log(params_.miss_probability) / miss);
    return static_cast<std::int64_t>(std::min(draws, static_cast<double>(params_.max_draws)));
  }

  // With the motion of all members, where that does not lose any.
  void Refine(ConsistentSet& set) const {
    const std::optional<Transform> X_FS = MotionOf(points_, set.members);
    if (!X_FS) return;
    Members members = MembersOf(*X_FS);
    if (members.size() < set.members.size()) return;
    set.members = std::move(members);
    set.X_FS = *X_FS;
  }

  const PointsSeenTwice& points_;
  PairProjection project_;
  const SelectionParams& params_;
  core::RandomStream& stream_;
};

// Distance between two places and its variance along the line between them.
struct Length {
  double value_m = 0.0;
  double variance_m2 = 0.0;
};

Length LengthBetween(const StereoMeasurement& a, const StereoMeasurement& b) {
  const Vector3 between = a.p_A - b.p_A;
  const double length = between.norm();
  if (length == 0.0) return {0.0, (a.covariance_m2 + b.covariance_m2).trace()};
  const Vector3 along = between / length;
  return {length, along.dot((a.covariance_m2 + b.covariance_m2) * along)};
}

bool AreRigid(const PointSeenTwice& a, const PointSeenTwice& b, double sigma) {
  const Length first = LengthBetween(a.first, b.first);
  const Length second = LengthBetween(a.second, b.second);
  const double change = first.value_m - second.value_m;
  return change * change <= sigma * sigma * (first.variance_m2 + second.variance_m2);
}

std::optional<ConsistentSet> GrowRigid(const PointsSeenTwice& points,
                                       const SelectionParams& params) {
  const std::size_t n = points.size();
  std::vector<std::vector<bool>> with(n, std::vector<bool>(n, true));
  std::vector<std::size_t> degrees(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      with[i][j] = with[j][i] = AreRigid(points[i], points[j], params.rigidity_sigma);
      if (!with[i][j]) continue;
      ++degrees[i];
      ++degrees[j];
    }
  }
  Members order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return degrees[a] > degrees[b]; });
  ConsistentSet set;
  for (const std::size_t next : order) {
    if (std::all_of(set.members.begin(), set.members.end(),
                    [&](std::size_t member) { return with[next][member]; })) {
      set.members.push_back(next);
    }
  }
  std::sort(set.members.begin(), set.members.end());
  const std::optional<Transform> X_FS = MotionOf(points, set.members);
  if (!X_FS) return std::nullopt;
  set.X_FS = *X_FS;
  return set;
}

}  // namespace

std::optional<ConsistentSet> FindConsistentSet(const PointsSeenTwice& points,
                                               const RectifiedPair& cameras,
                                               const SelectionParams& params,
                                               core::RandomStream& stream) {
  if (points.size() < kSample) return std::nullopt;
  if (params.method == SelectionMethod::kRigidity) return GrowRigid(points, params);
  return Ransac(points, cameras, params, stream).Find();
}

}  // namespace rockyard::vision
