// Ground, hills and sky behind everything in the images of the coloured cylinder, line by line.
// Only the study of cylinder finders depends on its draws and bits; drives do not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_params.h"
#include "vision/cameras/cahv.h"

namespace rockyard::rendering {

// A line of pixels on a plane with coordinates (u, v), m: u is constant, v = first_v + k step_v.
struct TextureLine {
  double u_m = 0.0;
  double first_v_m = 0.0;
  double step_v_m = 0.0;  // not 0
  double footprint_u_m = 0.0;
};

// Value noise in octaves. Octave j lies on a lattice of spacing s_j = 4 mm 2^j and interpolates
// normal numbers of its nodes (PixelNoise by node, substream j) linearly along both axes. A line
// takes the octaves with spacings between 2 and 32 of its pixels' width |step_v|, the first and the
// last faded. Octaves finer than the footprint along u are weakened by the root of s / footprint_u,
// as the mean of independent cells is. Cost: 5 ns a pixel.
class LatticeTexture {
 public:
  explicit LatticeTexture(core::TrialKey key) : key_(key) {}

  // Adds `deviation` times noise of about unit variance to every value of the line.
  void AddTo(const TextureLine& line, double deviation, std::span<float> values);
  // Does so with that octave alone.
  void AddOctave(const TextureLine& line, int octave, double deviation, std::span<float> values);

  static double SpacingOf(int octave);

 private:
  core::TrialKey key_;
  std::vector<float> nodes_;
};

// A level ground up to the hills, and an even sky. The hills are an upright wall across the view at
// horizon_distance_m, whose edge is the horizon. With level cameras every line of the image meets
// either plane along a line across the view. A pixel that holds the horizon is mixed by the share
// of its height. Hills are lit as slopes of 60 deg that face the cameras. For one thread.
class Backdrop {
 public:
  Backdrop(const BackdropParams& params, const ColourLight& light, core::TrialKey key);

  void Fill(const vision::Cahv& camera, ColourPlanes& planes);

  // Returns the height of the horizon at y_m across the view, m above the ground.
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
