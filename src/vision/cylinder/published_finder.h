// The coloured cylinder in a pair of images, as published (Matthies 1995, appendix A), for
// `rockyard cylinder` and the experiment on sightings. Records of that experiment depend on it; no
// drive runs it.
#pragma once

#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/published_finder_params.h"

namespace rockyard::vision {

// Finds the cylinder step by step as A.3 does, with the orientation of equation 14 and the
// distances of equations 15 to 17:
//
//   1. pixels are classified by ratios of their primaries, below the sky;
//   2. gaps of one to four pixels between two colours are filled;
//   3. the largest four-connected region of any colours is the cylinder, whatever its shape;
//   4. in its bounding box the largest region of one colour is the middle, the largest of another
//      colour on either side of it left and right.
//
// The text leaves some choices open. Here a region lies to the left of the middle one if its
// centroid does; the row of the table follows from the order of the colours (cylinder_equations.h);
// theta is the mean of both eyes; f stands for M / (2 tan(phi / 2)) and is taken in the middle of
// the left image; eyes that are not aligned are triangulated by the point nearest to both lines of
// sight.
//
// The covariance comes from changes by pixel_error_px: equation 19 (the coarser one) for theta,
// equation 23 along the line of sight and 1 / f across it.
//
// Must stay with its faults, as rockyard's own finder is compared with it: as in the text, nothing
// checks for a second cylinder or for other things of these colours. Requires images of the size of
// their cameras. Throws nothing.
CylinderFinding FindCylinderAsPublished(const ColourPair& pair, const ColourCylinder& cylinder,
                                        const PublishedFinderParams& params);

}  // namespace rockyard::vision
