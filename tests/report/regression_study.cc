// Power and false alarms of the regression check, by resampling simulated trials.
//   regression_study TRIALS CAMPAIGNS SEED POOL.json...
// Each POOL is a baseline of one cell with many trials. A campaign draws TRIALS of them for the
// baseline and as many for the run. Prints one line of CSV for each case;
// scripts/studies/regression/regression.py runs it.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/json_file.h"
#include "core/random.h"
#include "report/baseline.h"
#include "statistics/proportions.h"
#include "statistics/regression.h"

namespace rockyard::report {
namespace {

using statistics::BaselineMetric;
using statistics::RegressionCell;
using statistics::RegressionResult;
using statistics::RegressionVerdict;

constexpr double kChange = 0.10;  // of a success rate, to be found

struct Pool {
  std::string name;
  std::vector<BaselineMetric> metrics;
  std::size_t trials = 0;

  const std::vector<double>& Of(std::string_view metric) const {
    for (const BaselineMetric& each : metrics) {
      if (each.name == metric) return each.values;
    }
    throw core::UserError({{name, std::string("has no ") + std::string(metric), ""}});
  }
};

Pool ReadPool(const std::string& path) {
  Baseline baseline = ParseBaseline(core::LoadJsonFile(path));
  BaselineCell& cell = baseline.cells.at(0);
  return {cell.scenario, std::move(cell.metrics), cell.outcomes.size()};
}

// Different trials of a pool: the first places of a shuffle (Fisher and Yates).
std::vector<std::size_t> Draw(std::size_t pool, std::size_t count, core::RandomStream& stream) {
  std::vector<std::size_t> order(pool);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(order[i], order[i + stream.NextU64() % (pool - i)]);
  }
  order.resize(count);
  return order;
}

std::vector<double> Take(const std::vector<double>& values, const std::size_t* trials,
                         std::size_t count) {
  std::vector<double> taken(count);
  std::transform(trials, trials + count, taken.begin(), [&](std::size_t i) { return values[i]; });
  return taken;
}

// A campaign whose run differs from its baseline by chance only, or not at all.
struct Campaign {
  std::vector<std::vector<BaselineMetric>> baselines;  // by cell
  std::vector<std::vector<std::vector<double>>> runs;

  RegressionResult Check(const std::vector<Pool>& pools, bool paired) const {
    std::vector<RegressionCell> cells;
    for (std::size_t i = 0; i < pools.size(); ++i) {
      cells.push_back(
          {.name = pools[i].name, .paired = paired, .baseline = baselines[i], .run = runs[i]});
    }
    return statistics::CheckRegression(cells);
  }
};

enum class Trials { kSame, kOthers };

Campaign DrawCampaign(const std::vector<Pool>& pools, std::size_t count, Trials trials,
                      core::RandomStream& stream) {
  Campaign campaign;
  for (const Pool& pool : pools) {
    const std::size_t all = trials == Trials::kSame ? count : 2 * count;
    const std::vector<std::size_t> drawn = Draw(pool.trials, all, stream);
    auto& baseline = campaign.baselines.emplace_back(pool.metrics);
    auto& run = campaign.runs.emplace_back();
    for (BaselineMetric& metric : baseline) {
      run.push_back(Take(metric.values, &drawn[all - count], count));
      metric.values = Take(metric.values, drawn.data(), count);
    }
  }
  return campaign;
}

// What `campaigns` checks said.
struct Tally {
  std::int64_t campaigns = 0;
  std::int64_t alarms = 0;  // exit code 1
  std::int64_t primary = 0;
  std::int64_t secondary = 0;
  std::int64_t inconclusive = 0;  // exit code 4
  std::int64_t found = 0;         // the metric that was changed

  void Add(const RegressionResult& result) {
    ++campaigns;
    const int code = statistics::ExitCode(result);
    alarms += code == 1 ? 1 : 0;
    inconclusive += code == 4 ? 1 : 0;
    primary += result.Count(RegressionVerdict::kChanged, true) > 0 ? 1 : 0;
    secondary += result.Count(RegressionVerdict::kChanged, false) > 0 ? 1 : 0;
  }
  void Print(std::string_view study, std::string_view cell, std::string_view metric,
             double discordance) const {
    const auto ends = [&](std::int64_t count) {
      const statistics::Interval interval = statistics::ProportionInterval(
          count, campaigns, statistics::kConfidence, statistics::IntervalMethod::kClopperPearson);
      return std::to_string(count) + "," + std::to_string(interval.low) + "," +
             std::to_string(interval.high);
    };
    std::cout << study << "," << cell << "," << metric << "," << discordance << "," << campaigns
              << "," << ends(alarms) << "," << ends(found) << "," << primary << "," << secondary
              << "," << inconclusive << std::endl;
  }
};

core::RandomStream StreamOf(std::uint64_t seed, std::int64_t campaign) {
  return {{seed, static_cast<std::uint32_t>(campaign)}, core::Purpose::kBootstrap};
}

// Unchanged builds. `paired`: as if the seeds were the same, with every record another one.
void FalseAlarms(const std::vector<Pool>& pools, std::size_t trials, std::int64_t campaigns,
                 std::uint64_t seed, bool paired) {
  Tally tally;
  for (std::int64_t i = 0; i < campaigns; ++i) {
    core::RandomStream stream = StreamOf(seed, i);
    tally.Add(DrawCampaign(pools, trials, Trials::kOthers, stream).Check(pools, paired));
  }
  tally.Print(paired ? "unchanged: pairs at random" : "unchanged: other seeds", "", "", 0.0);
}

// A success rate falls by kChange in one cell at the baseline's seeds: of all trials, so many
// change one way, and kChange fewer the other way, that `discordance` of them differ.
void Power(const std::vector<Pool>& pools, std::size_t changed_cell, const std::string& metric,
           double discordance, std::size_t trials, std::int64_t campaigns, std::uint64_t seed) {
  const Pool& pool = pools[changed_cell];
  const std::vector<double>& values = pool.Of(metric);
  const double rate =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  const double loss = 0.5 * (discordance + kChange) / rate;
  const double gain = 0.5 * (discordance - kChange) / (1.0 - rate);
  if (loss > 1.0 || gain > 1.0) return;  // no such change exists at this rate
  const auto index = static_cast<std::size_t>(
      std::find_if(pool.metrics.begin(), pool.metrics.end(),
                   [&](const BaselineMetric& each) { return each.name == metric; }) -
      pool.metrics.begin());
  Tally tally;
  for (std::int64_t i = 0; i < campaigns; ++i) {
    core::RandomStream stream = StreamOf(seed, i);
    Campaign campaign = DrawCampaign(pools, trials, Trials::kSame, stream);
    for (double& success : campaign.runs[changed_cell][index]) {
      const double u = stream.Uniform();
      success = success > 0.0 ? (u < loss ? 0.0 : 1.0) : (u < gain ? 1.0 : 0.0);
    }
    const RegressionResult result = campaign.Check(pools, true);
    tally.Add(result);
    tally.found += std::any_of(result.rows.begin(), result.rows.end(), [&](const auto& row) {
      return row.cell == pool.name && row.metric.name == metric &&
             row.verdict == RegressionVerdict::kChanged;
    });
  }
  tally.Print("success 0.10 lower", pool.name, metric, discordance);
}

// The primary family alone: what is secondary neither helps nor hinders it.
std::vector<Pool> PrimaryOf(const std::vector<Pool>& pools) {
  std::vector<Pool> primary = pools;
  for (Pool& pool : primary) {
    std::erase_if(pool.metrics, [](const BaselineMetric& metric) {
      return !statistics::IsPrimary(*statistics::FindMetric(metric.name));
    });
  }
  return primary;
}

int Run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 4) {
    std::cerr << "usage: regression_study TRIALS CAMPAIGNS SEED POOL.json...\n";
    return 2;
  }
  const std::size_t trials = std::strtoull(arguments[0].c_str(), nullptr, 10);
  const std::int64_t campaigns = std::strtoll(arguments[1].c_str(), nullptr, 10);
  const std::uint64_t seed = std::strtoull(arguments[2].c_str(), nullptr, 10);
  try {
    std::vector<Pool> pools;
    for (std::size_t i = 3; i < arguments.size(); ++i) pools.push_back(ReadPool(arguments[i]));
    std::cout << "study,cell,metric,discordance,campaigns,alarms,alarms_low,alarms_high,found,"
                 "found_low,found_high,primary_alarms,secondary_alarms,inconclusive\n";
    FalseAlarms(pools, trials, campaigns, seed, false);
    FalseAlarms(pools, trials, campaigns, seed + 1, true);
    const std::vector<Pool> primary = PrimaryOf(pools);
    for (std::size_t cell = 0; cell < primary.size(); ++cell) {
      for (const char* metric : {"declared_success", "true_success"}) {
        for (const double discordance : {0.1, 0.2, 0.3}) {
          // Where fewer pairs differ the change is easier to find, and fewer campaigns show it.
          const std::int64_t enough = discordance < 0.3 ? campaigns / 4 : campaigns;
          Power(primary, cell, metric, discordance, trials, enough, seed + 2);
        }
      }
    }
  } catch (const core::UserError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace rockyard::report

int main(int argc, char** argv) {
  return rockyard::report::Run(std::vector<std::string>(argv + 1, argv + argc));
}
