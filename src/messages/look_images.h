/// @file
/// The two images of a look at the terrain, with their cameras as the rover believes them to be.
/// Navigators that ask for images get them, and so do readers that make range points of them.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose.h"
#include "messages/point_cloud.h"

namespace rockyard::messages {

/// A linear camera (Yakimovsky and Cunningham 1978), told in R:
///
///   column = (p - C) . H / (p - C) . A        row = (p - C) . V / (p - C) . A
///
/// Columns count to the right and rows downwards, from 0 at the centre of the upper left pixel.
struct LinearCamera {
  math::Vector3 C_R = math::Vector3::Zero();   ///< its centre, m
  math::Vector3 A_R = math::Vector3::UnitX();  ///< the unit normal of the image plane
  math::Vector3 H_R = math::Vector3::Zero();   ///< focal length and principal column, pixels
  math::Vector3 V_R = math::Vector3::Zero();   ///< focal length and principal row, pixels
};

/// What one camera took.
struct LookImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey;  ///< width times height, row by row from the upper left
  LinearCamera camera;             ///< calibrated, not where it truly is

  /// Returns the grey of a pixel, which lies inside; nothing checks it.
  std::uint8_t At(int column, int row) const {
    return grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
  }
};

/// What a pair of cameras took at one moment. Imagers with more than 8 bits hand over the highest
/// eight.
struct LookImages {
  std::int64_t number = 0;                          ///< counts every look of the trial from 0
  LookDirection direction = LookDirection::kAhead;  ///< where the rover looked
  LookImage left;
  LookImage right;
};

}  // namespace rockyard::messages
