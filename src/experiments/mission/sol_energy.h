// The energy of one sol: what the sun and the batteries gave, and what became of it.
#pragma once

#include <array>

#include "trial/drive_start.h"
#include "trial/power_budget.h"
#include "trial/solar_supply.h"

namespace rockyard::experiments {

// Wh. Sources and sinks add up to the same.
struct SolEnergy {
  // Sinks.
  std::array<double, trial::kActivityCount> drive_wh{};  // by activity of the drive
  double idle_wh = 0.0;
  double transmit_wh = 0.0;  // modem and the rover that is awake meanwhile
  double sleep_wh = 0.0;
  // Sources.
  double sun_wh = 0.0;
  double battery_wh = 0.0;
  double overdrawn_wh = 0.0;  // that a drive took from batteries which had just become empty

  double sun_available_wh = 0.0;  // what the cells could have given

  double Drive() const;
  double Sinks() const { return Drive() + idle_wh + transmit_wh + sleep_wh; }
  double Sources() const { return sun_wh + battery_wh + overdrawn_wh; }

  SolEnergy& operator+=(const SolEnergy& other);
};

// Keeps the books of one sol, whose time 0 is the opening of its window.
class SolBooks {
 public:
  // `battery_wh`: what the batteries hold at the beginning.
  SolBooks(const trial::SolarSupply& sun, double battery_wh);

  // A drive, by its own ledger, which knew the same sun and batteries.
  void AddDrive(const trial::DriveEnd& drive);
  // A steady load from begin_s to end_s, added to `sink`. With empty batteries it takes what the
  // sun gives of it: what is off then, is off.
  void AddLoad(double load_W, double begin_s, double end_s, double& sink_wh);

  SolEnergy& energy() { return energy_; }
  double battery_wh() const { return battery_wh_; }

 private:
  trial::SolarSupply sun_;
  double battery_wh_;
  SolEnergy energy_;
};

}  // namespace rockyard::experiments
