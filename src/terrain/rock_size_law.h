// Distributions of rock diameters. Layouts draw by them; audits of fields and the blind swath
// expect what their closed forms say. Records depend on the bits of Diameter alone.
#pragma once

#include <memory>

#include "terrain/rock_params.h"

namespace rockyard::terrain {

// The distribution of one rock's diameter. Rocks are drawn by Diameter, and expected by Cdf and
// MeanPower: all three must describe one law.
class RockSizeLaw {
 public:
  virtual ~RockSizeLaw() = default;

  // Returns the diameter, m, below which a share 0 < probability < 1 of the rocks lies: the inverse
  // distribution function.
  virtual double Diameter(double probability) const = 0;
  // Returns the share of rocks with diameters up to diameter_m.
  virtual double Cdf(double diameter_m) const = 0;
  // Returns the mean of D^power over rocks, m^power.
  virtual double MeanPower(double power) const = 0;
};

// Moore's law truncated to [min_m, max_m].
class MooreSizeLaw : public RockSizeLaw {
 public:
  MooreSizeLaw(double min_m, double max_m);
  double Diameter(double probability) const override;
  double Cdf(double diameter_m) const override;
  double MeanPower(double power) const override;

 private:
  double min_m_;
  double max_m_;
  double number_at_min_;  // of the law with k = 1, per m2
  double number_at_max_;
};

// Golombek and Rapp's law of that cover truncated to [min_m, max_m].
class GolombekSizeLaw : public RockSizeLaw {
 public:
  GolombekSizeLaw(double cover, double min_m, double max_m);
  double Diameter(double probability) const override;
  double Cdf(double diameter_m) const override;
  // The power must be whole and at least 0.
  double MeanPower(double power) const override;

 private:
  double cover_;
  double decay_per_m_;
  double min_m_;
  double max_m_;
  double number_at_min_;  // of the law, per m2
  double number_at_max_;
};

// Diameters are uniform between min_m and max_m.
class UniformSizeLaw : public RockSizeLaw {
 public:
  UniformSizeLaw(double min_m, double max_m);
  double Diameter(double probability) const override;
  double Cdf(double diameter_m) const override;
  double MeanPower(double power) const override;

 private:
  double min_m_;
  double max_m_;
};

// Returns the law of the random rocks (RandomKind); kNone has none (nullptr).
std::unique_ptr<RockSizeLaw> MakeSizeLaw(const RockFieldParams& params);
// Returns the law of the reference field, by which rocks are drawn before thinning: another one for
// kGolombek, whose sizes depend on the cover.
std::unique_ptr<RockSizeLaw> MakeReferenceSizeLaw(const RockFieldParams& params);

}  // namespace rockyard::terrain
