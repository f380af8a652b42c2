// What looks take on every computer, as CSV: scripts/studies/rover_speed/rover_speed.py reads
// results/studies/compute_times.csv, which this prints. Cells of 20 cm on 9 m x 9 m; nothing
// stated, so that acquisition is what suits the computer.

#include <iostream>

#include "core/fields.h"
#include "trial/clock/compute_profile.h"
#include "trial/clock/compute_tables.h"

namespace rockyard::trial {
namespace {

constexpr GridSize kGrid{.cell_m = kAthenaCell_m, .area_m2 = kTable3Area_m2};

void Print(std::size_t index, double width_px) {
  ComputeParams params{.computer = static_cast<Computer>(index)};
  params.acquisition_s = params.SuitedAcquisition_s();
  const ComputeTimes times = MakeComputeTimes(params, kGrid, width_px);
  std::cout << core::EnumNames<Computer>::kNames[index] << ',' << width_px << ','
            << times.acquisition_s << ',' << times.stereo_s << ',' << times.navigation_s << ','
            << VisualTimeOf(params).computing_s << '\n';
}

}  // namespace
}  // namespace rockyard::trial

int main() {
  std::cout.precision(10);
  std::cout << "computer,width_px,acquisition_s,stereo_s,navigation_s,visual_s\n";
  for (std::size_t i = 1; i < rockyard::core::EnumNames<rockyard::trial::Computer>::kNames.size();
       ++i) {
    for (const double width_px : {256.0, 512.0}) rockyard::trial::Print(i, width_px);
  }
  return 0;
}
