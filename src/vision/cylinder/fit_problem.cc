#include "vision/cylinder/fit_problem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rockyard::vision {
namespace {

// Terms of shading and levels among the residuals of an eye.
constexpr int kPriors = 27;
// How far the rims that a profile shows lie before the axis, over the radius: the mean of
// sqrt(1 - u^2) for |u| up to 1 - 2 kRimShare = 0.6.
constexpr double kRimsAhead = 0.936;

// How many rows the middle of the wall lies below its sides: of the radius, what the view from
// above (or, negative, from below) shows.
double SagOf(const EyeGeometry& eyes, const ColourCylinder& cylinder, const SeenPoint& point) {
  const double down = -(point.p_L - eyes.centre_L).normalized().dot(cylinder.Axis_L());
  return 0.5 * cylinder.diameter_m * down * eyes.focal_px / point.depth_m;
}

// Quadrants that both eyes see count once, with the mean of both weighted by their covariances.
std::vector<QuadrantColour> Together(const std::vector<QuadrantColour>& colours) {
  std::vector<QuadrantColour> together;
  for (const QuadrantColour& colour : colours) {
    const auto same = std::find_if(together.begin(), together.end(), [&](const auto& other) {
      return other.quadrant == colour.quadrant;
    });
    if (same == together.end()) {
      together.push_back(colour);
      continue;
    }
    const Eigen::Matrix3d first = same->covariance.inverse();
    const Eigen::Matrix3d second = colour.covariance.inverse();
    same->covariance = (first + second).inverse();
    same->colour = same->covariance * (first * same->colour + second * colour.colour);
  }
  return together;
}

SeenColour SeenColourOf(const QuadrantColour& quadrant) {
  const Eigen::Array3d levels = quadrant.colour.array().max(1.0);
  SeenColour seen;
  seen.colour = kQuadrantColours.at(static_cast<std::size_t>(quadrant.quadrant));
  seen.ratios = LogRatiosOf(levels);
  // Of a logarithm of a ratio, the mean of both.
  Eigen::Matrix<double, 2, 3> by_level;
  by_level << 1.0 / levels[0], -1.0 / levels[1], 0.0, 0.0, -1.0 / levels[1], 1.0 / levels[2];
  seen.variance = 0.5 * (by_level * quadrant.covariance * by_level.transpose()).trace();
  return seen;
}

std::array<EyeProfile, 2> ProfilesOf(const ColourPair& pair, const RegionPair& candidate,
                                     double sag_px, const CylinderFitParams& params) {
  return {ProfileOf(pair.left, candidate.left, sag_px, params),
          ProfileOf(pair.right, candidate.right, sag_px, params)};
}

}  // namespace

FitProblem::FitProblem(const ColourPair& pair, const EyeGeometry& eyes,
                       const ColourCylinder& cylinder, const RegionPair& candidate,
                       const RobustFinderParams& params)
    : cameras_{&pair.left_camera, &pair.right_camera},
      eyes_(eyes),
      cylinder_(cylinder),
      params_(params),
      profiles_(ProfilesOf(pair, candidate, SagOf(eyes, cylinder, candidate.point), params.fit)),
      start_L_(candidate.point.p_L),
      depth_m_(candidate.point.depth_m) {
  for (const EyeProfile& profile : profiles_) samples_ += ResidualsOf(profile) - kPriors;
  TakeRows();
}

void FitProblem::TakeRows() {
  const math::Vector3 axis_L = cylinder_.Axis_L();
  const math::Vector3 half_axis_m = 0.5 * cylinder_.height_m * axis_L;
  double rise_m = 0.0;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const EyeProfile& profile = profiles_.at(eye);
    const math::Vector3 ahead =
        AcrossAxis(CentreOf(*cameras_.at(eye)) - start_L_, axis_L).normalized();
    const math::Vector3 front_L = start_L_ + kRimsAhead * 0.5 * cylinder_.diameter_m * ahead;
    const auto upper = Project(*cameras_.at(eye), front_L + half_axis_m);
    const auto lower = Project(*cameras_.at(eye), front_L - half_axis_m);
    if (!upper || !lower || !(upper->y() < lower->y())) continue;
    const double m_a_px = cylinder_.height_m / (lower->y() - upper->y());
    const double middle_px = 0.5 * (profile.upper_rim_px + profile.lower_rim_px);
    rise_m += 0.5 * m_a_px * (0.5 * (upper->y() + lower->y()) - middle_px);
    height_m_ += 0.5 * m_a_px * (profile.lower_rim_px - profile.upper_rim_px);
  }
  start_L_ += rise_m * axis_L;
}

CylinderPlace FitProblem::PlaceOf(const FitUnknowns& unknowns) const {
  CylinderPlace place;
  place.p_LT_L = start_L_ + unknowns[0] * eyes_.right_L;
  // Along the line of sight, so that the rows stay.
  const math::Vector3 sight_m = start_L_ - eyes_.centre_L;
  place.p_LT_L += unknowns[1] / depth_m_ * sight_m;
  place.axis_L = cylinder_.Axis_L();
  place.orientation_rad = unknowns[2];
  place.roll_rad = unknowns[3];
  place.radius_m = 0.5 * cylinder_.diameter_m * (1.0 + unknowns[4]);
  return place;
}

FitUnknowns FitProblem::Steps() const {
  const double across_m = 0.02 * depth_m_ / eyes_.focal_px;
  const double along_m = 0.04 * depth_m_ * depth_m_ / (eyes_.focal_px * eyes_.baseline_m);
  const double share = across_m / cylinder_.diameter_m;
  FitUnknowns steps;
  steps << across_m, along_m, share, 2e-3, share, 1e-2;
  return steps;
}

std::optional<FitProblem::Evaluation> FitProblem::Evaluate(const FitUnknowns& unknowns,
                                                           double radius_sd) const {
  if (!(unknowns[4] > -1.0)) return std::nullopt;
  const CylinderPlace place = PlaceOf(unknowns);
  const double blur_px = params_.fit.edge_blur_px * std::exp(unknowns[5]);
  Evaluation evaluation;
  std::vector<double> residuals;
  residuals.reserve(static_cast<std::size_t>(samples_) + static_cast<std::size_t>(2 * kPriors + 3));
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto view = WallSeen(*cameras_.at(eye), eyes_, place, 0.5 * cylinder_.height_m);
    if (!view) return std::nullopt;
    FitWallColours(profiles_.at(eye), *view, blur_px, params_.fit, residuals, evaluation.colours);
  }
  residuals.push_back(unknowns[5] / params_.fit.edge_blur_spread);
  residuals.push_back(unknowns[3] / params_.fit.roll_sd_rad);
  residuals.push_back(unknowns[4] / radius_sd);
  evaluation.residuals = Eigen::Map<const Eigen::VectorXd>(
      residuals.data(), static_cast<Eigen::Index>(residuals.size()));
  return evaluation;
}

double FitProblem::ColourMisfitOf(const Evaluation& evaluation, const LogRatios& light) const {
  std::vector<SeenColour> seen;
  for (const QuadrantColour& quadrant : Together(evaluation.colours)) {
    seen.push_back(SeenColourOf(quadrant));
  }
  return ColourMisfit(seen, light, params_.surfaces, params_.colours);
}

}  // namespace rockyard::vision
