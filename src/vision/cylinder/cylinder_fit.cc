#include "vision/cylinder/cylinder_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "math/angles.h"
#include "vision/cylinder/fit_descent.h"
#include "vision/cylinder/fit_problem.h"

namespace rockyard::vision {
namespace {

constexpr int kOrientations = 48;
// Local minima over the orientations that are refined.
constexpr std::size_t kMostStarts = 5;
// A cost so many times the least is not refined.
constexpr double kFarAbove = 4.0;
constexpr double kOtherOrientation_rad = math::DegToRad(25.0);
constexpr int kMostSteps = 30;
// The walk about a minimum: places on either side of it, from one to the next, and the steps of the
// descent at each.
constexpr std::size_t kWalk = 6;
constexpr double kWalkStep_rad = math::DegToRad(4.0);
constexpr int kWalkDescent = 4;
// Squared residuals above the best ones up to which a minimum of the walk is refined.
constexpr double kWalkAbove = 30.0;

FitUnknowns AtOrientation(double orientation_rad) {
  FitUnknowns unknowns = FitUnknowns::Zero();
  unknowns[2] = orientation_rad;
  return unknowns;
}

struct Hypothesis {
  FitState state;
  double colour_misfit = 0.0;
  double cost = std::numeric_limits<double>::infinity();
};

void SortByCost(std::vector<Hypothesis>& hypotheses) {
  std::sort(hypotheses.begin(), hypotheses.end(),
            [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
}

// Adds the minimum that a descent from the start reaches.
void Refine(const FitProblem& problem, const FitUnknowns& start, const LogRatios& light,
            std::vector<Hypothesis>& hypotheses) {
  Hypothesis hypothesis;
  hypothesis.state = DescendFrom(problem, start, FitFreedom::kOrientation, kMostSteps);
  if (!std::isfinite(hypothesis.state.squares)) return;
  hypothesis.colour_misfit = problem.ColourMisfitOf(hypothesis.state.evaluation, light);
  hypothesis.cost = hypothesis.state.squares + hypothesis.colour_misfit;
  hypotheses.push_back(hypothesis);
}

// The starts: orientations whose cost is no larger than that of both neighbours and not far above
// the least, best first.
std::vector<double> StartsOf(const FitProblem& problem, const LogRatios& light) {
  std::array<double, kOrientations> costs{};
  const auto orientation = [](std::size_t i) {
    return 2.0 * std::numbers::pi * static_cast<double>(i) / kOrientations;
  };
  for (std::size_t i = 0; i < kOrientations; ++i) {
    const auto evaluation =
        problem.Evaluate(AtOrientation(orientation(i)), RadiusDeviation(FitFreedom::kOrientation));
    costs.at(i) = evaluation ? evaluation->residuals.squaredNorm() +
                                   problem.ColourMisfitOf(*evaluation, light)
                             : std::numeric_limits<double>::infinity();
  }
  const double most = kFarAbove * *std::min_element(costs.begin(), costs.end());
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < kOrientations; ++i) {
    const double before = costs.at((i + kOrientations - 1) % kOrientations);
    const double after = costs.at((i + 1) % kOrientations);
    if (costs.at(i) <= most && costs.at(i) <= before && costs.at(i) <= after &&
        std::isfinite(costs.at(i))) {
      minima.push_back(i);
    }
  }
  std::sort(minima.begin(), minima.end(),
            [&](std::size_t a, std::size_t b) { return costs.at(a) < costs.at(b); });
  if (minima.size() > kMostStarts) minima.resize(kMostStarts);
  std::vector<double> starts;
  starts.reserve(minima.size());
  for (const std::size_t i : minima) starts.push_back(orientation(i));
  return starts;
}

// Best first.
std::vector<Hypothesis> HypothesesOf(const FitProblem& problem, const LogRatios& light) {
  std::vector<Hypothesis> hypotheses;
  for (const double start_rad : StartsOf(problem, light)) {
    Refine(problem, AtOrientation(start_rad), light, hypotheses);
  }
  SortByCost(hypotheses);
  return hypotheses;
}

// The better of two descents at a fixed theta: from the neighbour's place, and from the middle of
// the candidate's boxes.
FitState WalkedTo(const FitProblem& problem, const FitUnknowns& neighbour, double orientation_rad) {
  FitUnknowns start = neighbour;
  start[2] = orientation_rad;
  FitState near = DescendFrom(problem, start, FitFreedom::kPlace, kWalkDescent);
  FitState fresh =
      DescendFrom(problem, AtOrientation(orientation_rad), FitFreedom::kPlace, kWalkDescent);
  return near.squares <= fresh.squares ? near : fresh;
}

// Where few pixels show the wall, a descent ends a pixel beside the best place: theta is led away
// from the best minimum in both directions, and what is a minimum on the way is refined.
void WalkAboutBest(const FitProblem& problem, const LogRatios& light,
                   std::vector<Hypothesis>& hypotheses) {
  const FitState best = hypotheses.front().state;
  std::array<FitState, 2 * kWalk + 1> walk;
  walk[kWalk] = best;
  for (const bool leftwards : {true, false}) {
    const double step_rad = leftwards ? -kWalkStep_rad : kWalkStep_rad;
    for (std::size_t i = 1; i <= kWalk; ++i) {
      const FitState& before = walk.at(leftwards ? kWalk + 1 - i : kWalk - 1 + i);
      walk.at(leftwards ? kWalk - i : kWalk + i) =
          WalkedTo(problem, before.unknowns, best.unknowns[2] + static_cast<double>(i) * step_rad);
    }
  }
  for (std::size_t i = 0; i < walk.size(); ++i) {
    const double squares = walk.at(i).squares;
    if (i == kWalk || !(squares <= best.squares + kWalkAbove)) continue;
    if (i > 0 && walk.at(i - 1).squares < squares) continue;
    if (i + 1 < walk.size() && walk.at(i + 1).squares < squares) continue;
    Refine(problem, walk.at(i).unknowns, light, hypotheses);
  }
  SortByCost(hypotheses);
}

// The candidate moved to a place, with boxes that begin and end where the wall there does.
RegionPair BoxedBy(const ColourPair& pair, const EyeGeometry& eyes, const CylinderPlace& place,
                   double height_m, RegionPair regions) {
  const auto fit_box = [&](const CameraModel& camera, ColourRegion& box) {
    const auto view = WallSeen(camera, eyes, place, 0.5 * height_m);
    if (!view) return;
    const int last = camera.size.columns - 2;
    box.left = std::clamp(static_cast<int>(std::lround(view->lines.front().column + 0.5)), 1, last);
    box.right =
        std::clamp(static_cast<int>(std::lround(view->lines.back().column - 0.5)), box.left, last);
  };
  fit_box(pair.left_camera, regions.left);
  fit_box(pair.right_camera, regions.right);
  regions.point = {place.p_LT_L, (place.p_LT_L - eyes.centre_L).dot(eyes.forward_L)};
  return regions;
}

// What orientations near the best one that are nearly as likely add to its variance, rad^2: their
// squared distances, weighted by likelihoods. `factor` is that of all variances.
double SpreadOf(const std::vector<Hypothesis>& hypotheses, double factor) {
  const Hypothesis& best = hypotheses.front();
  double weights = 0.0;
  double spread = 0.0;
  for (const Hypothesis& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.state.unknowns[2] - best.state.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) continue;
    const double weight = std::exp(0.5 * (best.cost - other.cost) / factor);
    weights += weight;
    spread += weight * turn_rad * turn_rad;
  }
  return spread / weights;
}

double MarginOf(const std::vector<Hypothesis>& hypotheses) {
  const Hypothesis& best = hypotheses.front();
  for (const Hypothesis& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.state.unknowns[2] - best.state.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) return other.cost - best.cost;
  }
  return std::numeric_limits<double>::infinity();
}

CylinderFit FitOf(const FitProblem& problem, const std::vector<Hypothesis>& hypotheses,
                  const EyeGeometry& eyes) {
  const Hypothesis& best = hypotheses.front();
  CylinderFit fit;
  fit.place = problem.PlaceOf(best.state.unknowns);
  fit.place.orientation_rad = math::WrapAngle(fit.place.orientation_rad);
  fit.cost = best.cost;
  fit.misfit = best.state.squares / problem.samples();
  fit.colour_misfit = best.colour_misfit;
  fit.margin = MarginOf(hypotheses);
  fit.height_m = problem.height_m();
  const double factor = std::max(fit.misfit, 1.0);
  fit.covariance = factor * best.state.information.inverse().topLeftCorner<4, 4>();
  fit.covariance(2, 2) += SpreadOf(hypotheses, factor);
  const FitState free = DescendFrom(problem, best.state.unknowns, FitFreedom::kRadius, kMostSteps);
  const CylinderPlace free_place = problem.PlaceOf(free.unknowns);
  fit.free_depth_m = (free_place.p_LT_L - eyes.centre_L).dot(eyes.forward_L);
  fit.radius_ratio = 1.0 + free.unknowns[4];
  fit.radius_ratio_sd = std::sqrt(factor * free.information.inverse()(4, 4));
  return fit;
}

}  // namespace

std::optional<CylinderFit> FitCylinder(const ColourPair& pair, const EyeGeometry& eyes,
                                       const ColourCylinder& cylinder, const RegionPair& candidate,
                                       const LogRatios& light, const RobustFinderParams& params) {
  const FitProblem first(pair, eyes, cylinder, candidate, params);
  const std::vector<Hypothesis> guesses = HypothesesOf(first, light);
  if (guesses.empty()) return std::nullopt;
  const RegionPair boxed = BoxedBy(pair, eyes, first.PlaceOf(guesses.front().state.unknowns),
                                   cylinder.height_m, candidate);
  const FitProblem problem(pair, eyes, cylinder, boxed, params);
  std::vector<Hypothesis> hypotheses = HypothesesOf(problem, light);
  if (hypotheses.empty()) return std::nullopt;
  WalkAboutBest(problem, light, hypotheses);
  return FitOf(problem, hypotheses, eyes);
}

}  // namespace rockyard::vision
