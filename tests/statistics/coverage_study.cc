// How often the printed intervals hold what they are about, and how wide they are, on real trials.
//
//   coverage_study SAMPLES POOL.csv [OTHER.csv]
//
// POOL.csv is the trials.csv of a large run, which is taken for the whole law: samples of 30 to 300
// trials are drawn from it with replacement, each interval is made of each of them, and compared
// with the value of the pool. OTHER.csv is another run with the same seed: what compares two runs
// is made of trials of both. Writes one line of CSV for each interval, column and size;
// scripts/studies/coverage/coverage.py makes the pools and the page.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>

#include "core/random.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "statistics/equivalence.h"
#include "statistics/metrics.h"
#include "statistics/proportions.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr std::array<std::size_t, 4> kSizes = {30, 40, 100, 300};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Values = std::vector<double>;

struct Pool {
  truth::RecordSchema schema;
  std::vector<truth::Record> records;
};

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '"' && c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

// trial, outcome, values, detail.
Pool ReadPool(const char* path) {
  std::ifstream file(path);
  std::string line;
  Pool pool;
  if (!std::getline(file, line)) {
    std::cerr << path << ": cannot be read\n";
    std::exit(2);
  }
  const std::vector<std::string> names = Fields(line);
  for (std::size_t i = 2; i + 1 < names.size(); ++i) pool.schema.push_back({names[i], "", ""});
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = Fields(line);
    truth::Record record;
    const auto& outcomes = truth::kTrialOutcomeNames;
    const auto outcome = std::find(outcomes.begin(), outcomes.end(), fields[1]);
    record.outcome = static_cast<truth::TrialOutcome>(outcome - outcomes.begin());
    for (std::size_t i = 2; i + 1 < names.size(); ++i) {
      record.values.push_back(fields[i].empty() ? kNaN : std::strtod(fields[i].c_str(), nullptr));
    }
    pool.records.push_back(std::move(record));
  }
  return pool;
}

// What one kind of interval did in all samples.
class Tally {
 public:
  void Add(const Interval& interval, double estimate, double exact_width = kNaN) {
    ++samples_;
    estimates_.push_back(estimate);
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return;
    intervals_.push_back(interval);
    if (std::isfinite(exact_width)) exact_width_ += exact_width;
  }

  // missed_below: the interval lies below the truth.
  void Print(const std::string& head, double truth) {
    std::int64_t below = 0;
    std::int64_t above = 0;
    double width = 0.0;
    const double rounding = 1e-9 * std::abs(truth);
    for (const Interval& interval : intervals_) {
      if (interval.high < truth - rounding) ++below;
      if (interval.low > truth + rounding) ++above;
      width += interval.high - interval.low;
    }
    const auto printed = static_cast<std::int64_t>(intervals_.size());
    const Proportion covered = MakeProportion(printed - below - above, printed);
    std::sort(estimates_.begin(), estimates_.end());
    const double oracle = Quantile(estimates_, 0.975) - Quantile(estimates_, 0.025);
    const double count = static_cast<double>(printed);
    const double ratio = exact_width_ > 0.0 ? width / exact_width_ : width / count / oracle;
    std::printf("%s,%lld,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f\n", head.c_str(),
                static_cast<long long>(samples_), count / static_cast<double>(samples_),
                covered.rate, covered.interval.low, covered.interval.high,
                static_cast<double>(below) / count, static_cast<double>(above) / count, ratio);
  }

 private:
  std::int64_t samples_ = 0;
  Values estimates_;
  std::vector<Interval> intervals_;
  double exact_width_ = 0.0;
};

std::vector<std::size_t> Draw(std::size_t from, std::size_t size, std::uint32_t sample,
                              std::uint32_t stream_number) {
  core::RandomStream stream({.seed = 61, .trial = sample}, core::Purpose::kTest, stream_number);
  std::vector<std::size_t> drawn(size);
  for (std::size_t& i : drawn) {
    i = static_cast<std::size_t>(stream.Uniform() * static_cast<double>(from));
  }
  return drawn;
}

Values Pick(const Values& values, const std::vector<std::size_t>& drawn) {
  Values picked;
  picked.reserve(drawn.size());
  for (const std::size_t i : drawn) picked.push_back(values[i]);
  return picked;
}

double MeanOf(const Values& values) { return MomentsOf(values).mean(); }

Interval StudentInterval(const Values& values) {
  const MeanDifference mean = PairedMeans(values);
  return mean.known() ? DifferenceInterval(mean) : Interval{kNaN, kNaN};
}

std::string Head(const std::string& kind, std::string_view name, std::size_t size) {
  return kind + "," + std::string(name) + "," + std::to_string(size);
}

// Mean, median, mode and rate of one metric.
void StudyMetric(const Metric& metric, const Values& pool, std::uint32_t samples) {
  const Values sorted_pool = SortedFinite(pool);
  const double apart = EstimateMean(sorted_pool, 2).apart.rate;
  for (const std::size_t size : kSizes) {
    Tally mean;
    Tally student;
    Tally share;
    Tally median;
    for (std::uint32_t s = 0; s < samples; ++s) {
      const Values values =
          Pick(pool, Draw(pool.size(), size, s, static_cast<std::uint32_t>(size)));
      const MetricSummary summary = SummarizeMetric(metric, values);
      if (metric.kind == MetricKind::kRate) {
        const auto count =
            static_cast<std::int64_t>(std::lround(summary.mean * static_cast<double>(size)));
        const auto trials = static_cast<std::int64_t>(size);
        const Interval exact =
            ProportionInterval(count, trials, kConfidence, IntervalMethod::kClopperPearson);
        const Interval wilson = ProportionInterval(count, trials);
        mean.Add(summary.interval, summary.mean, exact.high - exact.low);
        student.Add(wilson, summary.mean, exact.high - exact.low);
        continue;
      }
      mean.Add(summary.interval, summary.mean);
      student.Add(StudentInterval(values), summary.mean);
      median.Add(summary.median_interval, summary.median);
      const Proportion& seen = summary.estimate.apart;
      // Of the value that is the commonest in the pool too.
      if (apart < 0.5) share.Add(seen.interval, seen.rate, seen.interval.high - seen.interval.low);
    }
    const double truth = MeanOf(pool);
    const bool rate = metric.kind == MetricKind::kRate;
    mean.Print(Head(rate ? "rate" : "mean", metric.name, size), truth);
    student.Print(
        Head(rate ? "rate by Wilson (before)" : "mean by Student (before)", metric.name, size),
        truth);
    if (rate) continue;
    median.Print(Head("median", metric.name, size), Quantile(sorted_pool, 0.5));
    if (apart < 0.5) share.Print(Head("share of trials apart", metric.name, size), apart);
  }
}

// The modes that a summary shows, of the column that published runs give.
void StudyMode(const std::string& name, const Values& pool, std::uint32_t samples) {
  const double truth = HalfSampleMode(SortedFinite(pool));
  for (const std::size_t size : kSizes) {
    Tally mode;
    for (std::uint32_t s = 0; s < samples; ++s) {
      const Values values =
          Pick(pool, Draw(pool.size(), size, s, static_cast<std::uint32_t>(size)));
      mode.Add(HalfSampleModeRange(values), HalfSampleMode(SortedFinite(values)));
    }
    mode.Print(Head("mode (no coverage claimed)", name, size), truth);
  }
}

// Curves over distance: the incidence of arrival at quantiles, and the band of the distribution.
void StudyCurves(const Pool& pool, std::uint32_t samples) {
  const std::size_t column = *ColumnIndex(pool.schema, "true_distance_m");
  const std::vector<Duration> all = GoalDurations(pool.records, column);
  Values distances;
  for (const Duration& duration : all) distances.push_back(duration.at);
  const Values sorted = SortedFinite(distances);
  for (const std::size_t size : kSizes) {
    std::map<int, Tally> goal;
    std::int64_t inside = 0;
    for (std::uint32_t s = 0; s < samples; ++s) {
      std::vector<Duration> durations;
      Values drawn;
      for (const std::size_t i : Draw(all.size(), size, s, static_cast<std::uint32_t>(size))) {
        durations.push_back(all[i]);
        drawn.push_back(all[i].at);
      }
      const std::vector<IncidenceStep> steps = CumulativeIncidence(durations);
      for (const int percent : {10, 50, 90, 100}) {
        const double at = Quantile(sorted, percent / 100.0);
        IncidenceStep now{.band = ProportionInterval(0, static_cast<std::int64_t>(size),
                                                     kConfidence, IntervalMethod::kClopperPearson)};
        for (const IncidenceStep& step : steps) {
          if (step.at <= at) now = step;
        }
        const Interval exact = ProportionInterval(
            std::llround(now.event * static_cast<double>(size)), static_cast<std::int64_t>(size),
            kConfidence, IntervalMethod::kClopperPearson);
        goal[percent].Add(now.band, now.event, exact.high - exact.low);
      }
      // The whole curve lies in the band where it does at both sides of each step.
      bool held = true;
      double before = 0.0;
      const double half = Ecdf(drawn).front().band.high - Ecdf(drawn).front().fraction;
      for (const EcdfPoint& point : Ecdf(drawn)) {
        const auto below = std::lower_bound(sorted.begin(), sorted.end(), point.value);
        const auto upto = std::upper_bound(sorted.begin(), sorted.end(), point.value);
        const double n = static_cast<double>(sorted.size());
        held = held && static_cast<double>(below - sorted.begin()) / n <= before + half &&
               static_cast<double>(upto - sorted.begin()) / n >= point.fraction - half &&
               static_cast<double>(upto - sorted.begin()) / n <= point.fraction + half;
        before = point.fraction;
      }
      inside += held ? 1 : 0;
    }
    for (auto& [percent, tally] : goal) {
      const double at = Quantile(sorted, percent / 100.0);
      const auto arrived = std::count_if(all.begin(), all.end(), [&](const Duration& d) {
        return d.kind == EndKind::kEvent && d.at <= at;
      });
      tally.Print(Head("incidence of arrival",
                       "at the distance of " + std::to_string(percent) + " %", size),
                  static_cast<double>(arrived) / static_cast<double>(all.size()));
    }
    const Proportion covered = MakeProportion(inside, samples);
    std::printf("%s,%u,1.0000,%.4f,%.4f,%.4f,,,\n",
                Head("distribution of distances (whole band)", "true_distance_m", size).c_str(),
                samples, covered.rate, covered.interval.low, covered.interval.high);
  }
}

// Two runs: by pairs and as two samples.
void StudyDifference(const Metric& metric, const Values& first, const Values& second,
                     std::uint32_t samples) {
  Values a;
  Values b;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(second[i])) continue;
    a.push_back(first[i]);
    b.push_back(second[i]);
  }
  Values differences(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) differences[i] = b[i] - a[i];
  const double truth = MeanOf(b) - MeanOf(a);
  for (const std::size_t size : kSizes) {
    Tally paired;
    Tally apart;
    Tally welch;
    const auto stream = static_cast<std::uint32_t>(size);
    for (std::uint32_t s = 0; s < samples; ++s) {
      const Values pairs = Pick(differences, Draw(a.size(), size, s, stream));
      const Values sorted = SortedFinite(pairs);
      paired.Add(EstimateMean(sorted, metric.fewest_for_mean).interval, MeanOf(pairs));
      const Values one = SortedFinite(Pick(a, Draw(a.size(), size, s, stream + 1)));
      const Values two = SortedFinite(Pick(b, Draw(a.size(), size, s, stream + 2)));
      const MeanDifference means = WelchMeans(one, two);
      const Interval of_one = EstimateMean(one, metric.fewest_for_mean).interval;
      const Interval of_two = EstimateMean(two, metric.fewest_for_mean).interval;
      apart.Add(MeanDifferenceInterval(MeanOf(one), of_one, MeanOf(two), of_two), means.difference);
      welch.Add(DifferenceInterval(means), means.difference);
    }
    paired.Print(Head("paired difference of means", metric.name, size), truth);
    apart.Print(Head("difference of means", metric.name, size), truth);
    welch.Print(Head("difference of means by Welch (before)", metric.name, size), truth);
  }
}

// The width is compared with that from exact ends: Newcombe's rule with those of Clopper and
// Pearson.
double ExactWidth(const Proportion& first, const Proportion& second) {
  const auto exact = [](const Proportion& rate) {
    return ProportionInterval(rate.count, rate.trials, kConfidence,
                              IntervalMethod::kClopperPearson);
  };
  const Interval interval =
      MeanDifferenceInterval(first.rate, exact(first), second.rate, exact(second));
  return interval.high - interval.low;
}

void StudyRateDifference(const Metric& metric, const Values& first, const Values& second,
                         std::uint32_t samples) {
  const std::size_t count = std::min(first.size(), second.size());
  const auto mean_of = [count](const Values& values) {
    return MeanOf(Values(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)));
  };
  const double truth = mean_of(second) - mean_of(first);
  for (const std::size_t size : kSizes) {
    Tally paired;
    Tally agresti;
    Tally apart;
    const auto stream = static_cast<std::uint32_t>(size);
    const auto n = static_cast<std::int64_t>(size);
    for (std::uint32_t s = 0; s < samples; ++s) {
      PairedCounts counts;
      for (const std::size_t i : Draw(count, size, s, stream)) {
        counts.Add(first[i] > 0.5, second[i] > 0.5);
      }
      const Proportion lost = MakeProportion(counts.only_first, n);
      const Proportion won = MakeProportion(counts.only_second, n);
      const double exact = ExactWidth(lost, won);
      paired.Add(DifferenceInterval(counts), won.rate - lost.rate, exact);
      const SignedValues differences{static_cast<double>(counts.pairs()),
                                     static_cast<double>(counts.only_second - counts.only_first),
                                     static_cast<double>(counts.only_second + counts.only_first)};
      agresti.Add(AgrestiMinInterval(differences), won.rate - lost.rate, exact);
      const auto ones = [&](const Values& values, std::uint32_t number) {
        const double mean = MeanOf(Pick(values, Draw(count, size, s, number)));
        return MakeProportion(std::llround(mean * static_cast<double>(n)), n);
      };
      const Proportion one = ones(first, stream + 1);
      const Proportion two = ones(second, stream + 2);
      apart.Add(DifferenceInterval(one, two), two.rate - one.rate, ExactWidth(one, two));
    }
    paired.Print(Head("paired difference of rates", metric.name, size), truth);
    agresti.Print(Head("paired difference of rates by Agresti and Min (before)", metric.name, size),
                  truth);
    apart.Print(Head("difference of rates", metric.name, size), truth);
  }
}

Values Counted(const Metric& metric, const Pool& pool) {
  Values values = MetricValues(metric, pool.schema, pool.records).value_or(Values{});
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  return values;
}

void StudyPool(const Pool& pool, std::uint32_t samples) {
  for (const Metric& metric : Metrics()) {
    const Values values = Counted(metric, pool);
    if (values.empty() || MomentsOf(values).standard_deviation() == 0.0) continue;
    StudyMetric(metric, values, samples);
  }
  for (const char* name : {"true_distance_m", "distance_error_percent", "heading_error_deg"}) {
    StudyMode(name, ColumnValues(pool.records, *ColumnIndex(pool.schema, name)), samples / 4);
  }
  StudyCurves(pool, samples);
}

void StudyPools(const Pool& pool, const Pool& other, std::uint32_t samples) {
  for (const Metric& metric : Metrics()) {
    const auto first = MetricValues(metric, pool.schema, pool.records);
    const auto second = MetricValues(metric, other.schema, other.records);
    if (!first || !second || MomentsOf(*first).standard_deviation() == 0.0) continue;
    if (metric.kind == MetricKind::kMean) StudyDifference(metric, *first, *second, samples);
    if (metric.source == MetricSource::kOutcome) {
      StudyRateDifference(metric, *first, *second, samples);
    }
  }
}

}  // namespace
}  // namespace rockyard::statistics

int main(int count, char** arguments) {
  using namespace rockyard::statistics;
  if (count < 3) {
    std::cerr << "coverage_study SAMPLES POOL.csv [OTHER.csv]\n";
    return 2;
  }
  const auto samples = static_cast<std::uint32_t>(std::strtoul(arguments[1], nullptr, 10));
  const Pool pool = ReadPool(arguments[2]);
  std::puts(
      "kind,of,n,samples,printed,coverage,coverage_low,coverage_high,missed_below,missed_above,"
      "width");
  if (count == 3) {
    StudyPool(pool, samples);
  } else {
    StudyPools(pool, ReadPool(arguments[3]), samples);
  }
  return 0;
}
