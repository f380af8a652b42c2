#include "terrain/marked_field.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/functions.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

using core::Purpose;
using core::RandomStream;

// A rock of the reference field; it belongs to every field whose cover, or share of the reference's
// k, is above `from`.
struct MarkedRock {
  double from;
  std::uint32_t substream;
};

// Returns the mean number of rocks of the reference field; with clusters, given their number.
double ReferenceMean(const TerrainParams& params, core::TrialKey key) {
  const double per_m2 = params.rocks.ReferenceRocksPerM2();
  if (params.rocks.clusters_per_m2 == 0.0) return per_m2 * params.LayoutArea();
  return per_m2 / params.rocks.clusters_per_m2 * RockClusters(params, key).number();
}

// Returns the number moved into [low, high) by whole widths.
double Wrapped(double value, double low, double high) {
  const double width = high - low;
  return value - width * std::floor((value - low) / width);
}

}  // namespace

RockClusters::RockClusters(const TerrainParams& params, core::TrialKey key)
    : key_(key), area_(LayoutBounds(params)), radius_m_(params.rocks.cluster_radius_m) {
  RandomStream stream(key, Purpose::kRockCluster);
  number_ = static_cast<std::uint32_t>(
      core::SamplePoisson(stream, params.rocks.clusters_per_m2 * area_.Area()));
}

CoursePoint RockClusters::Draw(RandomStream& stream) const {
  const auto cluster = static_cast<std::uint32_t>(stream.Uniform() * number_);
  RandomStream middle(key_, Purpose::kRockCluster, 1 + cluster);
  const double x_m = core::SampleUniform(middle, area_.x_min_m, area_.x_max_m);
  const double y_m = core::SampleUniform(middle, area_.y_min_m, area_.y_max_m);
  const double dx_m = core::SampleNormal(stream, 0.0, radius_m_);
  const double dy_m = core::SampleNormal(stream, 0.0, radius_m_);
  return {Wrapped(x_m + dx_m, area_.x_min_m, area_.x_max_m),
          Wrapped(y_m + dy_m, area_.y_min_m, area_.y_max_m)};
}

double CoverOfMark(double mark, double diameter_m, double cover_reference) {
  // n is in proportion to (1.79 k + 0.152) exp(-0.152 D / k) at a diameter. Its logarithm is
  // concave and grows in k, so that Newton's steps from below never pass the root.
  const double decay_m = 0.152 * diameter_m;
  const auto log_density = [decay_m](double cover) {
    return math::Log(1.79 * cover + 0.152) - decay_m / cover;
  };
  const double wanted = math::Log(mark) + log_density(cover_reference);
  // Below the root: the first factor is at most that of the reference.
  double cover = 1.0 / (1.0 / cover_reference - math::Log(mark) / decay_m);
  constexpr int kMaxSteps = 100;
  constexpr double kTolerance = 1e-9;  // the step after it is of its square
  for (int i = 0; i < kMaxSteps; ++i) {
    const double step =
        (wanted - log_density(cover)) / (1.79 / (1.79 * cover + 0.152) + decay_m / (cover * cover));
    cover += step;
    if (step < kTolerance * cover) break;
  }
  return std::min(cover, cover_reference);
}

std::vector<std::uint32_t> RocksOfField(const TerrainParams& params, core::TrialKey key) {
  const RockFieldParams& rocks = params.rocks;
  RandomStream counts(key, Purpose::kRockCount);
  const auto reference_count =
      static_cast<std::uint32_t>(core::SamplePoisson(counts, ReferenceMean(params, key)));
  const std::unique_ptr<RockSizeLaw> law = MakeReferenceSizeLaw(rocks);
  const bool moore = rocks.RandomKind() == RockFieldKind::kMoore;
  // No rock of a mark above this belongs to the field, whatever its diameter: the ratio of
  // Golombek and Rapp's densities is greatest for the smallest rocks.
  const double kept_share = moore
                                ? rocks.k_per_m2 / rocks.k_reference_per_m2
                                : GolombekDensity(rocks.cover, rocks.min_diameter_m) /
                                      GolombekDensity(rocks.cover_reference, rocks.min_diameter_m);
  std::vector<MarkedRock> kept;
  for (std::uint32_t i = 0; i < reference_count; ++i) {
    const double mark = RandomStream(key, Purpose::kRockMark, i).Uniform();
    if (mark >= kept_share) continue;
    if (moore) {
      kept.push_back({mark, i});
      continue;
    }
    // The size that the layout will draw.
    const double diameter_m = law->Diameter(RandomStream(key, Purpose::kRockSize, i).Uniform());
    const double from = CoverOfMark(mark, diameter_m, rocks.cover_reference);
    if (from < rocks.cover) kept.push_back({from, i});
  }
  std::sort(kept.begin(), kept.end(),
            [](const MarkedRock& a, const MarkedRock& b) { return a.from < b.from; });
  std::vector<std::uint32_t> substreams;
  substreams.reserve(kept.size());
  for (const MarkedRock& rock : kept) substreams.push_back(rock.substream);
  return substreams;
}

}  // namespace rockyard::terrain
