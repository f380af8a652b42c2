// Candidates for the coloured cylinder among regions of both eyes, and its fit to pixels: steps 1
// and 2 of FindCylinder (robust_finder.h). Records of the experiment on sightings depend on the
// order of candidates and starts, which decides ties, and on where descents end; no drive depends
// on it.
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

// A region as both eyes see it: a candidate. The boxes leave out rows and columns that have few of
// the region's pixels.
struct RegionPair {
  ColourRegion left;
  ColourRegion right;
  SeenPoint point;  // that both eyes see in the middles of the boxes
};

struct CandidateSearch {
  std::vector<RegionPair> pairs;
  // Why there are no pairs, if there are none.
  CylinderMiss miss = CylinderMiss::kNothing;
  std::string reason;
};

// Returns all pairs of regions that have the cylinder's shape in either eye, that lie on lines of
// sight which meet in front of the cameras, and that have the cylinder's width and height at their
// depth.
CandidateSearch FindCandidates(const ColourPair& pair, const EyeGeometry& eyes,
                               const ColourCylinder& cylinder, const ClassImage& left,
                               const ClassImage& right, const CandidateParams& params);

struct CylinderFit {
  CylinderPlace place;
  double cost = 0.0;           // sum of all squared residuals
  double misfit = 0.0;         // mean squared residual of the pixels
  double colour_misfit = 0.0;  // sum of the squared residuals of the colours
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

// Fits position and orientation of the cylinder by least squares over the pixels of both eyes.
// Unknown are the place across and along the view, theta, the roll, the blur of edges, and the
// radius where it is free; the colours of the quadrants are solved for inside (wall_colours.h:
// variable projection, Golub and Pereyra 1973). All orientations are tried in steps of 7.5 deg, and
// the best local minima refined (DescendFrom): first in the candidate's boxes, then in the boxes of
// the wall that was found. The differences between the quadrants' colours and those of the surfaces
// (colour_model.h) are part of the least squares: an edge in a wrong place mixes colours that no
// surface has. Returns nothing where no orientation can be imaged.
std::optional<CylinderFit> FitCylinder(const ColourPair& pair, const EyeGeometry& eyes,
                                       const ColourCylinder& cylinder, const RegionPair& candidate,
                                       const LogRatios& light, const RobustFinderParams& params);

}  // namespace rockyard::vision
