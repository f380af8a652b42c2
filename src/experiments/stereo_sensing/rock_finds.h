// Rocks and cells of the map of one look against those with perfect matches.
#pragma once

#include "experiments/stereo_sensing/stereo_sensing_params.h"
#include "experiments/stereo_sensing/stereo_sums.h"
#include "messages/navigation_view.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_view.h"
#include "terrain/terrain.h"

namespace rockyard::experiments {

// The maps of one look, in R: with perfect matches of all that both eyes see, and with its own.
struct LookMaps {
  const messages::MapView& perfect;
  const messages::MapView& seen;
};

// The cell of distances from the left camera.
struct DistanceBin {
  double nearest_m = 0.0;
  double farthest_m = 0.0;  // not included

  bool Holds(double distance_m) const { return distance_m >= nearest_m && distance_m < farthest_m; }
};

// Adds the rocks in view whose visible part lies, on average, within the bin. A rock is found where
// the map calls a hazard the cell that holds the middle of its visible part.
void AddRocksInView(const StereoSensingParams& params, const terrain::Terrain& terrain,
                    const sensing::StereoTruth& truth, const sensing::StereoView& view_R,
                    const LookMaps& maps, const DistanceBin& bin, StereoSums& sums);

// Adds the cells of the map whose middle, on the ground, lies within the bin.
void AddCellsOfMap(const StereoSensingParams& params, const sensing::StereoView& view_R,
                   const LookMaps& maps, const DistanceBin& bin, StereoSums& sums);

}  // namespace rockyard::experiments
