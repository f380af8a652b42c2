// The marked reference field of a law of Mars: which rocks a field gets, and in which order. Fields
// of one reference, seed and trial nest by it. Records depend on its streams: kRockCount,
// kRockMark and kRockSize, substream i for rock i; kRockCluster, substream 0 for the number of
// clusters, 1 + j for the middle of cluster j.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Returns the substreams of the field's rocks in the order in which they appear as its law's k or
// cover grows: the field of a smaller one is a prefix of that of a larger one. A rock of diameter D
// and mark u, uniform, belongs to the field where u < n(D) / n_ref(D), n the densities of the
// field and of its reference: thinning, so that the field is again a Poisson one, with n. For
// Moore's law the ratio is that of the k at every diameter. The random rocks must follow a law.
std::vector<std::uint32_t> RocksOfField(const TerrainParams& params, core::TrialKey key);

// The clusters of a field with clusters_per_m2 c: the process of Thomas 1949 (Biometrika 36) on
// the layout area as a torus, so that rocks are expected as often everywhere. Their number is
// Poisson, their middles are uniform, each has a Poisson number of rocks with the mean
// RocksPerM2 / c, and these lie about the middle by a normal law of cluster_radius_m along x and
// along y. The clusters are those of the reference field: thinning one leaves clusters of fewer
// rocks, so that fields nest with clusters as without. Counts in a part B of the area have the
// mean n |B| and the variance n |B| + n^2 / c times the double integral over B of the normal
// density of standard deviation sqrt(2) cluster_radius_m at the difference of two places.
class RockClusters {
 public:
  RockClusters(const TerrainParams& params, core::TrialKey key);

  std::uint32_t number() const { return number_; }
  // Returns the place of a rock: about a cluster drawn anew by every call. There must be clusters.
  CoursePoint Draw(core::RandomStream& stream) const;

 private:
  core::TrialKey key_;
  Rectangle area_;
  double radius_m_;
  std::uint32_t number_;
};

// Returns the cover, at most cover_reference, at which n(D) of Golombek and Rapp's law is `mark`
// times that of cover_reference; 0 < mark < 1.
double CoverOfMark(double mark, double diameter_m, double cover_reference);

}  // namespace rockyard::terrain
