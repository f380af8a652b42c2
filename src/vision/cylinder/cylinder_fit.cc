#include "vision/cylinder/cylinder_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "math/angles.h"
#include "math/decompositions.h"
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
constexpr double kMarginSigmas = 3.0;

FitUnknowns AtOrientation(double orientation_rad) {
  FitUnknowns unknowns = FitUnknowns::Zero();
  unknowns[2] = orientation_rad;
  return unknowns;
}

void SortBySquares(std::vector<FitState>& hypotheses) {
  std::sort(hypotheses.begin(), hypotheses.end(),
            [](const FitState& a, const FitState& b) { return a.squares < b.squares; });
}

// Adds the minimum that a descent from the start reaches.
void Refine(const FitProblem& problem, const FitUnknowns& start,
            std::vector<FitState>& hypotheses) {
  const FitState minimum = DescendFrom(problem, start, FitRadius::kFixed, kMostSteps);
  if (std::isfinite(minimum.squares)) hypotheses.push_back(minimum);
}

// The starts: orientations whose cost is no larger than that of both neighbours and not far above
// the least, best first.
std::vector<double> StartsOf(const FitProblem& problem) {
  std::array<double, kOrientations> costs{};
  const auto orientation = [](std::size_t i) {
    return 2.0 * std::numbers::pi * static_cast<double>(i) / kOrientations;
  };
  for (std::size_t i = 0; i < kOrientations; ++i) {
    const auto evaluation =
        problem.Evaluate(AtOrientation(orientation(i)), RadiusDeviation(FitRadius::kFixed));
    costs.at(i) =
        evaluation ? evaluation->residuals.squaredNorm() : std::numeric_limits<double>::infinity();
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
std::vector<FitState> HypothesesOf(const FitProblem& problem) {
  std::vector<FitState> hypotheses;
  for (const double start_rad : StartsOf(problem)) {
    Refine(problem, AtOrientation(start_rad), hypotheses);
  }
  SortBySquares(hypotheses);
  return hypotheses;
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
// squared distances, weighted by likelihoods. Squared residuals of `margin` are worth three
// standard deviations here, as they are where orientations farther away are ruled out.
double SpreadOf(const std::vector<FitState>& hypotheses, double margin) {
  const double factor = std::max(margin / (kMarginSigmas * kMarginSigmas), 1.0);
  const FitState& best = hypotheses.front();
  double weights = 0.0;
  double spread = 0.0;
  for (const FitState& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.unknowns[2] - best.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) continue;
    const double weight = std::exp(0.5 * (best.squares - other.squares) / factor);
    weights += weight;
    spread += weight * turn_rad * turn_rad;
  }
  return spread / weights;
}

double MarginOf(const std::vector<FitState>& hypotheses) {
  const FitState& best = hypotheses.front();
  for (const FitState& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.unknowns[2] - best.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) return other.squares - best.squares;
  }
  return std::numeric_limits<double>::infinity();
}

CylinderFit FitOf(const FitProblem& problem, const std::vector<FitState>& hypotheses,
                  const EyeGeometry& eyes, const CylinderFitParams& params) {
  const FitState& best = hypotheses.front();
  CylinderFit fit;
  fit.place = problem.PlaceOf(best.unknowns);
  fit.place.orientation_rad = math::WrapAngle(fit.place.orientation_rad);
  fit.cost = best.squares;
  fit.colour_misfit = best.evaluation.colour_misfit;
  fit.misfit = (best.squares - fit.colour_misfit) / problem.samples();
  fit.margin = MarginOf(hypotheses);
  fit.height_m = problem.height_m();
  fit.blur_px = problem.BlurOf(best.unknowns);
  const double factor = std::max(fit.misfit, 1.0);
  fit.covariance = factor * math::InverseOf(best.information).topLeftCorner<4, 4>();
  fit.covariance(2, 2) += SpreadOf(hypotheses, factor * params.least_margin);
  const FitState free = DescendFrom(problem, best.unknowns, FitRadius::kFree, kMostSteps);
  const CylinderPlace free_place = problem.PlaceOf(free.unknowns);
  fit.free_depth_m = (free_place.p_LT_L - eyes.centre_L).dot(eyes.forward_L);
  fit.radius_ratio = 1.0 + free.unknowns[4];
  fit.radius_ratio_sd = std::sqrt(factor * math::InverseOf(free.information)(4, 4));
  return fit;
}

}  // namespace

std::optional<CylinderFit> FitCylinder(const ColourPair& pair, const EyeGeometry& eyes,
                                       const ColourCylinder& cylinder, const RegionPair& candidate,
                                       const LogRatios& light, const RobustFinderParams& params) {
  const FitProblem first(pair, eyes, cylinder, candidate, light, params);
  const std::vector<FitState> guesses = HypothesesOf(first);
  if (guesses.empty()) return std::nullopt;
  const RegionPair boxed =
      BoxedBy(pair, eyes, first.PlaceOf(guesses.front().unknowns), cylinder.height_m, candidate);
  const FitProblem problem(pair, eyes, cylinder, boxed, light, params);
  const std::vector<FitState> hypotheses = HypothesesOf(problem);
  if (hypotheses.empty()) return std::nullopt;
  return FitOf(problem, hypotheses, eyes, params.fit);
}

}  // namespace rockyard::vision
