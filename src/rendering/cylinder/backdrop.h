// Ground, hills and sky behind everything, line by line.
#pragma once

#include <vector>

#include "core/random.h"
#include "rendering/cylinder/colour_light.h"
#include "rendering/cylinder/colour_planes.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/lattice_texture.h"
#include "vision/cameras/cahv.h"

namespace rockyard::rendering {

// A level ground up to the hills, an upright wall across the view at horizon_distance_m whose edge
// is the horizon, and an even sky. For cameras with level lines every line of the image meets
// either plane along a line across the view. The pixel that holds the horizon is mixed by the share
// of its height. Hills are lit as slopes of 60 deg that face the cameras. For one thread.
class Backdrop {
 public:
  Backdrop(const BackdropParams& params, const ColourLight& light, core::TrialKey key);

  void Fill(const vision::Cahv& camera, ColourPlanes& planes);

  // The height of the horizon across the view, m above the ground.
  double HorizonHeight(double y_m) const;

 private:
  void FillRow(const vision::Cahv& camera, int row, ColourPlanes& planes);
  void Mottle(const TextureLine& line, const Colour& colour, int row, ColourPlanes& planes);
  void MixSky(const vision::Cahv& camera, int row, ColourPlanes& planes);

  BackdropParams params_;
  Colour ground_;
  Colour hills_;
  Colour sky_;
  LatticeTexture texture_;
  std::vector<float> relief_;  // of the horizon, by node, unit variance
  std::vector<float> brightness_;
  std::vector<float> hue_;
};

}  // namespace rockyard::rendering
