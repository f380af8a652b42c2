// Cost of the error-state filter. Each benchmark prints a hash of what it believes at the end.
#include <benchmark/benchmark.h>

#include "core/hash.h"
#include "localization/dead_reckoning.h"
#include "localization/filter_rover.h"

namespace rockyard::localization {
namespace {

void Label(benchmark::State& state, const Estimator& estimator) {
  core::Hasher hash;
  hash.Real(estimator.estimate().pose.x_m);
  hash.Real(estimator.estimate().pose.heading_rad);
  state.SetLabel(core::Hex(hash.value()));
}

// One tick of 5 mm.
template <class AnEstimator>
void Propagate(benchmark::State& state, AnEstimator estimator) {
  AnEstimator again = estimator;
  const auto motion = Rolled(0.005, 0.001, 0.05);
  for (auto _ : state) estimator.Propagate(motion);
  for (int i = 0; i < 1000; ++i) again.Propagate(motion);
  Label(state, again);
}

// Every 14th tick carries the covariance on.
void BM_Propagate(benchmark::State& state) {
  Propagate(state, ErrorStateFilter({}, FilterSetup()));
}
BENCHMARK(BM_Propagate)->Unit(benchmark::kNanosecond);

// As many ticks of the estimator that keeps no account of its error.
void BM_DeadReckoning(benchmark::State& state) {
  Propagate(state, DeadReckoningEstimator(FilterSetup()));
}
BENCHMARK(BM_DeadReckoning)->Unit(benchmark::kNanosecond);

// A stretch of one tick: what carrying the covariance on costs.
void BM_EndStretch(benchmark::State& state) {
  ErrorStateFilterParams params{.stretch_m = 0.0};
  Propagate(state, ErrorStateFilter(params, FilterSetup()));
}
BENCHMARK(BM_EndStretch)->Unit(benchmark::kNanosecond);

// Captures a moment, takes a fix of x, y and heading of it, and forgets it; with that many other
// moments kept.
void BM_Update(benchmark::State& state) {
  ErrorStateFilter filter({}, FilterSetup());
  for (int i = 0; i < 1000; ++i) filter.Propagate(Rolled(0.005, 0.001, 0.05));
  for (int i = 0; i < state.range(0); ++i) filter.Capture(-1 - i);
  messages::PoseFix fix;
  fix.measured.set(error::kX).set(error::kY).set(error::kHeading);
  fix.covariance *= 0.01;
  for (auto _ : state) {
    filter.Capture(fix.capture);
    fix.pose[error::kX] = filter.estimate().pose.x_m;
    fix.pose[error::kY] = filter.estimate().pose.y_m;
    fix.pose[error::kHeading] = filter.estimate().pose.heading_rad;
    benchmark::DoNotOptimize(filter.Update(fix));
    filter.Forget(fix.capture++);
  }
  Label(state, filter);
}
BENCHMARK(BM_Update)->Arg(0)->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rockyard::localization
