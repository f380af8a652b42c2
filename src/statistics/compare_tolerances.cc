// Rows of the comparison that are judged by a tolerance.
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "core/numbers.h"
#include "statistics/closed_forms.h"
#include "statistics/clustered_rate.h"
#include "statistics/compare_rows.h"
#include "statistics/drive_summary.h"
#include "statistics/sample_statistics.h"
#include "truth/measurement_record.h"

namespace rockyard::statistics {
namespace {

using core::kInfinity;
using core::kNaN;

// The values of one record that a statistic needs, or one term of it.
struct Values {
  double of_column = 0.0;
  double base = 0.0;
  double abscissa = 0.0;
};

// Every statistic but kRatioSum has the one term of its `column` over `of`.
std::vector<RatioTerm> TermsOf(const PublishedValue& published) {
  if (published.statistic == StatisticKind::kRatioSum) return published.terms;
  return {{{published.column}, published.of}};
}

bool Counts(const PublishedValue& published, const ScenarioRun& run, const truth::Record& record) {
  if (IsFault(record) || record.values.size() != run.schema.size()) return false;
  if (truth::IsNavigatorCrash(record)) return false;
  return std::all_of(published.where.begin(), published.where.end(), [&](const ColumnRange& range) {
    const auto column = ColumnIndex(run.schema, range.column);
    return column && record.values[*column] >= range.low && record.values[*column] <= range.high;
  });
}

// Name of a column that the run lacks; empty where it has all.
std::string MissingColumn(const PublishedValue& published, const ScenarioRun& run) {
  std::vector<std::string> names{published.along};
  for (const RatioTerm& term : TermsOf(published)) {
    names.insert(names.end(), term.columns.begin(), term.columns.end());
    names.push_back(term.of);
  }
  for (const ColumnRange& range : published.where) names.push_back(range.column);
  for (const std::string& name : names) {
    if (!name.empty() && !ColumnIndex(run.schema, name)) return name;
  }
  return "";
}

// Returns the values of a term for every record that counts. A statistic without a base has the
// base 1.
std::vector<Values> ValuesOf(const PublishedValue& published, const RatioTerm& term,
                             const ScenarioRun& run) {
  std::vector<std::size_t> columns;
  columns.reserve(term.columns.size());
  for (const std::string& name : term.columns) columns.push_back(*ColumnIndex(run.schema, name));
  const auto of = ColumnIndex(run.schema, term.of);
  const auto along = ColumnIndex(run.schema, published.along);
  std::vector<Values> values;
  for (const truth::Record& record : run.records) {
    if (!Counts(published, run, record)) continue;
    Values& added = values.emplace_back();
    for (const std::size_t column : columns) added.of_column += record.values[column];
    added.base = of ? record.values[*of] : 1.0;
    added.abscissa = along ? record.values[*along] : 0.0;
  }
  return values;
}

// Returns the values of every term.
std::vector<std::vector<Values>> TermValues(const PublishedValue& published,
                                            const ScenarioRun& run) {
  std::vector<std::vector<Values>> terms;
  for (const RatioTerm& term : TermsOf(published)) {
    terms.push_back(ValuesOf(published, term, run));
  }
  return terms;
}

Values SumOf(const std::vector<Values>& values) {
  Values sum;
  for (const Values& each : values) {
    sum.of_column += each.of_column;
    sum.base += each.base;
  }
  return sum;
}

// Whether there are runs, and something to divide by in every term.
bool Defined(const std::vector<std::vector<Values>>& terms) {
  return std::all_of(terms.begin(), terms.end(), [](const std::vector<Values>& values) {
    return !values.empty() && SumOf(values).base > 0.0;
  });
}

// Whether the base counts independent trials (truth::ColumnRole::kTrials); no other role promises
// that.
bool Independent(const PublishedValue& published, const ScenarioRun& run) {
  const truth::ValueInfo* base = truth::FindColumn(run.schema, published.of);
  return base != nullptr && base->role == truth::ColumnRole::kTrials;
}

// The exact interval, as it keeps its confidence for rare events too.
Interval RateInterval(const std::vector<Values>& values, bool independent, double confidence) {
  std::vector<CountOfRun> runs;
  runs.reserve(values.size());
  for (const Values& each : values) runs.push_back({each.of_column, each.base});
  return RateOfRuns(runs, independent, confidence, IntervalMethod::kClopperPearson).interval;
}

// Student's interval around a mean from the scatter of `residuals` about it; a point where nothing
// scatters.
Interval MeanInterval(double mean, const std::vector<double>& residuals, double scale,
                      double confidence) {
  const Moments moments = MomentsOf(residuals);
  const auto n = static_cast<double>(moments.count());
  if (n < 2.0) return {-kInfinity, kInfinity};
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.5 + 0.5 * confidence);
  // t s / sqrt(n), in the published unit.
  const double half = t * std::abs(scale) * moments.standard_deviation() / std::sqrt(n);
  return {mean - half, mean + half};
}

void SetRate(bool independent, const std::vector<Values>& values, Row& row) {
  const Values sum = SumOf(values);
  row.value.pool = std::llround(sum.base);
  row.value.pool_value = sum.of_column / sum.base;
  row.interval = [values, independent](double confidence) {
    return RateInterval(values, independent, confidence);
  };
}

// Sets ratios of two sums over independent runs, added up, by linearization: a run's residual is
// the sum over terms of (x - R y) over the mean of y. So terms that vary together in a run are
// taken as such.
void SetRatios(const PublishedValue& published, const std::vector<std::vector<Values>>& terms,
               Row& row) {
  double total = 0.0;
  std::vector<double> residuals(terms.front().size(), 0.0);
  for (const std::vector<Values>& values : terms) {
    const Values sum = SumOf(values);
    const double ratio = sum.of_column / sum.base;
    const double inverse_mean = static_cast<double>(values.size()) / sum.base;
    total += ratio;
    for (std::size_t run = 0; run < values.size(); ++run) {
      residuals[run] += (values[run].of_column - ratio * values[run].base) * inverse_mean;
    }
  }
  const double mean = published.factor * total;
  row.value.pool_value = mean;
  // Var(sum of R) is near the variance of the residuals over n.
  row.interval = [mean, residuals, factor = published.factor](double confidence) {
    return MeanInterval(mean, residuals, factor, confidence);
  };
}

// First abscissa, by linear interpolation, at which a curve passes a level upwards.
double Crossing(const std::vector<std::pair<double, double>>& curve, double level) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    // -infinity where the first rate is above the level already, infinity where none is.
    if (curve[i].second < level) continue;
    if (i == 0) return -kInfinity;
    const auto& [x0, y0] = curve[i - 1];
    const auto& [x1, y1] = curve[i];
    return x0 + (x1 - x0) * (level - y0) / (y1 - y0);
  }
  return kInfinity;
}

using RateCurve = std::map<double, std::vector<Values>>;

// The crossings of the upper and of the lower ends of the rates' intervals. A crossing lies between
// two rates, so each takes half of the error. Interpolation between them is not part of it.
Interval CrossingInterval(const RateCurve& rates, const PublishedValue& published, bool independent,
                          double confidence) {
  std::vector<std::pair<double, double>> upper;
  std::vector<std::pair<double, double>> lower;
  for (const auto& [x, values] : rates) {
    // Each end is taken at half of the error.
    const Interval interval = RateInterval(values, independent, 1.0 - 0.5 * (1.0 - confidence));
    upper.emplace_back(x, interval.high);
    lower.emplace_back(x, interval.low);
  }
  return {published.factor * Crossing(upper, published.level),
          published.factor * Crossing(lower, published.level)};
}

void SetCrossing(const PublishedValue& published, bool independent,
                 const std::vector<Values>& values, Row& row) {
  RateCurve rates;
  for (const Values& each : values) rates[each.abscissa].push_back(each);
  std::vector<std::pair<double, double>> curve;
  for (const auto& [x, of_x] : rates) {
    const Values sum = SumOf(of_x);
    curve.emplace_back(x, sum.of_column / sum.base);
  }
  row.value.pool_value = published.factor * Crossing(curve, published.level);
  row.interval = [rates, published, independent](double confidence) {
    return CrossingInterval(rates, published, independent, confidence);
  };
}

void SetMean(const PublishedValue& published, const std::vector<Values>& values, Row& row) {
  std::vector<double> samples;
  samples.reserve(values.size());
  for (const Values& each : values) samples.push_back(each.of_column);
  const double mean = published.factor * MomentsOf(samples).mean();
  row.value.pool_value = mean;
  row.interval = [mean, samples, factor = published.factor](double confidence) {
    return MeanInterval(mean, samples, factor, confidence);
  };
}

// Confidence of the interval of a reading beside a row.
constexpr double kSideConfidence = 0.95;

bool IsRatio(StatisticKind kind) {
  return kind == StatisticKind::kRatio || kind == StatisticKind::kRatioSum;
}

// Returns the ratio or mean of the row over the simulated runs that arrived, where some did and
// some did not.
std::optional<SideStatistic> ArrivalsAlone(const PublishedValue& published,
                                           const ScenarioRun& run) {
  std::vector<truth::Record> arrivals;
  std::copy_if(run.records.begin(), run.records.end(), std::back_inserter(arrivals),
               [](const truth::Record& r) { return truth::DeclaredSuccess(r.outcome); });
  ScenarioRun arrived = run;
  arrived.records = arrivals;
  const std::vector<std::vector<Values>> terms = TermValues(published, arrived);
  const std::size_t all = TermValues(published, run).front().size();
  if (!Defined(terms) || terms.front().size() == all) return std::nullopt;
  Row row;
  if (IsRatio(published.statistic)) {
    SetRatios(published, terms, row);
  } else {
    SetMean(published, terms.front(), row);
  }
  return SideStatistic{"arrivals alone", row.value.pool_value, row.interval(kSideConfidence), kNaN};
}

std::string ToleranceRemark(const PublishedValue& published) {
  return fmt::format("tolerance {:.6g} .. {:.6g}", published.low, published.high);
}

}  // namespace

Row CompareTolerance(const PublishedValue& published, const ScenarioRun& run) {
  const std::string missing = MissingColumn(published, run);
  if (!missing.empty()) return NotJudged(published, "the runs have no column " + missing);
  const std::vector<std::vector<Values>> terms = TermValues(published, run);
  if (!Defined(terms)) return NotJudged(published, "no simulated runs");
  const std::vector<Values>& values = terms.front();
  Row row;
  row.value.published = published;
  row.value.pool = static_cast<std::int64_t>(values.size());
  row.value.remark = ToleranceRemark(published);
  switch (published.statistic) {
    case StatisticKind::kRate:
      SetRate(Independent(published, run), values, row);
      break;
    case StatisticKind::kRatio:
    case StatisticKind::kRatioSum:
      SetRatios(published, terms, row);
      break;
    case StatisticKind::kMean:
      SetMean(published, values, row);
      break;
    default:
      SetCrossing(published, Independent(published, run), values, row);
      break;
  }
  row.value.median = row.value.pool_value;
  if (IsRatio(published.statistic) || published.statistic == StatisticKind::kMean) {
    if (const auto side = ArrivalsAlone(published, run)) row.value.beside.push_back(*side);
  }
  return row;
}

Row CompareComputed(const PublishedValue& published) {
  Row row;
  ComparedValue& value = row.value;
  value.published = published;
  value.pool_value = Evaluate(published.formula, published.inputs);
  value.median = value.pool_value;
  value.interval = {value.pool_value, value.pool_value};
  value.verdict = value.pool_value >= published.low && value.pool_value <= published.high
                      ? Verdict::kHolds
                      : Verdict::kDiffers;
  value.remark = ToleranceRemark(published) + "; computed, not simulated";
  return row;
}

}  // namespace rockyard::statistics
