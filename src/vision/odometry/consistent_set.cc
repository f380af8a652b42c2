#include "vision/odometry/consistent_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "math/decompositions.h"
#include "math/functions.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

double WeightOf(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

math::Vector3 MeanOf(std::span<const math::Vector3> points, std::span<const double> weights) {
  math::Vector3 sum = math::Vector3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += WeightOf(weights, i) * points[i];
    weight += WeightOf(weights, i);
  }
  return sum / weight;
}

using Members = std::vector<std::size_t>;

constexpr std::size_t kSample = 3;

std::optional<Transform> MotionOf(const PointsSeenTwice& points, const Members& members) {
  std::vector<Vector3> first;
  std::vector<Vector3> second;
  std::vector<double> weights;
  for (const std::size_t i : members) {
    const PointSeenTwice& point = points[i];
    first.push_back(point.first.p_A);
    second.push_back(point.second.p_A);
    weights.push_back(1.0 /
                      (point.first.covariance_m2.trace() + point.second.covariance_m2.trace()));
  }
  return RigidMotion(first, second, weights);
}

// Returns whether both eyes see a point within inlier_px of `expected`. The column in the right eye
// is that in the left one less the disparity.
bool IsWith(const PointSeenTwice& point, const std::optional<PairPixel>& expected,
            double inlier_px) {
  if (!expected) return false;
  const double rows = expected->y() - point.second.left.y();
  const double left = expected->x() - point.second.left.x();
  const double right = left - (expected->z() - point.second.disparity_px);
  const double most = inlier_px * inlier_px;
  return left * left + rows * rows <= most && right * right + rows * rows <= most;
}

class Ransac {
 public:
  Ransac(const PointsSeenTwice& points, const RectifiedPair& cameras, const SelectionParams& params,
         core::RandomStream& stream)
      : points_(points), cameras_(cameras), params_(params), stream_(stream) {}

  std::optional<ConsistentSet> Find() {
    ConsistentSet best;
    std::int64_t needed = params_.max_draws;
    for (; best.draws < needed; ++best.draws) {
      const std::optional<Transform> X_FS = MotionOf(points_, Draw());
      if (!X_FS) continue;
      Members members = PointsWith(points_, cameras_, *X_FS, params_.inlier_px);
      if (members.size() <= best.members.size()) continue;  // of equal sets the earlier draw stays
      best.members = std::move(members);
      best.X_FS = *X_FS;
      while (Grow(best)) {
      }
      needed = DrawsNeeded(best.members.size(), points_.size(), params_.miss_probability,
                           params_.max_draws);
    }
    if (best.members.size() < kSample) return std::nullopt;
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

  // Replaces the set by that of the motion of all members if this is larger, and returns whether it
  // was.
  bool Grow(ConsistentSet& set) const {
    const std::optional<Transform> X_FS = MotionOf(points_, set.members);
    if (!X_FS) return false;
    Members members = PointsWith(points_, cameras_, *X_FS, params_.inlier_px);
    if (members.size() <= set.members.size()) return false;
    set.members = std::move(members);
    set.X_FS = *X_FS;
    return true;
  }

  const PointsSeenTwice& points_;
  const RectifiedPair& cameras_;
  const SelectionParams& params_;
  core::RandomStream& stream_;
};

// The distance between two places, with its variance.
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
  // Must be stable: of equal degrees the smaller index comes first with every library.
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

constexpr int kRounds = 5;
constexpr std::size_t kFewest = 3;

PointsSeenTwice Chosen(const PointsSeenTwice& points, const std::vector<std::size_t>& members) {
  PointsSeenTwice chosen;
  chosen.reserve(members.size());
  for (const std::size_t member : members) chosen.push_back(points[member]);
  return chosen;
}

}  // namespace

std::optional<math::Transform> RigidMotion(std::span<const math::Vector3> points_F,
                                           std::span<const math::Vector3> points_S,
                                           std::span<const double> weights) {
  EXPECT(points_F.size() == points_S.size());
  EXPECT(weights.empty() || weights.size() == points_F.size());
  if (points_F.size() < 3) return std::nullopt;
  const math::Vector3 middle_F = MeanOf(points_F, weights);
  const math::Vector3 middle_S = MeanOf(points_S, weights);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_F.size(); ++i) {
    moments +=
        WeightOf(weights, i) * (points_F[i] - middle_F) * (points_S[i] - middle_S).transpose();
  }
  if (!moments.allFinite()) return std::nullopt;
  const math::SingularValues svd = math::SingularValuesOf(moments);
  constexpr double kFlat = 1e-12;  // 1e-6 squared, as singular values are squares of spreads
  if (!(svd.values[1] > kFlat * svd.values[0])) return std::nullopt;
  math::Vector3 sign = math::Vector3::Ones();
  if (svd.U.determinant() * svd.V.determinant() < 0.0) sign.z() = -1.0;
  math::Transform X_FS = math::Transform::Identity();
  X_FS.linear() = svd.U * sign.asDiagonal() * svd.V.transpose();
  X_FS.translation() = middle_F - X_FS.linear() * middle_S;
  return X_FS;
}

std::optional<ConsistentSet> FindConsistentSet(const PointsSeenTwice& points,
                                               const RectifiedPair& cameras,
                                               const SelectionParams& params,
                                               core::RandomStream& stream) {
  if (points.size() < kSample) return std::nullopt;
  if (params.method == SelectionMethod::kRigidity) return GrowRigid(points, params);
  return Ransac(points, cameras, params, stream).Find();
}

std::vector<std::size_t> PointsWith(const PointsSeenTwice& points, const RectifiedPair& cameras,
                                    const Transform& X_FS, double inlier_px) {
  const PairProjection project(cameras);
  const Transform X_SF = X_FS.inverse();
  Members members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (IsWith(points[i], project(X_SF * points[i].first.p_A), inlier_px)) members.push_back(i);
  }
  return members;
}

std::int64_t DrawsNeeded(std::size_t members, std::size_t points, double miss, std::int64_t most) {
  EXPECT(members <= points && miss > 0.0 && miss < 1.0);
  if (members < kSample) return most;
  const auto k = static_cast<double>(members);
  const auto n = static_cast<double>(points);
  const double share = k * (k - 1.0) * (k - 2.0) / (n * (n - 1.0) * (n - 2.0));
  const double draws = std::ceil(math::Log(miss) / math::Log1p(-share));  // 0 where all are members
  return static_cast<std::int64_t>(std::clamp(draws, 1.0, static_cast<double>(most)));
}

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
