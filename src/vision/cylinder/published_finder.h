// The coloured cylinder in a pair of images, as published (Matthies 1995, appendix A).
#pragma once

#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/published_finder_params.h"

namespace rockyard::vision {

// Step by step as A.3 has it, with the orientation of equation 14 and the distances of 15 to 17:
//
//   1. pixels are classified by ratios of their primaries, below the sky;
//   2. gaps of one to four pixels between two colours are filled;
//   3. the largest four-connected region of any colours is the cylinder, whatever its shape;
//   4. in its bounding box the largest region of one colour is the middle, the largest of another
//      colour on either side of it left and right.
//
// Of what the text leaves open: a region lies to the left of the middle one if its centroid does;
// the row of the table follows from the order of the colours (cylinder_equations.h); theta is the
// mean of both eyes'; f stands for M / (2 tan(phi / 2)) and is that of the left camera's middle;
// eyes that are not aligned are triangulated by the point nearest to both lines of sight.
//
// The covariance is that of one-pixel changes times pixel_error_px: equation 19 (the coarser one)
// for theta, 23 along the line of sight and 1 / f across it.
//
// It does not see a second cylinder, nor a region that has the colours and is none: the text has no
// check of it. Such faults stay: it is what rockyard's own finder is compared with. Requires images
// of the size of their cameras. Throws nothing; a pure function.
CylinderFinding FindCylinderAsPublished(const ColourPair& pair, const ColourCylinder& cylinder,
                                        const PublishedFinderParams& params);

}  // namespace rockyard::vision
