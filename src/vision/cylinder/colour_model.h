// How surfaces look in unknown light, before an unknown camera: FindCylinder (robust_finder.h)
// labels pixels by it, and its fit compares the colours of quadrants with those of the surfaces.
//
// A colour is c = (ln(red / green), ln(blue / green)), which brightness does not move. A surface of
// c_s looks like
//
//   c = light + saturation c_s + noise
//
// `light` is that of an illuminant that scales each primary (von Kries 1902); `saturation` comes
// from crosstalk between the channels, which draws all colours towards grey. Both are unknown but
// for their priors, and the same for all surfaces of an image. Most of an image must be ground, as
// its median tells the light. Records of the experiment on sightings depend on it, on the cells
// that ratios are counted in, too; no drive does.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::vision {

using LogRatios = Eigen::Vector2d;

// Returns the ratios of primaries; primaries below half a grey level count as half a level.
LogRatios LogRatiosOf(const Eigen::Vector3d& primaries);

// Returns the direction of a class's primaries in a given light, of length 1: brightness moves a
// colour along it.
Eigen::Vector3d DirectionOf(CylinderColour colour, const LogRatios& light,
                            const SurfaceColourParams& surfaces, const ColourModelParams& params);

// Return the surface colour of a class, and of the ground.
LogRatios SurfaceOf(CylinderColour colour, const SurfaceColourParams& surfaces);
LogRatios GroundOf(const SurfaceColourParams& surfaces);

// Returns the light in which the median of both images' ratios is that of the ground, cut at twice
// light_sd from white. White where no pixel is bright enough.
LogRatios LightOf(const ColourImage& left, const ColourImage& right,
                  const SurfaceColourParams& surfaces, const ColourModelParams& params);

// Returns the likeliest surface of each pixel: a class, or background where the ground or something
// grey is likelier, where no class is within three standard deviations, or where the pixel is too
// dark.
ClassImage LabelSurfaces(const ColourImage& image, const LogRatios& light,
                         const SurfaceColourParams& surfaces, const ColourModelParams& params);

// The colour of a quadrant in the images, as the fit finds it.
struct SeenColour {
  CylinderColour colour = CylinderColour::kBlue;  // the class that the quadrant should have
  LogRatios ratios = LogRatios::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the ratios, by the fit
};

// Returns residuals over their standard deviations, with light and saturation at their best: two of
// each colour in the order of `seen`, then three of the light and the saturation. Their squares
// tell how much the colours differ from those of the surfaces that they should be.
std::vector<double> ColourResiduals(const std::vector<SeenColour>& seen, const LogRatios& light,
                                    const SurfaceColourParams& surfaces,
                                    const ColourModelParams& params);

// Returns the inverse of the symmetric root of a positive definite matrix.
Eigen::Matrix2d WhiteningOf(const Eigen::Matrix2d& covariance);

}  // namespace rockyard::vision
