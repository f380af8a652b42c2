// Light that a scene gets beside the sun's.
#pragma once

#include "rendering/rendered_row.h"
#include "rendering/surface_point.h"

namespace rockyard::rendering {

// Lamps whose light a renderer adds to that of the sun, each apart, so that a read-out can have
// them on or off.
class Lamps {
 public:
  virtual ~Lamps() = default;

  // Appends to row.lamps what each lamp adds to a pixel, or a part of one, whose two edges look at
  // `left` and `right`. The pixel counts from the first column of the line; `gain` is its electrons
  // per second for one W/m2/sr. Nothing falls on points that do not take a lamp's light.
  virtual void Add(const SurfacePoint& left, const SurfacePoint& right, int pixel, double gain,
                   RenderedRow& row) const = 0;
};

}  // namespace rockyard::rendering
