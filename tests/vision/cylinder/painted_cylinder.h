// Plain pictures of coloured cylinders, by rays through parts of pixels: independent of the code
// under test but for the cameras.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::vision {

using PaintColour = Eigen::Vector3d;  // red, green, blue; 1 is white

// Section 5 of Matthies 1995: level cameras of 512 x 480 pixels, 29.33 deg wide, 12 cm apart, the
// left one in the origin of L, which has x forward, y left and z up.
struct PaintedCameras {
  CameraModel left;
  CameraModel right;
  double focal_px = 0.0;
};
PaintedCameras LevelCameras();

// The same, turned down about their centres.
PaintedCameras CamerasLookingDown(double pitch_rad);

struct PaintedCylinder {
  math::Vector3 p_LT_L = {3.0, -0.06, -0.1};  // m
  double orientation_rad = 0.0;               // azimuth in T of the middle between LevelCameras
  double lean_rad = 0.0;                      // of its axis to the right of the image
  ColourCylinder size = {};
};

struct PaintedScene {
  std::vector<PaintedCylinder> cylinders = {PaintedCylinder{}};
  // Quadrants A to D.
  std::array<PaintColour, 4> quadrants = {
      PaintColour{0.12, 0.30, 0.85}, PaintColour{0.95, 0.25, 0.60}, PaintColour{1.00, 0.35, 0.10},
      PaintColour{0.95, 0.25, 0.60}};
  PaintColour top = {0.30, 0.28, 0.26};
  PaintColour ground = {0.45, 0.27, 0.16};
  double ground_texture = 0.0;  // standard deviation, over the level, of patches of 3 x 3 pixels
  PaintColour light = {1, 1, 1};
  double diffuse = 1.0;          // share of the light that comes from everywhere
  double sun_azimuth_rad = 0.0;  // from the viewer's direction, counter-clockwise seen from above
  double crosstalk = 0.0;        // of a primary to each of the two others
  double exposure = 200.0;       // grey levels of 1
  double pitch_rad = 0.0;        // by which the cameras look down
  double noise_grey = 0.0;
  int rays = 4;  // a side of a pixel, where a cylinder is
  std::uint64_t seed = 1;
};

struct PaintedPair {
  ColourImage left;
  ColourImage right;
  PaintedCameras cameras;

  ColourPair Pair() const { return {left, right, cameras.left, cameras.right}; }
  ColourPair Swapped() const { return {right, left, cameras.left, cameras.right}; }
};

PaintedPair Paint(const PaintedScene& scene);

// The picture with each primary blurred by a standard deviation of one pixel, as binomials do it.
ColourImage Blurred(const ColourImage& image);

// A scene with one cylinder whose middle is `distance_m` before the middle of the cameras.
PaintedScene SceneAt(double distance_m, double orientation_rad);

// The same with the cameras above the cylinder and turned towards it: `distance_m` is along their
// axis.
PaintedScene SceneFromAbove(double distance_m, double orientation_rad, double pitch_rad);

}  // namespace rockyard::vision
