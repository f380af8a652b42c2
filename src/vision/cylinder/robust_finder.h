// rockyard's own way to find the coloured cylinder in a pair of images, with the two improvements
// that Matthies 1995, section 5, proposes: a more robust segmentation and colours as a setting. For
// `rockyard cylinder` and the experiment on sightings. Records of that experiment depend on all
// that it computes, ties and order of sums included. Drives do not run it: the lander's law of
// fixes in drives was fitted to what finders see in rendered views.
#pragma once

#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::vision {

// Finds the cylinder in three steps:
//
//   1. Pixels are labelled by the likeliest surface in the light that the ground tells
//      (colour_model.h). Regions of labelled pixels are paired between the eyes by size, rows and
//      depth (FindCandidates).
//   2. For each pair of regions, position and theta are fitted to the pixels of both eyes at once
//      (cylinder_fit.h), from all orientations. The colours of the quadrants come from the image
//      and are compared with those of the surfaces.
//   3. A pair is the cylinder if model, colours, radius and height fit, no other orientation does,
//      and no other pair does. Everything else is a miss with its reason.
//
// The cylinder is taken as standing along ColourCylinder::axis_L but for a small lean to a side of
// the image; it may be seen from above or below as long as some rows show the wall from side to
// side (up to some 40 deg for the cylinder of the paper). distance_by_stereo_m and
// distance_by_size_m come from a fit whose radius is free; the position uses both. Requires images
// of the size of their cameras. Throws nothing.
CylinderFinding FindCylinder(const ColourPair& pair, const ColourCylinder& cylinder,
                             const RobustFinderParams& params);

}  // namespace rockyard::vision
