// The experiment "cylinder_sighting": where finders see the coloured cylinder, in rendered images.
//
// One run is a block of views of one cell, each measured several times with new noise; run i
// belongs to cell i modulo their number, so that every prefix of the runs covers the cells evenly.
// All finders are given the same images. Its record holds the factors, then counts and sums; its
// outcome is `measured`.
#pragma once

#include "core/random.h"
#include "experiments/cell_table.h"
#include "experiments/cylinder_sighting/cylinder_sighting_params.h"
#include "experiments/cylinder_sighting/sighting_sums.h"
#include "experiments/experiment.h"
#include "rendering/cylinder/cylinder_scene.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column but the number of the cell: the factors that may name a cell, then the sums of
// SightingSums in their order.
const truth::RecordSchema& CylinderSightingColumns();

// A view of a cell: what is before the cameras, and what finders are told.
struct StudiedView {
  rendering::CylinderPictureParams picture;
  rendering::CylinderView view;
  vision::PublishedFinderParams published;
  vision::RobustFinderParams robust;
};

class CylinderSightingExperiment final : public Experiment {
 public:
  explicit CylinderSightingExperiment(const CylinderSightingParams& params);

  const truth::RecordSchema& schema() const override { return schema_; }
  // Cost: 50 to 110 ms a view, 15 ms a measurement and what the finders take. Randomness:
  // kExperiment for what a view draws, and the streams of rendering/cylinder, under a key of each
  // view.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

  // The view of that key in a cell: orientation, sun, bearing and distance as the parameters draw
  // them. Finders know the third colour, and no row above the horizon is theirs.
  StudiedView Draw(std::size_t cell, core::TrialKey key) const;

 private:
  SightingSums Measure(std::size_t cell, core::TrialKey key) const;

  CylinderSightingParams params_;
  CellTable table_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
