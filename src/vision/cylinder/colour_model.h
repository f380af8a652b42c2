// How surfaces look in light that is not known, before a camera that is not known.
//
// A colour is c = (ln(red / green), ln(blue / green)), which brightness does not move. A surface of
// c_s looks like
//
//   c = light + saturation c_s + noise
//
// light: of an illuminant that scales each primary (von Kries 1902); saturation: crosstalk between
// the channels draws all colours towards grey. Both are unknown but for their priors, and the same
// for all surfaces of an image. Most of an image is ground: its median tells the light.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::vision {

using LogRatios = Eigen::Vector2d;

// Of positive primaries; those below half a grey level count as half a one.
LogRatios LogRatiosOf(const Eigen::Vector3d& primaries);

// The direction of a class's primaries in a light that is known, of length 1: brightness moves a
// colour along it.
Eigen::Vector3d DirectionOf(CylinderColour colour, const LogRatios& light,
                            const SurfaceColourParams& surfaces, const ColourModelParams& params);

// The surface colour of a class, or of the ground.
LogRatios SurfaceOf(CylinderColour colour, const SurfaceColourParams& surfaces);
LogRatios GroundOf(const SurfaceColourParams& surfaces);

// The light that the median of both images' ratios tells if it is ground, within twice light_sd of
// white. White where no pixel is bright enough.
LogRatios LightOf(const ColourImage& left, const ColourImage& right,
                  const SurfaceColourParams& surfaces, const ColourModelParams& params);

// The likeliest surface of each pixel: a class, or background where the ground or something grey is
// likelier or no class is within three standard deviations.
ClassImage LabelSurfaces(const ColourImage& image, const LogRatios& light,
                         const SurfaceColourParams& surfaces, const ColourModelParams& params);

// A quadrant as the fit sees it.
struct SeenColour {
  CylinderColour colour = CylinderColour::kBlue;  // which it would be
  LogRatios ratios = LogRatios::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the ratios, by the fit
};

// Residuals over their standard deviations, light and saturation at their best: two of each colour,
// and three of the light and the saturation. Their squares tell how unlike these colours are those
// of the surfaces that they would be.
std::vector<double> ColourResiduals(const std::vector<SeenColour>& seen, const LogRatios& light,
                                    const SurfaceColourParams& surfaces,
                                    const ColourModelParams& params);

// The inverse of the symmetric root of a positive definite matrix.
Eigen::Matrix2d WhiteningOf(const Eigen::Matrix2d& covariance);

}  // namespace rockyard::vision
