#include "vision/cylinder/robust_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/cylinder_fit.h"

namespace rockyard::vision {
namespace {

// A candidate, its fit, and why it is no cylinder, if it is none.
struct JudgedCandidate {
  RegionPair regions;
  std::optional<CylinderFit> fit;
  CylinderMiss miss = CylinderMiss::kNone;
  std::string reason;
};

// A radius may differ from the cylinder's by so many standard deviations, or by radius_tolerance if
// that is more. The text of radius_tolerance (robust_finder_params.cc) names this number.
constexpr double kRadiusSigmas = 4.0;
// By how many of the prior's standard deviations the logarithm of a fitted blur may be above the
// prior.
constexpr double kBlurSigmas = 3.0;

void JudgeFit(const CylinderFit& fit, const ColourCylinder& cylinder,
              const RobustFinderParams& params, JudgedCandidate& candidate) {
  const auto refuse = [&](CylinderMiss miss, std::string reason) {
    candidate.miss = miss;
    candidate.reason = std::move(reason);
  };
  const double most_blur_px =
      params.fit.edge_blur_px * math::Exp(kBlurSigmas * params.fit.edge_blur_spread);
  const double radius_error = std::abs(fit.radius_ratio - 1.0);
  const double height_error = std::abs(fit.height_m / cylinder.height_m - 1.0);
  const double px_m = fit.place.radius_m > 0.0 ? 2.0 * fit.place.radius_m : 1.0;
  const double width_px = 0.5 * (candidate.regions.left.Width() + candidate.regions.right.Width());
  const double height_tolerance =
      params.candidates.height_tolerance +
      params.candidates.box_error_px * px_m / (width_px * cylinder.height_m);
  if (fit.colour_misfit > params.fit.largest_colour_misfit) {
    refuse(CylinderMiss::kNotACylinder,
           fmt::format("the colours side by side are not those of the cylinder: squared residuals "
                       "of {:.0f}, {:g} are allowed",
                       fit.colour_misfit, params.fit.largest_colour_misfit));
  } else if (fit.misfit > params.fit.largest_misfit) {
    refuse(CylinderMiss::kNotACylinder,
           fmt::format("its pixels are not those of a cylinder: a mean squared residual of {:.1f}, "
                       "{:g} is allowed",
                       fit.misfit, params.fit.largest_misfit));
  } else if (fit.blur_px > most_blur_px) {
    refuse(CylinderMiss::kNotACylinder,
           fmt::format("its edges are blurred by {:.1f} px, at most {:.1f} px are expected",
                       fit.blur_px, most_blur_px));
  } else if (radius_error >
                 std::max(params.fit.radius_tolerance, kRadiusSigmas * fit.radius_ratio_sd) ||
             height_error > height_tolerance) {
    refuse(CylinderMiss::kNotACylinder,
           fmt::format("at its depth by stereo it is {:.3f} m wide and {:.3f} m high",
                       fit.radius_ratio * cylinder.diameter_m, fit.height_m));
  } else if (fit.margin < params.fit.least_margin * std::max(fit.misfit, 1.0)) {
    refuse(CylinderMiss::kAmbiguous,
           fmt::format("{:.0f} deg is hardly more likely than another orientation (squared "
                       "residuals differ by {:.1f}, {:.1f} are needed)",
                       math::RadToDeg(fit.place.orientation_rad), fit.margin,
                       params.fit.least_margin * std::max(fit.misfit, 1.0)));
  }
}

// Returns the error of boundaries, px, beyond what residuals tell: it grows where the pixels fit
// worse than usual, and by what the wall is too wide or too narrow for its known radius.
double BoundaryError(const CylinderFit& fit, double width_px, const CylinderFitParams& params) {
  const double model_px = params.model_error_px * std::max(fit.misfit / params.usual_misfit, 1.0);
  return math::Hypot(model_px, 0.5 * width_px * (fit.radius_ratio - 1.0));
}

double Squared(double x) { return x * x; }

// Returns the covariance of p_LT_L and theta: that of the fit, with the errors of its model and of
// the rows.
Eigen::Matrix4d CovarianceOf(const CylinderFit& fit, const EyeGeometry& eyes, double depth_m,
                             double width_px, const CylinderFitParams& params) {
  const double m_a_px = depth_m / eyes.focal_px;
  const double error_px = BoundaryError(fit, width_px, params);
  Eigen::Matrix4d measured = Eigen::Matrix4d::Zero();  // across, along, up, theta
  measured.topLeftCorner<2, 2>() = fit.covariance.topLeftCorner<2, 2>();
  measured(3, 3) = fit.covariance(2, 2);
  measured.block<2, 1>(0, 3) = fit.covariance.block<2, 1>(0, 2);
  measured.block<1, 2>(3, 0) = fit.covariance.block<1, 2>(2, 0);
  measured(0, 0) += Squared(error_px * m_a_px);
  measured(1, 1) += Squared(error_px * depth_m * m_a_px / eyes.baseline_m);
  measured(2, 2) = Squared(params.row_error_px * m_a_px);
  measured(3, 3) += Squared(error_px * CoarsestTurn(width_px));
  Eigen::Matrix4d axes = Eigen::Matrix4d::Identity();
  axes.block<3, 1>(0, 0) = eyes.right_L;
  axes.block<3, 1>(0, 1) = (fit.place.p_LT_L - eyes.centre_L) / depth_m;
  axes.block<3, 1>(0, 2) = eyes.up_L;
  return axes * measured * axes.transpose();
}

// Returns the regions to draw: the box, and the quadrants that the fit sees in it.
std::vector<ColourRegion> RegionsToDraw(const CameraModel& camera, const EyeGeometry& eyes,
                                        const ColourRegion& box, const CylinderPlace& place,
                                        double height_m) {
  std::vector<ColourRegion> regions = {box};
  const auto view = WallSeen(camera, eyes, place, 0.5 * height_m);
  if (!view) return regions;
  constexpr std::array<RegionRole, 3> kRoles = {RegionRole::kLeft, RegionRole::kMiddle,
                                                RegionRole::kRight};
  // Of two quadrants the wider one is the middle.
  const auto width = [&](std::size_t i) {
    return view->lines[i + 1].column - view->lines[i].column;
  };
  std::size_t first_role = 0;
  if (view->quadrants.size() == 1 || (view->quadrants.size() == 2 && width(0) >= width(1))) {
    first_role = 1;
  }
  for (std::size_t i = 0; i < view->quadrants.size(); ++i) {
    ColourRegion region = box;
    region.left = static_cast<int>(std::lround(view->lines[i].column + 0.5));
    region.right = static_cast<int>(std::lround(view->lines[i + 1].column - 0.5));
    if (region.right < region.left) continue;
    region.pixels = region.Width() * region.Height();
    region.centroid = {0.5 * (region.left + region.right), 0.5 * (region.top + region.bottom)};
    region.colour = kQuadrantColours.at(static_cast<std::size_t>(view->quadrants[i]));
    region.role = kRoles.at(first_role + i);
    regions.push_back(region);
  }
  return regions;
}

CylinderSighting SightingOf(const ColourPair& pair, const EyeGeometry& eyes,
                            const JudgedCandidate& candidate, const ColourCylinder& cylinder,
                            const RobustFinderParams& params) {
  const CylinderFit& fit = *candidate.fit;
  CylinderSighting sighting;
  sighting.orientation_rad = fit.place.orientation_rad;
  sighting.p_LT_L = fit.place.p_LT_L;
  sighting.distance_by_stereo_m = fit.free_depth_m;
  sighting.distance_by_size_m = fit.free_depth_m / fit.radius_ratio;
  const double depth_m = (fit.place.p_LT_L - eyes.centre_L).dot(eyes.forward_L);
  const double width_px = eyes.focal_px * cylinder.diameter_m / depth_m;
  sighting.covariance = CovarianceOf(fit, eyes, depth_m, width_px, params.fit);
  sighting.regions = {
      RegionsToDraw(pair.left_camera, eyes, candidate.regions.left, fit.place, cylinder.height_m),
      RegionsToDraw(pair.right_camera, eyes, candidate.regions.right, fit.place,
                    cylinder.height_m)};
  return sighting;
}

bool AreApart(const JudgedCandidate& a, const JudgedCandidate& b, const ColourCylinder& cylinder) {
  return (a.fit->place.p_LT_L - b.fit->place.p_LT_L).norm() > cylinder.diameter_m;
}

std::string PlaceText(const JudgedCandidate& candidate) {
  const ColourRegion& box = candidate.regions.left;
  return fmt::format("columns {} to {}, rows {} to {}", box.left, box.right, box.top, box.bottom);
}

std::vector<JudgedCandidate> JudgeAll(const ColourPair& pair, const EyeGeometry& eyes,
                                      const ColourCylinder& cylinder,
                                      const std::vector<RegionPair>& regions,
                                      const LogRatios& light, const RobustFinderParams& params) {
  std::vector<JudgedCandidate> judged;
  for (const RegionPair& one : regions) {
    JudgedCandidate candidate;
    candidate.regions = one;
    candidate.fit = FitCylinder(pair, eyes, cylinder, one, light, params);
    if (candidate.fit) {
      JudgeFit(*candidate.fit, cylinder, params, candidate);
    } else {
      candidate.miss = CylinderMiss::kNotACylinder;
      candidate.reason = "it cannot be imaged where both eyes show it";
    }
    judged.push_back(std::move(candidate));
  }
  return judged;
}

}  // namespace

CylinderFinding FindCylinder(const ColourPair& pair, const ColourCylinder& cylinder,
                             const RobustFinderParams& params) {
  EXPECT(HasSizeOf(pair.left, pair.left_camera) && HasSizeOf(pair.right, pair.right_camera));
  const std::optional<EyeGeometry> eyes = GeometryOf(pair);
  if (!eyes)
    return NotFound(CylinderMiss::kNothing, "the left camera images nothing in its middle");
  const LogRatios light = LightOf(pair.left, pair.right, params.surfaces, params.colours);
  std::array<ClassImage, 2> labels = {
      LabelSurfaces(pair.left, light, params.surfaces, params.colours),
      LabelSurfaces(pair.right, light, params.surfaces, params.colours)};
  for (ClassImage& of_eye : labels) {
    FillGaps(static_cast<int>(params.candidates.longest_gap_px), of_eye);
  }
  const CandidateSearch search =
      FindCandidates(pair, *eyes, cylinder, labels[0], labels[1], params.candidates);
  if (search.pairs.empty()) return NotFound(search.miss, search.reason);
  const std::vector<JudgedCandidate> judged =
      JudgeAll(pair, *eyes, cylinder, search.pairs, light, params);
  // The candidates that look like a cylinder, whether the orientation is known or not.
  std::vector<const JudgedCandidate*> cylinders;
  for (const JudgedCandidate& candidate : judged) {
    if (candidate.miss != CylinderMiss::kNone && candidate.miss != CylinderMiss::kAmbiguous) {
      continue;
    }
    cylinders.push_back(&candidate);
  }
  if (cylinders.empty()) return NotFound(judged.front().miss, judged.front().reason);
  const JudgedCandidate& best =
      **std::min_element(cylinders.begin(), cylinders.end(),
                         [](const auto* a, const auto* b) { return a->fit->cost < b->fit->cost; });
  for (const JudgedCandidate* other : cylinders) {
    if (!AreApart(best, *other, cylinder)) continue;
    return NotFound(CylinderMiss::kTwoCylinders,
                    fmt::format("two places of the left image look like a cylinder: {}, and {}",
                                PlaceText(best), PlaceText(*other)));
  }
  if (best.miss != CylinderMiss::kNone) return NotFound(best.miss, best.reason);
  CylinderFinding finding;
  finding.sighting = SightingOf(pair, *eyes, best, cylinder, params);
  return finding;
}

}  // namespace rockyard::vision
