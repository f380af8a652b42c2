#include "campaign/derived_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "batch/run_folder.h"
#include "core/machine_error.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// As report/run_files.h and report/sweep_files.h write them, and the folder of campaign_traces.h.
constexpr std::array kDerivedFiles = {
    "attribution.csv", "cells.csv",        "cells.svg",
    "curves.csv",      "distance_cdf.csv", "differences.csv",
    "fit.csv",         "fits.csv",         "scenario.resolved.json",
    "success.svg",     "summary.json",     "sweep.json",
    "traces",          "trials.csv"};

// As `rockyard report` names them where it is told no other name: of the run, but written later.
constexpr std::array kReportFiles = {"report.html", "report_replays"};

fs::path FreeName(const fs::path& folder, const fs::path& name) {
  for (int number = 1;; ++number) {
    fs::path aside =
        fmt::format("{}.old-{}{}", name.stem().string(), number, name.extension().string());
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder / aside, error))) return aside;
  }
}

void SetAside(const fs::path& folder, const fs::path& name, std::vector<std::string>& names) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder / name, error))) return;
  const fs::path aside = FreeName(folder, name);
  fs::rename(folder / name, folder / aside, error);
  if (error) core::FailOnDisk(folder / name, "cannot be set aside", error);
  names.push_back(aside.string());
}

}  // namespace

bool IsRunFile(const fs::path& name) {
  return name == batch::kStoreFile ||
         std::find(kDerivedFiles.begin(), kDerivedFiles.end(), name) != kDerivedFiles.end();
}

std::vector<std::string> SetDerivedFilesAside(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path name : kDerivedFiles) SetAside(folder, name, names);
  for (const fs::path name : kReportFiles) SetAside(folder, name, names);
  return names;
}

}  // namespace rockyard::campaign
