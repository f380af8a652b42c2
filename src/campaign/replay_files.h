// The files that show one scan or one step of a trial that was run again.
#pragma once

#include <filesystem>
#include <vector>

#include "campaign/looks/look_capture.h"
#include "campaign/looks/look_files.h"
#include "campaign/scan_capture.h"
#include "messages/point_cloud.h"
#include "report/navigation_drawing.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// A decision of a map-based navigator, and the last points that it rests on.
struct CapturedStep {
  report::NavigationPicture picture;
  messages::PointCloud cloud;
  std::vector<CapturedLook> looks;  // on which it rests; none where there are no images
};

// Each makes the folder and writes into it; throws core::UserError or
// std::filesystem::filesystem_error.
//
// PNG images of every exposure (lit, dark, difference), array.svg, points.csv, the scenario.
void WriteScanFiles(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                    const CapturedScan& captured);
// step.svg, map.csv, votes.csv, points.csv, the scenario. Of stereo cameras also what they saw: the
// files that it gives back (looks/look_files.h).
std::vector<LookFile> WriteStepFiles(const std::filesystem::path& folder,
                                     const scenario::Scenario& scenario,
                                     const CapturedStep& captured);

}  // namespace rockyard::campaign
