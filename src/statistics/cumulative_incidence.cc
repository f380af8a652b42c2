#include "statistics/cumulative_incidence.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "core/check.h"
#include "core/numbers.h"

namespace rockyard::statistics {
namespace {

// Interval of a probability on the log(-log) scale, which keeps it inside [0, 1]: p^exp(+-z s / (p
// |ln p|)), s the standard error of p (delta method).
Interval LogLogBand(double probability, double standard_error, double z) {
  const double log_p = std::log(probability);
  const double spread = z * standard_error / (probability * std::abs(log_p));
  return {std::exp(log_p * std::exp(spread)), std::exp(log_p * std::exp(-spread))};
}

// Sums over past steps that give the variance of the incidence F at any later step without going
// back: with a_i = d_i / (n_i (n_i - d_i)) and c_i = S_i (d1_i / n_i^2), Var F = sum (F - F_i)^2
// a_i + sum S_i^2 (n_i - d1_i) d1_i / n_i^3 - 2 sum (F - F_i) c_i.
class IncidenceVariance {
 public:
  void Add(double incidence, double survival_before, double at_risk, double events, double ends) {
    if (at_risk > ends) {
      const double a = ends / (at_risk * (at_risk - ends));
      a_ += a;
      aF_ += a * incidence;
      aFF_ += a * incidence * incidence;
    }
    own_ += survival_before * survival_before * (at_risk - events) * events /
            (at_risk * at_risk * at_risk);
    const double c = survival_before * events / (at_risk * at_risk);
    c_ += c;
    cF_ += c * incidence;
  }

  double At(double incidence) const {
    const double variance = incidence * incidence * a_ - 2.0 * incidence * aF_ + aFF_ + own_ -
                            2.0 * (incidence * c_ - cF_);
    return std::max(0.0, variance);
  }

 private:
  double a_ = 0.0;
  double aF_ = 0.0;
  double aFF_ = 0.0;
  double own_ = 0.0;
  double c_ = 0.0;
  double cF_ = 0.0;
};

// Returns Clopper and Pearson's interval of `share` times both numbers, rounded outwards.
Interval ExactBand(std::int64_t events, std::int64_t all, double share, double confidence) {
  const double whole = std::ceil(share * static_cast<double>(all));
  const double count = whole * static_cast<double>(events) / static_cast<double>(all);
  const auto exact = [&](double rounded) {
    return ProportionInterval(std::llround(rounded), std::llround(whole), confidence,
                              IntervalMethod::kClopperPearson);
  };
  return {exact(std::floor(count)).low, exact(std::ceil(count)).high};
}

// Returns the band of a step after something was censored. Where none or all of the others have had
// the event there is no variance to go by, and the band is Clopper and Pearson's interval of their
// count.
Interval CensoredBand(const IncidenceStep& step, std::int64_t followed, double share,
                      double confidence) {
  constexpr double kRounding = 1e-9;  // of sums of shares
  if (step.event > kRounding && step.event < 1.0 - kRounding) {
    const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
    return LogLogBand(step.event, step.standard_error, z);
  }
  return followed == 0 ? Interval{0.0, 1.0}
                       : ExactBand(step.event > 0.5 ? followed : 0, followed, share, confidence);
}

struct Ends {
  double events = 0.0;
  double competing = 0.0;
  std::size_t all = 0;  // censored ones included
};

// Counts what ends at one distance, by kind.
Ends EndsAt(std::span<const Duration> sorted, std::size_t first) {
  Ends ends;
  for (std::size_t i = first; i < sorted.size() && sorted[i].at == sorted[first].at; ++i) {
    ++ends.all;
    if (sorted[i].kind == EndKind::kEvent) ends.events += 1.0;
    if (sorted[i].kind == EndKind::kCompeting) ends.competing += 1.0;
  }
  return ends;
}

// What has ended so far.
struct EndCounts {
  std::int64_t all = 0;
  std::int64_t events = 0;
  std::int64_t competing = 0;
  std::int64_t censored = 0;
};

// Completes a step. Without censoring so far both incidences are shares of all, which replace the
// sums of shares and their rounding.
void CompleteStep(const EndCounts& counts, double share, double confidence, IncidenceStep& step) {
  if (counts.censored > 0) {
    step.band = CensoredBand(step, counts.all - counts.censored, share, confidence);
    return;
  }
  const auto all = static_cast<double>(counts.all);
  step.event = static_cast<double>(counts.events) / all;
  step.competing = static_cast<double>(counts.competing) / all;
  step.standard_error = std::sqrt(step.event * (1.0 - step.event) / (share * all));
  step.band = ExactBand(counts.events, counts.all, share, confidence);
}

}  // namespace

std::vector<IncidenceStep> CumulativeIncidence(std::span<const Duration> durations,
                                               double confidence, double share) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  std::vector<Duration> sorted;
  std::copy_if(durations.begin(), durations.end(), std::back_inserter(sorted),
               [](const Duration& d) { return !std::isnan(d.at); });
  std::sort(sorted.begin(), sorted.end(),
            [](const Duration& a, const Duration& b) { return a.at < b.at; });
  std::vector<IncidenceStep> steps;
  EndCounts counts{.all = static_cast<std::int64_t>(sorted.size())};
  IncidenceVariance variance;
  double survival = 1.0;
  double event = 0.0;
  double competing = 0.0;
  for (std::size_t i = 0; i < sorted.size();) {
    const Ends ends = EndsAt(sorted, i);
    const std::size_t at_risk = sorted.size() - i;
    const double n = static_cast<double>(at_risk);
    const double both = ends.events + ends.competing;
    counts.events += static_cast<std::int64_t>(ends.events);
    counts.competing += static_cast<std::int64_t>(ends.competing);
    // A step at every distance at which something ended; censored ones only leave.
    if (both > 0.0) {
      // Aalen and Johansen: to have survived so far, times the share of those at risk that end this
      // way.
      event += survival * ends.events / n;
      competing += survival * ends.competing / n;
      variance.Add(event, survival, n, ends.events, both);
      // Kaplan and Meier's factor, of both kinds of end; censored ones only leave the risk set.
      survival *= 1.0 - both / n;
      steps.push_back({sorted[i].at,
                       event,
                       competing,
                       std::sqrt(variance.At(event) / share),
                       {},
                       static_cast<std::int64_t>(at_risk)});
      CompleteStep(counts, share, confidence, steps.back());
    }
    // Those that are censored at the distance of an end leave after it.
    counts.censored += static_cast<std::int64_t>(ends.all) - static_cast<std::int64_t>(both);
    i += ends.all;
  }
  return steps;
}

std::vector<Duration> GoalDurations(std::span<const truth::Record> records, std::size_t column,
                                    Success success) {
  using truth::TrialOutcome;
  std::vector<Duration> durations;
  for (const truth::Record& record : records) {
    if (record.outcome == TrialOutcome::kSimulatorFault || column >= record.values.size()) continue;
    const bool reached = success == Success::kTrue ? record.outcome == TrialOutcome::kGoalReached
                                                   : truth::DeclaredSuccess(record.outcome);
    double at = record.values[column];
    if (std::isnan(at) && !reached) at = core::kInfinity;
    durations.push_back({at, reached ? EndKind::kEvent : EndKind::kCompeting});
  }
  return durations;
}

}  // namespace rockyard::statistics
