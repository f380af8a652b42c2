// Which regions of both eyes may be the coloured cylinder: by size, shape and depth.
#pragma once

#include <string>
#include <vector>

#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/robust_finder_params.h"
#include "vision/cylinder/sight_lines.h"

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

}  // namespace rockyard::vision
