// rockyard's own way to find the coloured cylinder in a pair of images: the two improvements that
// Matthies 1995, section 5, proposes, a more robust segmentation and colours as a setting. Drives
// do not run it: the lander's law of fixes in them was fitted to what finders see in rendered
// views.
#pragma once

#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::vision {

//   1. Pixels are labelled by which surface is likelier in the light that the ground tells
//      (colour_model.h), and regions of them paired between the eyes by size, rows and depth
//      (FindCandidates).
//   2. Of each pair of regions, position and theta are fitted to the pixels of both eyes at once
//      (cylinder_fit.h), from all orientations; the colours of the quadrants come from the image
//      and are then held against those of the surfaces.
//   3. It is the cylinder if model, colours, radius and height fit, no other orientation does, and
//      no other region does. Everything else is a miss with its reason.
//
// The cylinder is taken as standing along ColourCylinder::axis_L but for a small lean to a side of
// the image; it may be seen from above or below as long as some rows show the wall from side to
// side (some 40 deg for that of the paper). distance_by_stereo_m and distance_by_size_m are those
// of a fit whose radius is free; the position uses both. Requires images of the size of their
// cameras. Throws nothing; a pure function. Cost: the figures are in src/vision/README.md.
CylinderFinding FindCylinder(const ColourPair& pair, const ColourCylinder& cylinder,
                             const RobustFinderParams& params);

}  // namespace rockyard::vision
