#include "vision/cylinder/fit_problem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/check.h"
#include "math/decompositions.h"
#include "math/functions.h"

namespace rockyard::vision {
namespace {

// How many residuals of an eye are priors of shading and level. Must be kAllUnknowns of
// wall_colours.cc.
constexpr int kPriors = 27;
// How far the rims that a profile shows lie before the axis, over the radius. Must be the mean of
// sqrt(1 - u^2) for |u| up to 1 - 2 kRimShare = 0.6 (cylinder_profile.cc).
constexpr double kRimsAhead = 0.936;

// Returns by how many rows the middle of a rim lies below its ends: positive in a view from above,
// negative in one from below.
double SagOf(const EyeGeometry& eyes, const ColourCylinder& cylinder, const SeenPoint& point) {
  const double down = -(point.p_L - eyes.centre_L).normalized().dot(cylinder.Axis_L());
  return 0.5 * cylinder.diameter_m * down * eyes.focal_px / point.depth_m;
}

SeenColour SeenColourOf(const QuadrantColour& quadrant) {
  // A level below its own standard deviation only tells that it is not far above this deviation.
  const Eigen::Array3d levels =
      quadrant.colour.array().max(quadrant.covariance.diagonal().array().sqrt()).max(1.0);
  SeenColour seen;
  seen.colour = kQuadrantColours.at(static_cast<std::size_t>(quadrant.quadrant));
  seen.ratios = LogRatiosOf(levels);
  // The derivative of the logarithms of ratios by the levels.
  Eigen::Matrix<double, 2, 3> by_level;
  by_level << 1.0 / levels[0], -1.0 / levels[1], 0.0, 0.0, -1.0 / levels[1], 1.0 / levels[2];
  seen.covariance = by_level * quadrant.covariance * by_level.transpose();
  return seen;
}

// The colours of quadrants A to D, as far as an eye sees them.
using SeenQuadrants = std::array<std::optional<SeenColour>, 4>;

// Returns the mean of both eyes' colours weighted by their covariances, so that a quadrant that
// both see counts once.
SeenColour MeanOf(const SeenColour& left, const SeenColour& right) {
  const Eigen::Matrix2d of_left = left.covariance.inverse();
  const Eigen::Matrix2d of_right = right.covariance.inverse();
  SeenColour mean = left;
  mean.covariance = (of_left + of_right).inverse();
  mean.ratios = mean.covariance * (of_left * left.ratios + of_right * right.ratios);
  return mean;
}

// The residuals of colours: two of each quadrant's difference between the eyes, two of each
// quadrant's colour, and three of the light and the saturation; zeros for quadrants that are not
// seen.
using ColourResidualsOfAll = std::array<double, 19>;

ColourResidualsOfAll ResidualsOf(const std::array<SeenQuadrants, 2>& eyes, double parallax_rad,
                                 const LogRatios& light, const RobustFinderParams& params) {
  constexpr std::size_t kColours = 8;
  constexpr std::size_t kLight = 16;
  // The eyes see a round wall from different directions, and so in different light.
  const Eigen::Matrix2d parallax = parallax_rad * parallax_rad * Eigen::Matrix2d::Identity();
  ColourResidualsOfAll residuals{};
  std::vector<SeenColour> seen;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < kQuadrantColours.size(); ++i) {
    const auto& left = eyes[0].at(i);
    const auto& right = eyes[1].at(i);
    if (!left && !right) continue;
    places.push_back(kColours + 2 * i);
    if (!left || !right) {
      seen.push_back(left ? *left : *right);
      continue;
    }
    seen.push_back(MeanOf(*left, *right));
    const LogRatios apart = WhiteningOf(left->covariance + right->covariance + parallax) *
                            (left->ratios - right->ratios);
    std::copy(apart.begin(), apart.end(), residuals.begin() + static_cast<std::ptrdiff_t>(2 * i));
  }
  places.push_back(kLight);
  const std::vector<double> of_colours =
      ColourResiduals(seen, light, params.surfaces, params.colours);
  for (std::size_t i = 0; i < of_colours.size(); ++i) {
    const std::size_t group = std::min(i / 2, seen.size());
    residuals.at(places[group] + i - 2 * group) = of_colours[i];
  }
  return residuals;
}

QuadrantDirections DirectionsOf(const LogRatios& light, const RobustFinderParams& params) {
  QuadrantDirections directions;
  std::transform(kQuadrantColours.begin(), kQuadrantColours.end(), directions.begin(),
                 [&](CylinderColour colour) {
                   return DirectionOf(colour, light, params.surfaces, params.colours);
                 });
  return directions;
}

std::array<EyeProfile, 2> ProfilesOf(const ColourPair& pair, const RegionPair& candidate,
                                     double sag_px, const CylinderFitParams& params) {
  return {ProfileOf(pair.left, candidate.left, sag_px, params),
          ProfileOf(pair.right, candidate.right, sag_px, params)};
}

constexpr double kMostDamping = 1e3;
constexpr double kLeastDamping = 1e-6;
constexpr double kFirstDamping = 1e-3;
// A step is the last that lessens the squares by less than this, or by less than this share of a
// hundredth of them.
constexpr double kConverged = 1e-2;
constexpr int kRadius = 4;  // place of the radius in FitUnknowns
// Standard deviations of the prior of a fixed and of a free radius, over the cylinder's radius.
constexpr double kFixedRadius_sd = 1e-4;
constexpr double kFreeRadius_sd = 1.0;

// Returns forward derivatives of the residuals; a fixed radius only changes its own prior, the last
// residual. Returns nothing where a step leads to a place that cannot be imaged.
std::optional<Eigen::MatrixXd> Derivatives(const FitProblem& problem, const FitUnknowns& unknowns,
                                           const Eigen::VectorXd& residuals, FitRadius radius) {
  const FitUnknowns steps = problem.Steps();
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(residuals.size(), steps.size());
  for (int i = 0; i < steps.size(); ++i) {
    if (i == kRadius && radius == FitRadius::kFixed) {
      derivatives(residuals.size() - 1, i) = 1.0 / kFixedRadius_sd;
      continue;
    }
    FitUnknowns step = FitUnknowns::Zero();
    step[i] = steps[i];
    const auto ahead = problem.Evaluate(unknowns + step, RadiusDeviation(radius));
    if (!ahead) return std::nullopt;
    derivatives.col(i) = (ahead->residuals - residuals) / steps[i];
  }
  return derivatives;
}

// Returns the damped step towards the minimum of the linear problem.
FitUnknowns DampedStep(const FitInformation& information, const FitUnknowns& gradient,
                       double damping) {
  FitInformation damped = information;
  damped.diagonal() *= 1.0 + damping;
  return -math::SolveSymmetric(damped, gradient);
}

}  // namespace

FitProblem::FitProblem(const ColourPair& pair, const EyeGeometry& eyes,
                       const ColourCylinder& cylinder, const RegionPair& candidate,
                       const LogRatios& light, const RobustFinderParams& params)
    : cameras_{&pair.left_camera, &pair.right_camera},
      eyes_(eyes),
      cylinder_(cylinder),
      light_(light),
      params_(params),
      directions_(DirectionsOf(light, params)),
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
  // The second unknown moves along the line of sight, so that the rows stay.
  const math::Vector3 sight_m = start_L_ - eyes_.centre_L;
  place.p_LT_L += unknowns[1] / depth_m_ * sight_m;
  place.axis_L = cylinder_.Axis_L();
  place.orientation_rad = unknowns[2];
  place.roll_rad = unknowns[3];
  place.radius_m = 0.5 * cylinder_.diameter_m * (1.0 + unknowns[4]);
  return place;
}

double FitProblem::BlurOf(const FitUnknowns& unknowns) const {
  return params_.fit.edge_blur_px * math::Exp(unknowns[5]);
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
  const double blur_px = BlurOf(unknowns);
  Evaluation evaluation;
  std::vector<double> residuals;
  std::array<SeenQuadrants, 2> quadrants;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto view = WallSeen(*cameras_.at(eye), eyes_, place, 0.5 * cylinder_.height_m);
    if (!view) return std::nullopt;
    for (const QuadrantColour& colour :
         FitWallColours(profiles_.at(eye), *view, directions_, blur_px, params_.fit, residuals)) {
      quadrants.at(eye).at(static_cast<std::size_t>(colour.quadrant)) = SeenColourOf(colour);
    }
  }
  for (const double residual :
       ResidualsOf(quadrants, eyes_.baseline_m / depth_m_, light_, params_)) {
    residuals.push_back(residual);
    evaluation.colour_misfit += residual * residual;
  }
  residuals.push_back(unknowns[5] / params_.fit.edge_blur_spread);
  residuals.push_back(unknowns[3] / params_.fit.roll_sd_rad);
  residuals.push_back(unknowns[4] / radius_sd);
  evaluation.residuals = Eigen::Map<const Eigen::VectorXd>(
      residuals.data(), static_cast<Eigen::Index>(residuals.size()));
  return evaluation;
}

double RadiusDeviation(FitRadius radius) {
  return radius == FitRadius::kFree ? kFreeRadius_sd : kFixedRadius_sd;
}

FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitRadius radius,
                     int most_steps) {
  EXPECT(most_steps >= 1);
  FitState state;
  state.unknowns = start;
  auto evaluation = problem.Evaluate(start, RadiusDeviation(radius));
  if (!evaluation) return state;
  double damping = kFirstDamping;
  std::optional<Eigen::MatrixXd> derivatives;
  for (int i = 0; i < most_steps && damping < kMostDamping; ++i) {
    if (!derivatives) {
      derivatives = Derivatives(problem, state.unknowns, evaluation->residuals, radius);
      if (!derivatives) break;
      state.information = derivatives->transpose() * *derivatives;
      state.squares = evaluation->residuals.squaredNorm();
    }
    const FitUnknowns gradient = derivatives->transpose() * evaluation->residuals;
    const FitUnknowns next = state.unknowns + DampedStep(state.information, gradient, damping);
    auto there = next.allFinite() ? problem.Evaluate(next, RadiusDeviation(radius)) : std::nullopt;
    const double squares =
        there ? there->residuals.squaredNorm() : std::numeric_limits<double>::infinity();
    if (squares >= state.squares) {
      damping *= 10.0;
      continue;
    }
    const bool converged = state.squares - squares < kConverged * std::max(1.0, 0.01 * squares);
    state.unknowns = next;
    state.squares = squares;
    evaluation = std::move(there);
    damping = std::max(0.1 * damping, kLeastDamping);
    if (converged) break;
    derivatives.reset();
  }
  state.evaluation = std::move(*evaluation);
  return state;
}

}  // namespace rockyard::vision
