// Rows of the comparison that are counts: exact predictive laws, on which verdicts depend; only the
// law of one layout, which is shown beside, resamples.
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <map>

#include "statistics/clustered_rate.h"
#include "statistics/compare_rows.h"
#include "statistics/drive_summary.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {
namespace {

bool Contains(const std::vector<truth::TrialOutcome>& outcomes, truth::TrialOutcome outcome) {
  return std::find(outcomes.begin(), outcomes.end(), outcome) != outcomes.end();
}

struct PoolCount {
  std::int64_t count = 0;
  std::int64_t pool = 0;
  double rate() const { return static_cast<double>(count) / static_cast<double>(pool); }
};

// A count against the predictive law of the pool; power is that against a binomial law of the
// alternative rate.
Row CountRow(const PublishedValue& published, const PoolCount& simulated, double alternative) {
  Row row;
  const std::int64_t n = published.sample_size;
  const CountLaw law = PredictiveCountLaw(n, simulated.count, simulated.pool);
  ComparedValue& value = row.value;
  value.published = published;
  value.pool = simulated.pool;
  value.pool_value = simulated.rate();
  value.median = static_cast<double>(CountQuantile(law, 0.5));
  value.interval = {static_cast<double>(CountQuantile(law, 0.025)),
                    static_cast<double>(CountQuantile(law, 0.975))};
  value.p_value = TwoSided(CountTails(law, std::llround(published.value)));
  const CountLaw truth = BinomialLaw(n, std::clamp(alternative, 0.0, 1.0));
  row.power = [law, truth](double level) { return CountPower(law, truth, level); };
  return row;
}

// The alternative for counts other than success, see kAlternativeRateShift.
double TowardsHalf(double rate) {
  return rate < 0.5 ? rate + kAlternativeRateShift : rate - kAlternativeRateShift;
}

// Successes and trials of each layout, where the records tell layouts apart.
std::vector<LayoutCount> Layouts(const PublishedValue& published, const ScenarioRun& run) {
  const std::vector<double> of_trials = LayoutsOf(run.schema, run.records);
  std::map<double, LayoutCount> layouts;
  for (std::size_t i = 0; i < of_trials.size(); ++i) {
    // A number that is none has no place in a map.
    if (IsFault(run.records[i]) || !std::isfinite(of_trials[i])) continue;
    LayoutCount& layout = layouts[of_trials[i]];
    ++layout.trials;
    if (Contains(published.outcomes, run.records[i].outcome)) ++layout.successes;
  }
  std::vector<LayoutCount> counts;
  counts.reserve(layouts.size());
  for (const auto& [layout, count] : layouts) counts.push_back(count);
  return counts;
}

// Compares the count as if all runs of the set met one layout: by repeated trials on layouts where
// there are some, else by bounds over all that is possible.
OneLayout CompareOnOneLayout(const PublishedValue& published, const ScenarioRun& run,
                             const PoolCount& simulated, std::uint64_t seed) {
  const std::int64_t n = published.sample_size;
  const std::int64_t observed = std::llround(published.value);
  const std::vector<LayoutCount> layouts = Layouts(published, run);
  if (!std::isfinite(EstimateLayoutEffect(layouts).correlation)) {
    return {OneLayoutPValueBounds(n, observed, simulated.count, simulated.pool), false};
  }
  const double p_value = TwoSided(CountTails(OneLayoutLaw(n, layouts, seed), observed));
  return {{p_value, p_value}, true};
}

// Every way to divide n failures into the kinds, with its probability.
struct Division {
  std::vector<std::int64_t> counts;
  double probability = 0.0;
};

// Appends all ways to divide what is left among the remaining kinds; the last kind takes the rest.
void Divide(std::int64_t left, std::size_t kinds, std::vector<std::int64_t>& counts,
            std::vector<Division>& divisions) {
  if (counts.size() + 1 == kinds) {
    counts.push_back(left);
    divisions.push_back({counts, 0.0});
    counts.pop_back();
    return;
  }
  for (std::int64_t k = 0; k <= left; ++k) {
    counts.push_back(k);
    Divide(left - k, kinds, counts, divisions);
    counts.pop_back();
  }
}

std::vector<Division> AllDivisions(std::int64_t n, std::size_t kinds) {
  std::vector<Division> divisions;
  std::vector<std::int64_t> counts;
  Divide(n, kinds, counts, divisions);
  return divisions;
}

double LogFactorial(std::int64_t n) { return boost::math::lgamma(static_cast<double>(n) + 1.0); }

// Dirichlet-multinomial with Jeffreys' prior: the many-category form of PredictiveCountLaw.
double PredictiveProbability(const std::vector<std::int64_t>& counts,
                             const std::vector<std::int64_t>& simulated) {
  double log_probability = 0.0;
  double weight = 0.0;
  std::int64_t n = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    // P(k) = n!/prod k_i! Gamma(A)/Gamma(A + n) prod Gamma(a_i + k_i)/Gamma(a_i), a_i = simulated
    // count + 1/2, A their sum.
    const double prior = static_cast<double>(simulated[i]) + 0.5;
    log_probability += boost::math::lgamma(prior + static_cast<double>(counts[i])) -
                       boost::math::lgamma(prior) - LogFactorial(counts[i]);
    weight += prior;
    n += counts[i];
  }
  log_probability += LogFactorial(n) + boost::math::lgamma(weight) -
                     boost::math::lgamma(weight + static_cast<double>(n));
  return std::exp(log_probability);
}

double MultinomialProbability(const std::vector<std::int64_t>& counts,
                              const std::vector<double>& shares) {
  double probability = 1.0;
  std::int64_t n = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    n += counts[i];
    // n! prod s_i^k_i / k_i!.
    probability *=
        std::pow(shares[i], static_cast<double>(counts[i])) / std::exp(LogFactorial(counts[i]));
  }
  return probability * std::exp(LogFactorial(n));
}

// Total probability of the divisions that are no more probable than the one given.
double DivisionPValue(const std::vector<Division>& divisions,
                      const std::vector<std::int64_t>& counts) {
  constexpr double kTieTolerance = 1e-7;
  const auto observed = std::find_if(divisions.begin(), divisions.end(),
                                     [&](const Division& d) { return d.counts == counts; });
  if (observed == divisions.end()) return 1.0;
  double p_value = 0.0;
  for (const Division& division : divisions) {
    if (division.probability <= observed->probability * (1.0 + kTieTolerance)) {
      p_value += division.probability;
    }
  }
  return std::min(1.0, p_value);
}

// The commonest kind loses kAlternativeRateShift, the others share it.
std::vector<double> AlternativeShares(const std::vector<std::int64_t>& simulated) {
  double total = 0.0;
  for (const std::int64_t count : simulated) total += static_cast<double>(count) + 0.5;
  std::vector<double> shares;
  shares.reserve(simulated.size());
  for (const std::int64_t count : simulated) {
    shares.push_back((static_cast<double>(count) + 0.5) / total);
  }
  const auto commonest = std::max_element(shares.begin(), shares.end());
  const double moved = std::min(*commonest, kAlternativeRateShift);
  const double each = moved / static_cast<double>(shares.size() - 1);
  for (double& share : shares) share += each;
  *commonest -= moved + each;
  return shares;
}

// Simulated failures of each published kind, then of all other kinds.
std::vector<std::int64_t> FailuresByKind(const PublishedValue& published, const ScenarioRun& run) {
  std::vector<std::int64_t> counts(published.kinds.size() + 1, 0);
  for (const truth::Record& record : run.records) {
    if (IsFault(record) || truth::DeclaredSuccess(record.outcome)) continue;
    const auto kind =
        std::find_if(published.kinds.begin(), published.kinds.end(),
                     [&](const FailureKind& k) { return Contains(k.outcomes, record.outcome); });
    ++counts[static_cast<std::size_t>(kind - published.kinds.begin())];
  }
  return counts;
}

}  // namespace

Row CompareOutcomeCount(const PublishedValue& published, const ScenarioRun& run,
                        const ComparisonOptions& options) {
  PoolCount simulated;
  for (const truth::Record& record : run.records) {
    if (IsFault(record)) continue;
    ++simulated.pool;
    if (Contains(published.outcomes, record.outcome)) ++simulated.count;
  }
  if (simulated.pool == 0) return NotJudged(published, "no simulated trial without a fault");
  const bool success = std::all_of(published.outcomes.begin(), published.outcomes.end(),
                                   [](truth::TrialOutcome o) { return truth::DeclaredSuccess(o); });
  const double alternative =
      success ? simulated.rate() - kAlternativeRateShift : TowardsHalf(simulated.rate());
  Row row = CountRow(published, simulated, alternative);
  row.value.one_layout = CompareOnOneLayout(published, run, simulated, options.seed);
  return row;
}

Row CompareNegativeCount(const PublishedValue& published, const ScenarioRun& run) {
  const auto column = ColumnIndex(run.schema, published.column);
  if (!column) return NotJudged(published, "the trials have no column " + published.column);
  const std::vector<double> values = ColumnValues(run.records, *column);
  if (values.empty()) return NotJudged(published, "no finite value of " + published.column);
  const PoolCount simulated{
      std::count_if(values.begin(), values.end(), [](double x) { return x < 0.0; }),
      static_cast<std::int64_t>(values.size())};
  Row row = CountRow(published, simulated, TowardsHalf(simulated.rate()));
  if (const auto law = NegativesByArrival(published, run)) {
    row.value.beside.push_back({ArrivalsName(published),
                                static_cast<double>(CountQuantile(*law, 0.5)),
                                {static_cast<double>(CountQuantile(*law, 0.025)),
                                 static_cast<double>(CountQuantile(*law, 0.975))},
                                TwoSided(CountTails(*law, std::llround(published.value)))});
  }
  return row;
}

// Kinds of failure given how many runs failed: p is the total probability of the divisions no
// likelier than the published one.
Row CompareFailureKinds(const PublishedValue& published, const ScenarioRun& run) {
  const std::vector<std::int64_t> simulated = FailuresByKind(published, run);
  std::vector<std::int64_t> observed;
  std::int64_t n = 0;
  for (const FailureKind& kind : published.kinds) {
    observed.push_back(kind.count);
    n += kind.count;
  }
  observed.push_back(0);
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  std::int64_t failures = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    failures += simulated[i];
    const bool other = i == published.kinds.size();
    value.kinds.push_back({other ? "other" : published.kinds[i].name, observed[i], simulated[i]});
  }
  value.pool = failures;
  if (failures == 0) value.remark = "no simulated failure";
  std::vector<Division> divisions = AllDivisions(n, observed.size());
  for (Division& d : divisions) d.probability = PredictiveProbability(d.counts, simulated);
  value.p_value = DivisionPValue(divisions, observed);
  const std::vector<double> shares = AlternativeShares(simulated);
  row.power = [divisions, shares](double level) {
    double power = 0.0;
    for (const Division& d : divisions) {
      if (DivisionPValue(divisions, d.counts) <= level) {
        power += MultinomialProbability(d.counts, shares);
      }
    }
    return power;
  };
  return row;
}

}  // namespace rockyard::statistics
