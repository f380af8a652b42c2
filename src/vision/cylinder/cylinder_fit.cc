#include "vision/cylinder/cylinder_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "math/angles.h"
#include "math/decompositions.h"
#include "math/functions.h"
#include "vision/cylinder/fit_problem.h"

namespace rockyard::vision {

namespace {

constexpr int kOrientations = 48;
// The most local minima over the orientations that are refined.
constexpr std::size_t kMostStarts = 5;
// Minima whose cost is more than so many times the least are not refined.
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

// Returns the orientations to start from, best first: those whose cost is not larger than that of
// either neighbour and not far above the least.
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

// Returns the refined minima, best first.
std::vector<FitState> HypothesesOf(const FitProblem& problem) {
  std::vector<FitState> hypotheses;
  for (const double start_rad : StartsOf(problem)) {
    Refine(problem, AtOrientation(start_rad), hypotheses);
  }
  SortBySquares(hypotheses);
  return hypotheses;
}

// Returns the candidate moved to a place, with boxes that begin and end where the wall there does.
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

// Returns what nearly as likely orientations near the best one add to its variance, rad^2: their
// mean squared distance, weighted by likelihoods. A difference of the squared residuals by `margin`
// counts as three standard deviations, as it does in ruling out orientations farther away.
double SpreadOf(const std::vector<FitState>& hypotheses, double margin) {
  const double factor = std::max(margin / (kMarginSigmas * kMarginSigmas), 1.0);
  const FitState& best = hypotheses.front();
  double weights = 0.0;
  double spread = 0.0;
  for (const FitState& other : hypotheses) {
    const double turn_rad = math::WrapAngle(other.unknowns[2] - best.unknowns[2]);
    if (std::abs(turn_rad) > kOtherOrientation_rad) continue;
    const double weight = math::Exp(0.5 * (best.squares - other.squares) / factor);
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

namespace {

// The most candidate regions of an eye, largest first: more are noise.
constexpr std::size_t kMostRegions = 24;
// The least and the largest width over height of a region, over that of the cylinder: elevation and
// mixed rims change it.
constexpr double kNarrowest = 0.5;
constexpr double kWidest = 1.7;
// Pixels between a region and the border, from which the fit takes the background.
constexpr int kBorder_px = 3;
// Rows and columns with less than this share of the median's pixels are stray.
constexpr double kStray = 0.35;

struct EyeRegions {
  std::vector<ColourRegion> whole;      // inside of the image
  std::optional<ColourRegion> clipped;  // the largest that ends at the border, of several classes
  int largest_px = 0;
};

// Returns the places of the first and the last count that is not stray.
std::pair<int, int> WithoutStray(const std::vector<int>& counts) {
  std::vector<int> sorted = counts;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto is_full = [&](int count) { return count >= kStray * *middle; };
  const auto first = std::find_if(counts.begin(), counts.end(), is_full);
  const auto last = std::find_if(counts.rbegin(), counts.rend(), is_full);
  return {static_cast<int>(first - counts.begin()),
          static_cast<int>(counts.size()) - 1 - static_cast<int>(last - counts.rbegin())};
}

ColourRegion Trimmed(const ClassImage& labels, ColourRegion region) {
  std::vector<int> in_columns(static_cast<std::size_t>(region.Width()), 0);
  std::vector<int> in_rows(static_cast<std::size_t>(region.Height()), 0);
  for (int y = region.top; y <= region.bottom; ++y) {
    for (int x = region.left; x <= region.right; ++x) {
      if (labels.At(x, y) == kBackground) continue;
      ++in_columns[static_cast<std::size_t>(x - region.left)];
      ++in_rows[static_cast<std::size_t>(y - region.top)];
    }
  }
  const auto [first_column, last_column] = WithoutStray(in_columns);
  const auto [first_row, last_row] = WithoutStray(in_rows);
  region.right = region.left + last_column;
  region.left += first_column;
  region.bottom = region.top + last_row;
  region.top += first_row;
  return region;
}

bool HasShape(const ColourRegion& region, const ColourCylinder& cylinder,
              const CandidateParams& params) {
  const double ratio = cylinder.diameter_m / cylinder.height_m;
  const double error_px = params.box_error_px;
  const double box_px = static_cast<double>(region.Width()) * region.Height();
  return region.Width() + error_px >= kNarrowest * ratio * (region.Height() - error_px) &&
         region.Width() - error_px <= kWidest * ratio * (region.Height() + error_px) &&
         region.pixels >= params.least_fill * box_px;
}

bool IsAtBorder(const ColourRegion& region, const ClassImage& labels) {
  return region.left < kBorder_px || region.top < kBorder_px ||
         region.right >= labels.width() - kBorder_px ||
         region.bottom >= labels.height() - kBorder_px;
}

// Returns whether at least two classes have a tenth of the region each. A view of the cylinder
// shows two or three quadrants, of which the second widest has at least (1 - sin 45 deg) / 2 = 15 %
// of the width.
bool HasTwoColours(const ColourRegion& region, const ClassImage& labels) {
  std::array<int, kCylinderColours + 1> counts{};
  for (int y = region.top; y <= region.bottom; ++y) {
    for (int x = region.left; x <= region.right; ++x) ++counts.at(labels.At(x, y));
  }
  return std::count_if(counts.begin() + 1, counts.end(),
                       [&](int count) { return 10 * count >= region.pixels; }) >= 2;
}

EyeRegions RegionsIn(const ClassImage& labels, const ColourCylinder& cylinder,
                     const CandidateParams& params) {
  EyeRegions found;
  std::vector<ColourRegion> regions = FindRegions(labels, WholeOf(labels), RegionColours::kAny);
  std::erase_if(regions, [&](const ColourRegion& region) {
    found.largest_px = std::max(found.largest_px, region.pixels);
    return region.pixels < params.least_whole_px;
  });
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  for (const ColourRegion& region : regions) {
    if (IsAtBorder(region, labels)) {
      if (!found.clipped && HasTwoColours(region, labels)) found.clipped = region;
      continue;
    }
    const ColourRegion trimmed = Trimmed(labels, region);
    if (HasShape(trimmed, cylinder, params) && HasTwoColours(trimmed, labels)) {
      found.whole.push_back(trimmed);
    }
    if (found.whole.size() == kMostRegions) break;
  }
  return found;
}

Pixel MiddleOfBox(const ColourRegion& region) {
  return {0.5 * (region.left + region.right), 0.5 * (region.top + region.bottom)};
}

// Returns whether two sides differ by no more than a share of the larger one and an error.
bool AreLike(double a, double b, double tolerance, double error_px) {
  return std::abs(a - b) <= tolerance * std::max(a, b) + error_px;
}

bool AreLikeBoxes(const ColourRegion& a, const ColourRegion& b, const CandidateParams& params) {
  return AreLike(a.Width(), b.Width(), params.size_tolerance, params.box_error_px) &&
         AreLike(a.Height(), b.Height(), params.height_tolerance, params.box_error_px);
}

bool RowsMeet(const ColourPair& pair, const SeenPoint& point, const RegionPair& regions,
              const CandidateParams& params) {
  const auto in_left = Project(pair.left_camera, point.p_L);
  const auto in_right = Project(pair.right_camera, point.p_L);
  if (!in_left || !in_right) return false;
  const double apart_px = std::abs((in_left->y() - MiddleOfBox(regions.left).y()) -
                                   (in_right->y() - MiddleOfBox(regions.right).y()));
  return apart_px <= params.box_error_px;
}

// Counts why pairs of regions were refused, for the reason where none is left.
struct PairTally {
  int behind = 0;
  std::string other_size;

  CylinderMiss Miss(std::string& reason) const {
    if (behind > 0) {
      reason =
          "both images show the same region, and lines of sight to it do not meet before the "
          "cameras: are the images swapped?";
      return CylinderMiss::kSwappedEyes;
    }
    if (!other_size.empty()) {
      reason = other_size;
      return CylinderMiss::kNotACylinder;
    }
    reason = "no region of one image is like one of the other";
    return CylinderMiss::kUnlikeEyes;
  }
};

// Adds the pair if it may be the cylinder.
void TryPair(const ColourPair& pair, const EyeGeometry& eyes, const ColourCylinder& cylinder,
             const CandidateParams& params, RegionPair regions, CandidateSearch& search,
             PairTally& tally) {
  if (!AreLikeBoxes(regions.left, regions.right, params)) return;
  const auto point = PointSeenAt(pair, eyes, MiddleOfBox(regions.left), MiddleOfBox(regions.right));
  if (!point) {
    const double rows_px = std::abs(MiddleOfBox(regions.left).y() - MiddleOfBox(regions.right).y());
    if (rows_px <= params.box_error_px) ++tally.behind;
    return;
  }
  if (!RowsMeet(pair, *point, regions, params)) return;
  const double px_a_m = eyes.focal_px / point->depth_m;
  const double width_px = 0.5 * (regions.left.Width() + regions.right.Width());
  const double height_px = 0.5 * (regions.left.Height() + regions.right.Height());
  if (!AreLike(width_px, px_a_m * cylinder.diameter_m, params.size_tolerance,
               params.box_error_px) ||
      !AreLike(height_px, px_a_m * cylinder.height_m, params.height_tolerance,
               params.box_error_px)) {
    tally.other_size = fmt::format(
        "a region of {:.0f} x {:.0f} pixels {:.2f} m away is {:.3f} m wide and {:.3f} m high",
        width_px, height_px, point->depth_m, width_px / px_a_m, height_px / px_a_m);
    return;
  }
  regions.point = *point;
  search.pairs.push_back(regions);
}

}  // namespace

CandidateSearch FindCandidates(const ColourPair& pair, const EyeGeometry& eyes,
                               const ColourCylinder& cylinder, const ClassImage& left,
                               const ClassImage& right, const CandidateParams& params) {
  const EyeRegions in_left = RegionsIn(left, cylinder, params);
  const EyeRegions in_right = RegionsIn(right, cylinder, params);
  CandidateSearch search;
  PairTally tally;
  for (const ColourRegion& a : in_left.whole) {
    for (const ColourRegion& b : in_right.whole) {
      TryPair(pair, eyes, cylinder, params, {a, b, {}}, search, tally);
    }
  }
  if (!search.pairs.empty()) return search;
  if (in_left.clipped || in_right.clipped) {
    search.miss = CylinderMiss::kClipped;
    search.reason = fmt::format("a region of the colours ends at the border of the {} image",
                                in_left.clipped ? "left" : "right");
  } else if (in_left.whole.empty() && in_right.whole.empty()) {
    search.reason = fmt::format(
        "no region has two of the colours, the cylinder's shape and {} pixels; the largest has {}",
        params.least_whole_px, std::max(in_left.largest_px, in_right.largest_px));
  } else {
    search.miss = tally.Miss(search.reason);
  }
  return search;
}

}  // namespace rockyard::vision
