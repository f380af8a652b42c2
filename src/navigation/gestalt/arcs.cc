#include "navigation/gestalt/arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::MotionKind;

// Below this curvature an arc of any length that is judged is straight to a tenth of a micrometre.
constexpr double kStraight_per_m = 1e-9;

// Returns the place on an arc at signed distance s (negative: driven backwards) from R's origin,
// which the arc leaves along x: (sin(c s) / c, (1 - cos(c s)) / c). The latter is taken as 2
// sin^2(c s / 2) / c, which keeps its digits where c s is small.
PathPoint OnArc(double curvature_per_m, double s_m) {
  if (std::abs(curvature_per_m) < kStraight_per_m) return {s_m, 0.0};
  const double angle_rad = curvature_per_m * s_m;
  const double half_sine = math::Sin(0.5 * angle_rad);
  return {math::Sin(angle_rad) / curvature_per_m, 2.0 * half_sine * half_sine / curvature_per_m};
}

double Weight(const GestaltPlanParams& params, double distance_m) {
  switch (params.path_weight) {
    case PathWeight::kLinear: {
      // w(s) = 1 - (1 - w_far) (s - s_min) / (s_max - s_min).
      const double share =
          (distance_m - params.plan_min_dist_m) / (params.plan_max_dist_m - params.plan_min_dist_m);
      return 1.0 - (1.0 - params.far_weight) * std::min(1.0, share);
    }
    case PathWeight::kInverse:
      return 1.0 / distance_m;
    case PathWeight::kUniform:
      return 1.0;
  }
  return 1.0;
}

CandidateMotion MakeArc(double curvature_per_m, int direction, const GestaltPlanParams& plan,
                        const PathSampling& sampling) {
  CandidateMotion candidate;
  candidate.motion = {MotionKind::kArc, curvature_per_m, direction};
  for (const double s_m : sampling.distance_m) {
    // |c| s is the angle turned so far.
    const bool turned_enough = std::abs(curvature_per_m) * s_m > plan.max_path_turn_rad;
    if (turned_enough && !candidate.points.empty()) break;
    candidate.points.push_back(OnArc(curvature_per_m, direction * s_m));
  }
  return candidate;
}

CandidateMotion MakePointTurn(double turn_rad, const PathSampling& sampling) {
  CandidateMotion candidate;
  candidate.motion = {MotionKind::kTurnInPlace, 0.0, turn_rad < 0.0 ? -1 : +1};
  candidate.turn_rad = turn_rad;
  for (const double s_m : sampling.distance_m) {
    // The straight drive after the turn, in R as it is before.
    candidate.points.push_back(
        {s_m * math::Cos(candidate.turn_rad), s_m * math::Sin(candidate.turn_rad)});
  }
  return candidate;
}

// Returns the angles of the turns in place to one side, ascending.
std::vector<double> PointTurnAngles(const GestaltArcParams& arcs) {
  if (arcs.num_point_turns == 0) return {arcs.point_turn_amount_rad};
  std::vector<double> angles;
  for (std::int64_t i = 1; i <= arcs.num_point_turns; ++i) {
    angles.push_back(std::numbers::pi * static_cast<double>(i) /
                     static_cast<double>(arcs.num_point_turns));
  }
  return angles;
}

}  // namespace

std::size_t PathSampling::CountWithin(double length_m) const {
  // Distances ascend, the same for all candidates.
  const auto end = std::upper_bound(distance_m.begin(), distance_m.end(), length_m);
  return std::max<std::size_t>(1, static_cast<std::size_t>(end - distance_m.begin()));
}

PathSampling SamplePaths(const GestaltPlanParams& params, double cell_m) {
  EXPECT(cell_m > 0.0 && params.samples_per_cell > 0);
  EXPECT(params.plan_max_dist_m > params.plan_min_dist_m);
  const double piece_m = cell_m / static_cast<double>(params.samples_per_cell);
  PathSampling sampling;
  for (std::size_t k = 0;; ++k) {
    // s_k = s_min + (k + 1/2) h.
    const double s_m = params.plan_min_dist_m + (static_cast<double>(k) + 0.5) * piece_m;
    if (k > 0 && s_m > params.plan_max_dist_m) break;
    sampling.distance_m.push_back(s_m);
    sampling.weight.push_back(Weight(params, s_m));
  }
  return sampling;
}

double ArcCurvature(std::size_t index, std::size_t count, double max_curvature_per_m) {
  if (count < 2) return 0.0;
  // Counted from the middle, so that mirrored arcs have exactly opposite curvatures.
  const double twice_from_middle =
      2.0 * static_cast<double>(index) - static_cast<double>(count - 1);
  return max_curvature_per_m * (twice_from_middle / static_cast<double>(count - 1));
}

std::size_t NearestArc(double curvature_per_m, std::size_t count, double max_curvature_per_m) {
  EXPECT(count > 0);
  if (count < 2) return 0;
  const double limited = std::clamp(curvature_per_m, -max_curvature_per_m, max_curvature_per_m);
  // c_i = (i - (n - 1)/2) spacing, so i = n/2 (rounded down) + c / spacing - middle. std::lround
  // rounds halves away from zero: to the tighter arc.
  const double spacing = 2.0 * max_curvature_per_m / static_cast<double>(count - 1);
  const double middle = count % 2 == 0 ? 0.5 : 0.0;  // of the arc count / 2, in spacings from c = 0
  const auto from_middle = std::lround(limited / spacing - middle);
  const auto index = static_cast<std::int64_t>(count / 2) + from_middle;
  return static_cast<std::size_t>(
      std::clamp<std::int64_t>(index, 0, static_cast<std::int64_t>(count) - 1));
}

CandidateMotions MakeCandidates(const GestaltArcParams& arcs, const GestaltPlanParams& plan,
                                const PathSampling& sampling) {
  CandidateMotions motions;
  const auto row = [&](std::int64_t number, int direction) {
    std::vector<CandidateMotion> row_of_arcs;
    const auto count = static_cast<std::size_t>(number);
    for (std::size_t i = 0; i < count; ++i) {
      const double curvature_per_m = ArcCurvature(i, count, arcs.max_curvature_per_m);
      row_of_arcs.push_back(MakeArc(curvature_per_m, direction, plan, sampling));
    }
    return row_of_arcs;
  };
  motions.forward = row(arcs.num_forward_arcs, +1);
  // Backward arcs are driven with the same curvatures, from right to left.
  motions.backward = row(arcs.num_backward_arcs, -1);
  const std::vector<double> angles = PointTurnAngles(arcs);
  for (std::size_t i = angles.size(); i-- > 0;) {
    motions.point_turns.push_back(MakePointTurn(-angles[i], sampling));
  }
  for (const double angle_rad : angles) {
    motions.point_turns.push_back(MakePointTurn(angle_rad, sampling));
  }
  return motions;
}

}  // namespace rockyard::navigation
