// Which law of Mars fits the rocks of a catalogue: Moore's with its exponent of 2.66, or Golombek
// and Rapp's, each with one parameter. For whoever makes a scenario of a site. Nothing that runs
// depends on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::campaign {

// The part of a catalogue that is complete: all rocks with min_m <= D < max_m on area_m2.
struct RockWindow {
  double area_m2 = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
};

// A law at its most likely parameter.
struct LawFit {
  double k = 0.0;                 // Moore's k, per m2 at 1 m; or Golombek's cover
  statistics::Interval interval;  // 95 %
  bool at_bound = false;          // k is the smallest or largest that is looked at
  double expected_cover = 0.0;    // share of the ground under round rocks within the window
  double log_likelihood = 0.0;    // of the Poisson process; the constant is that of both laws
  double fit_p = 0.0;             // that the law's own catalogues are as far off in size classes
  double against_p = 0.0;         // that they speak as much for the other law as this one does
};

// Rocks of one class of sizes.
struct RockClass {
  double from_m = 0.0;
  double to_m = 0.0;
  std::int64_t observed = 0;
  statistics::Interval interval;  // of the mean of such counts, exact, 95 %
  double expected_moore = 0.0;
  double expected_golombek = 0.0;
};

// Which law the catalogue speaks for, at 5 %.
enum class LawVerdict { kBoth, kMoore, kGolombek, kNeither };

struct RockFit {
  RockWindow window;
  std::int64_t rocks = 0;     // within the window
  std::int64_t left_out = 0;  // outside
  LawFit moore;
  LawFit golombek;
  std::vector<RockClass> classes;
  LawVerdict verdict = LawVerdict::kBoth;
  std::string sentence;  // the verdict in words
  int catalogues = 0;    // simulated under each law
};

// Fits both laws by maximum likelihood of an inhomogeneous Poisson process, n rocks of diameters
// D_i within a window of area A:
//   ln L(k) = sum ln n_k(D_i) - A (N_k(min) - N_k(max)).
// Moore: k = n / (A (min^-2.66 - max^-2.66)), with Garwood's exact interval. Golombek: the cover
// from 0.0005 to 1 of greatest ln L; its interval are the covers whose ln L is at most 1.92 below
// (profile likelihood). Laws are compared by the difference of ln L, its distribution under either
// law by a parametric bootstrap: `samples` catalogues of the fitted law, fitted anew by both. The
// same catalogues tell how far counts by size class (bounds a factor of sqrt 2 apart) are from
// their means, by the deviance 2 sum (o ln (o / e) - (o - e)). P-values are (1 + those as far off)
// / (1 + samples). A verdict holds a law for refuted where either is below 0.025, so that a true
// law is refuted in 5 % of catalogues. Deterministic in the seed. Cost: about a microsecond for
// each rock and sample. Throws core::UserError where the window is none or holds fewer than 5
// rocks.
RockFit FitRockLaws(std::span<const double> diameters_m, const RockWindow& window,
                    std::uint64_t seed, int samples = 999);

// Returns the fit as a table for people, with a line of advice that names the parameters of a
// scenario.
std::string RockFitText(const RockFit& fit);
// Returns its size classes as CSV: from_m, to_m, observed, low, high, moore, golombek.
std::string RockFitCsv(const RockFit& fit);

}  // namespace rockyard::campaign
