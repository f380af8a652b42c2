// Where a scanline meets a light plane, for lenses whose scanlines are no planes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/camera.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// An image row sees a curved surface; with the light plane n . (p - e) = 0 it has the curve
//   p(c) = o + ray(c) n . (e - o) / n . ray(c)
// in common, o the camera, ray(c) the viewing ray of column c (vision/lens.h). The curve is
// followed by chords between points on it, from the image border near the emitter down to the
// lowest searched elevation. Chords lie in the light plane; a point on one lies less than
// kChordError_m off the curve, by which the row that sees it differs from the scanline, not its
// column.
class ScanCurve {
 public:
  // A tenth of what a pixel of the published sensor resolves at 30 cm.
  static constexpr double kChordError_m = 0.0002;

  // The curve is empty where no column of the camera sees the light plane above the lowest searched
  // elevation. Cost: one viewing ray per column.
  ScanCurve(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe);

  // Returns the columns of the elevations between search_low and search_high, within the image.
  messages::ColumnRange searched() const { return searched_; }

  // Returns the first surface along the chords, in W, with the rover at X_WR; none where the curve
  // ends first. Cost: one ray query a chord.
  std::optional<math::Vector3> FirstHit(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR,
                                        std::span<const int> rocks) const;

  // Returns the ends of the chords, in R, from the emitter's side downwards.
  const std::vector<math::Vector3>& vertices() const { return vertices_R_; }

 private:
  std::vector<math::Vector3> vertices_R_;
  messages::ColumnRange searched_;
};

}  // namespace rockyard::sensing
