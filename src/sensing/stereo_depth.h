// What the left camera of a stereo pair meets, and what of it the right one does not see.
#pragma once

#include <vector>

#include "sensing/stereo_view.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// One over the depth Z of the first surface on each pixel's ray (StereoView::Ray), 1/m, row by row;
// 0 where there is none within max_range_m of the eye. The view is one in W.
std::vector<double> InverseDepths(const terrain::Terrain& terrain, const StereoView& view_W,
                                  double max_range_m);

// Sets to 0 what lies outside the right image, or behind something else there.
void HideFromRightEye(const terrain::Terrain& terrain, const StereoView& view_W,
                      std::vector<double>& inverse_depths);

}  // namespace rockyard::sensing
