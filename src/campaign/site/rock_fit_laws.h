// Both laws of Mars over the window of a catalogue: what they let expect, how likely they make it,
// catalogues of their own. Steps of FitRockLaws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "campaign/site/rock_fit.h"
#include "core/random.h"
#include "statistics/proportions.h"
#include "terrain/rock_size_law.h"

namespace rockyard::campaign {

// All that the laws need of a catalogue: its number of rocks, sums of D and of ln D, counts by
// class of sizes.
struct RockCounts {
  explicit RockCounts(std::size_t classes) : by_class(classes, 0) {}

  std::int64_t rocks = 0;
  double sum_m = 0.0;
  double sum_of_logs = 0.0;
  std::vector<std::int64_t> by_class;
};

// A window with its classes: their bounds are a factor of sqrt 2 apart, the last one ends at max_m.
class ClassedWindow {
 public:
  explicit ClassedWindow(const RockWindow& window);

  const RockWindow& limits() const { return window_; }
  const std::vector<double>& bounds_m() const { return bounds_m_; }
  std::size_t classes() const { return bounds_m_.size() - 1; }

  // Adds a rock of min_m <= diameter_m <= max_m.
  void Count(double diameter_m, RockCounts& counts) const;

 private:
  RockWindow window_;
  std::vector<double> bounds_m_;
};

// A law whose parameter was fitted.
struct FittedLaw {
  double k = 0.0;
  double log_likelihood = 0.0;
};

// One of both laws over a window.
class WindowLaw {
 public:
  explicit WindowLaw(const ClassedWindow& window) : window_(window) {}
  virtual ~WindowLaw() = default;

  virtual std::unique_ptr<terrain::RockSizeLaw> Sizes(double k) const = 0;
  virtual FittedLaw Fit(const RockCounts& counts) const = 0;
  virtual statistics::Interval IntervalOf(const FittedLaw& fitted,
                                          const RockCounts& counts) const = 0;

  // Returns the mean number of rocks of the window between two diameters, or of all.
  double Expected(double k, double from_m, double to_m) const;
  double Expected(double k) const;
  // Returns a catalogue of the law's own.
  RockCounts Simulate(double k, core::RandomStream stream) const;
  // Returns 2 sum (o ln (o / e) - (o - e)) over the classes.
  double Deviance(double k, const RockCounts& counts) const;

 protected:
  // Returns the number per m2 of rocks of at least that diameter.
  virtual double NumberPerM2(double k, double diameter_m) const = 0;
  const ClassedWindow& window() const { return window_; }

 private:
  const ClassedWindow& window_;
};

// Moore's law of k per m2 at 1 m.
class MooreWindowLaw : public WindowLaw {
 public:
  using WindowLaw::WindowLaw;
  std::unique_ptr<terrain::RockSizeLaw> Sizes(double k) const override;
  FittedLaw Fit(const RockCounts& counts) const override;
  statistics::Interval IntervalOf(const FittedLaw& fitted, const RockCounts& counts) const override;

 protected:
  double NumberPerM2(double k, double diameter_m) const override;
};

// Golombek and Rapp's law; k is the cover.
class GolombekWindowLaw : public WindowLaw {
 public:
  // Covers that are looked at. By the smallest no place has rocks of a decimetre.
  static constexpr double kLeastCover = 0.0005;
  static constexpr double kMostCover = 1.0;

  using WindowLaw::WindowLaw;
  std::unique_ptr<terrain::RockSizeLaw> Sizes(double k) const override;
  FittedLaw Fit(const RockCounts& counts) const override;
  statistics::Interval IntervalOf(const FittedLaw& fitted, const RockCounts& counts) const override;
  double LogLikelihood(double k, const RockCounts& counts) const;

 protected:
  double NumberPerM2(double k, double diameter_m) const override;

 private:
  // Returns the cover between the most likely one and the bound at which ln L has dropped enough;
  // the bound where it has not.
  double EndOfLikely(const FittedLaw& fitted, double bound, const RockCounts& counts) const;
};

}  // namespace rockyard::campaign
