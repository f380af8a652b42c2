// New samples of a published size, as a simulated pool predicts them, the pool's own uncertainty
// included, without assuming a distribution family. The comparison with published values judges
// statistics of one column by them.
//
// The N + 1 gaps between the ordered values of a pool of N have probabilities that are
// Dirichlet(1, ..., 1) whatever the continuous law (spacings of uniform order statistics), so the
// gaps that n further values of the same law fall into follow a Polya urn exactly (Hill 1968, A(n);
// for gaps replaced by the values themselves this is Rubin's 1981 Bayesian bootstrap). Unlike plain
// resampling it knows that a real run can fall beyond every simulated one: the smallest of n lies
// below the pool with probability n / (N + n).
// Where a value lies inside its gap is the one assumption: uniform between neighbours; beyond an
// extreme an exponential tail whose mean is known only from the ten outermost values' excesses over
// the eleventh, S in sum: P(excess > e) = (1 + e / S)^-10, cut off at a limit of the support where
// there is one. Conservative at sharp edges, a little optimistic for tails heavier than
// exponential.
//
// Verdicts and exit codes depend on the draws, no record does: of each new value first its gap,
// then its place in it; of a replicate part after part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/random.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {

class PredictiveSampler {
 public:
  // Needs two finite values or more; others are left out. No draw lies below `lower_limit` unless
  // the pool itself does.
  explicit PredictiveSampler(std::span<const double> pool,
                             double lower_limit = -std::numeric_limits<double>::infinity());

  // Draws n new values in ascending order, into `sample`. Cost: n log n.
  void Draw(core::RandomStream& stream, std::span<double> sample) const;

  std::span<const double> pool() const { return pool_; }

 private:
  double InGap(core::RandomStream& stream, std::size_t gap) const;

  std::vector<double> pool_;   // ascending
  double lower_room_ = 0.0;    // from the pool's lower end to the limit
  double lower_excess_ = 0.0;  // sum of the outermost excesses at the lower end
  double upper_excess_ = 0.0;
};

// A statistic of an ascending sample.
using SampleStatistic = std::function<double(std::span<const double>)>;

// Draws `replicates` samples of size n and returns the statistic of each, in order of replicates.
// Randomness: Philox keyed by (seed, key, Purpose::kBootstrap, replicate).
std::vector<double> PredictiveStatistics(const PredictiveSampler& sampler, std::size_t n,
                                         const SampleStatistic& statistic, std::size_t replicates,
                                         core::TrialKey key);

// A part of a sample: n values of one sampler, which must outlive it.
struct SamplePart {
  const PredictiveSampler* sampler = nullptr;
  std::size_t n = 0;
};

// Returns the same for samples that are put together from parts of fixed sizes, e.g. of runs that
// arrived and of runs that did not. The statistic sees all parts together, in ascending order.
std::vector<double> PredictiveStatistics(std::span<const SamplePart> parts,
                                         const SampleStatistic& statistic, std::size_t replicates,
                                         core::TrialKey key);

// Returns the two-sided p-value of a published value v that was rounded to a multiple of
// `rounding`: twice the smaller share of replicates at or beyond it, the published set counted as
// one more replicate. Values that would round to v count on both sides. `ascending` are the
// replicates.
double PredictivePValue(std::span<const double> ascending, double value, double rounding);

// Returns the chance that a published sample from the pool's law shifted by +shift or by -shift,
// whichever is harder to see, is rejected at `level` by PredictivePValue, for a statistic that
// moves with its sample.
double ShiftPower(std::span<const double> ascending, double shift, double level);

// Returns the same chance for a sample whose distances from `limit`, a limit of the support, are
// multiplied or divided by `factor`, whichever is harder to see, for a statistic that moves with
// them.
double ScalePower(std::span<const double> ascending, double limit, double factor, double level);

}  // namespace rockyard::statistics
