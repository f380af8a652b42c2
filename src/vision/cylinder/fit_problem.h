// The residuals of a place of the cylinder against the profiles of both eyes, and the descent to a
// minimum of their squares, for FitCylinder (cylinder_fit.h). Records of the experiment on
// sightings depend on the steps of derivatives and of the descent.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/cylinder_fit.h"
#include "vision/cylinder/wall_colours.h"

namespace rockyard::vision {

// The unknowns, in this order: how far the place is from the start across the view to the right and
// along the view, m; theta and roll, rad; the radius over the cylinder's, less 1; the logarithm of
// the blur over edge_blur_px.
using FitUnknowns = Eigen::Matrix<double, 6, 1>;

class FitProblem {
 public:
  // Starts at the candidate's point, moved up or down to the rows of the rims.
  FitProblem(const ColourPair& pair, const EyeGeometry& eyes, const ColourCylinder& cylinder,
             const RegionPair& candidate, const LogRatios& light, const RobustFinderParams& params);

  CylinderPlace PlaceOf(const FitUnknowns& unknowns) const;

  // Returns the standard deviation of the blur of edges, px.
  double BlurOf(const FitUnknowns& unknowns) const;

  // How a place agrees with what the eyes show.
  struct Evaluation {
    // Residuals over their standard deviations, equally many for all places: of the pixels, of the
    // quadrants' colours, and, as the last three, of the priors of the blur, the roll and the
    // radius (0 with sd `radius_sd`). Derivatives rely on the radius being the last.
    Eigen::VectorXd residuals;
    // The sum of the squared residuals of the colours: how much the quadrants' colours differ from
    // those of the surfaces (colour_model.h), and from one eye to the other.
    double colour_misfit = 0.0;
  };

  // Returns nothing where the place cannot be imaged.
  std::optional<Evaluation> Evaluate(const FitUnknowns& unknowns, double radius_sd) const;

  // Returns the steps of numerical derivatives: some hundredths of a pixel each.
  FitUnknowns Steps() const;

  // Returns how many of the residuals are of pixels.
  int samples() const { return samples_; }

  const std::array<EyeProfile, 2>& profiles() const { return profiles_; }

  // Returns the wall's height by the rows of the rims.
  double height_m() const { return height_m_; }

 private:
  // Moves the start to the middle of the rims, and finds height_m_.
  void TakeRows();

  std::array<const CameraModel*, 2> cameras_;
  const EyeGeometry& eyes_;
  const ColourCylinder& cylinder_;
  LogRatios light_;
  const RobustFinderParams& params_;
  QuadrantDirections directions_;
  std::array<EyeProfile, 2> profiles_;
  math::Vector3 start_L_;
  double depth_m_;
  double height_m_ = 0.0;
  int samples_ = 0;
};

using FitInformation = Eigen::Matrix<double, 6, 6>;

struct FitState {
  FitUnknowns unknowns = FitUnknowns::Zero();
  double squares = std::numeric_limits<double>::infinity();  // infinite where nothing is imaged
  // The inverse covariance of the unknowns, by the derivatives before the last step.
  FitInformation information = FitInformation::Identity();
  FitProblem::Evaluation evaluation;  // at the unknowns
};

// Whether a descent may change the radius; it always changes the other unknowns.
enum class FitRadius { kFixed, kFree };

// Returns the standard deviation of the radius's prior, over the cylinder's radius.
double RadiusDeviation(FitRadius radius);

// Descends by Gauss-Newton with numerical derivatives and Levenberg's damping: at most `most_steps`
// steps from a start, fewer where the squares no longer fall.
FitState DescendFrom(const FitProblem& problem, const FitUnknowns& start, FitRadius radius,
                     int most_steps);

}  // namespace rockyard::vision
