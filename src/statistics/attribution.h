// How much of the failure probability each of several functions accounts for, by a full factorial
// of paired trials in which every function is either as flown or perfect. Reports of sweeps along
// ablations take it from here. No record, verdict or exit code depends on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// The most functions that can be attributed to: a sweep along more ablations gets no attribution.
inline constexpr std::size_t kMaxFunctions = 8;

// A set of functions: bit i says that function i is perfect. 0 is the rover as flown.
using Combination = std::uint32_t;

// The outcomes of all 2^k combinations of equally many trials, 1 <= k <= kMaxFunctions.
// failed[combination][trial] is 1 where that trial failed; trial t has the same random numbers in
// every combination.
struct FactorialFailures {
  std::vector<std::string> functions;
  std::vector<std::vector<std::uint8_t>> failed;
  // The cluster of each trial: those of one cluster share a rock field. Where this is empty, all
  // trials are independent.
  std::vector<std::size_t> clusters = {};
};

// A number with its interval.
struct Estimate {
  double value = 0.0;
  Interval interval;
};

// A sum over combinations of weight times failure probability.
struct Contrast {
  std::vector<double> weights;  // by combination
};

// Returns the share of function i (Shapley 1953). With v(S) = P(fail as flown) - P(fail with the
// functions of S perfect), the failures that S removes, it is the mean over all k! orders in which
// functions are made perfect one after the other of what i removes when its turn comes,
//  sum over S without i of |S|! (k - |S| - 1)! / k! (v(S + i) - v(S)).
// The shares sum to v(all).
Contrast ShapleyShare(std::size_t functions, std::size_t i);

// Returns the effect of a set A of functions on the failure probability (Box, Hunter and Hunter
// 2005, ch. 5): 2^(1 - k) times the sum over combinations of the product of signs, + where a
// function of A is perfect and - where it is not. For one function that is the mean change of the
// failure probability when it is made perfect, over the settings of the others; for two it is half
// of how much that change differs with the other one perfect and as flown; and so on. It is 0 where
// functions do not interact.
Contrast FactorialEffect(std::size_t functions, Combination set);

// Returns what making `set` perfect removes by itself: v(set) of ShapleyShare.
Contrast Removed(std::size_t functions, Combination set);

// Returns the mean over trials of the contrast, with an interval. All contrasts here are linear in
// the failures, so that each trial has a value of its own between -1 and +1 and pairs are kept as
// pairs. The interval is AgrestiMinInterval: near nominal, and no point where all trials agree, as
// a bootstrap over trials would be. Where trials share clusters, it is the interval of as many
// independent values as say as much (ClusteredValues). Without trials the value is NaN and the
// interval [-1, 1].
Estimate Estimated(const FactorialFailures& failures, const Contrast& contrast,
                   double confidence = kConfidence);

// What one function accounts for, in three ways.
struct FunctionShare {
  std::string function;
  Estimate share;  // Shapley
  Estimate first;  // made perfect alone, all others as flown
  Estimate last;   // made perfect after all others
};

struct EffectOfSet {
  Combination set = 0;
  Estimate effect;
};

struct Attribution {
  std::size_t trials = 0;
  std::vector<std::string> functions;
  std::vector<Proportion> failures;   // by combination
  std::vector<FunctionShare> shares;  // by function
  Estimate removed;                   // v(all): what the shares sum to
  Proportion remainder;               // failures with all functions perfect
  double sum_of_firsts = 0.0;         // need not be v(all)
  std::vector<EffectOfSet> effects;   // main effects first, then by size of the set
};

// Returns the attribution of these failures. Intervals are pointwise. Cost: 4^k + 2^k k trials
// additions; a few ms for k = 4 and 1000 trials. Nothing is random.
Attribution Attribute(const FactorialFailures& failures, double confidence = kConfidence);

// Returns the names of a set, "designation x localization"; "as flown" for none.
std::string NameOf(Combination set, std::span<const std::string> functions,
                   std::string_view separator = " x ");

}  // namespace rockyard::statistics
