// Candidates for the coloured cylinder among regions of both eyes, and its fit to pixels.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/robust_finder_params.h"
#include "vision/cylinder/wall_colours.h"

namespace rockyard::vision {

// One region as both eyes see it; boxes without the rows and columns that stray pixels add.
struct RegionPair {
  ColourRegion left;
  ColourRegion right;
  SeenPoint point;  // of the middles of both boxes
};

struct CandidateSearch {
  std::vector<RegionPair> pairs;
  // Where there are none: why.
  CylinderMiss miss = CylinderMiss::kNothing;
  std::string reason;
};

// All pairs of regions with the cylinder's shape in either eye, on one another's lines of sight,
// in front of the cameras and, at their depth, of its width and height.
CandidateSearch FindCandidates(const ColourPair& pair, const EyeGeometry& eyes,
                               const ColourCylinder& cylinder, const ClassImage& left,
                               const ClassImage& right, const CandidateParams& params);

// Position and orientation of the cylinder by least squares over the pixels of both eyes.
//
// Unknown are the place across and along the view, theta, the roll, the blur of edges, and the
// radius where it is free; the colours of the quadrants are solved for inside (wall_colours.h:
// variable projection, Golub and Pereyra 1973). All orientations are tried in steps of 7.5 deg, and
// the best local minima refined (DescendFrom): first in the candidate's boxes, then in those of
// the wall that was found. What the quadrants' colours tell against the surfaces' (colour_model.h)
// is part of the least squares: an edge that leaves a quadrant too narrow or too wide mixes colours
// that none has.

struct CylinderFit {
  CylinderPlace place;
  double cost = 0.0;           // all squared residuals
  double misfit = 0.0;         // mean squared residual of the pixels
  double colour_misfit = 0.0;  // the squared residuals of the colours
  // By how much the cost of the best other orientation, more than 25 deg away, is larger.
  double margin = 0.0;
  // Of the place across (m), its depth (m), theta and roll (rad), from the derivatives and the
  // residuals.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  // With the radius free: the depth along the left camera's axis, the radius over the true one and
  // its standard deviation.
  double free_depth_m = 0.0;
  double radius_ratio = 1.0;
  double radius_ratio_sd = 0.0;
  double height_m = 0.0;  // by the rims
  double blur_px = 0.0;   // of edges, a standard deviation
};

// Nothing where no orientation can be imaged.
std::optional<CylinderFit> FitCylinder(const ColourPair& pair, const EyeGeometry& eyes,
                                       const ColourCylinder& cylinder, const RegionPair& candidate,
                                       const LogRatios& light, const RobustFinderParams& params);

}  // namespace rockyard::vision
