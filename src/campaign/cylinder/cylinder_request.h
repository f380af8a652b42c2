// What `rockyard cylinder` is asked for, and what comes out.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "core/fields.h"
#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/published_finder_params.h"
#include "vision/cylinder/robust_finder_params.h"

namespace rockyard::campaign {

enum class CylinderFinder {
  kRobust,     // vision/cylinder/robust_finder.h
  kPublished,  // vision/cylinder/published_finder.h
};

struct CylinderParams {
  vision::ColourCylinder cylinder;
  vision::RobustFinderParams robust;
  vision::PublishedFinderParams published;

  void Visit(core::FieldVisitor& v);
};

struct CylinderRequest {
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path cameras;
  std::filesystem::path out;  // a folder, which is made; empty: no files
  ExistingFiles existing = ExistingFiles::kRefuse;
  CylinderFinder finder = CylinderFinder::kRobust;
  std::vector<std::string> settings;  // PATH=VALUE of CylinderParams
};

struct CylinderResult {
  CylinderParams params;
  std::array<std::string, 2> read;  // what was read and done, left and right
  vision::CylinderFinding finding;
  std::vector<OutputFile> files;
};

}  // namespace rockyard::campaign
