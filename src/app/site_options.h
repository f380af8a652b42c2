// Options of `rockyard terrain` that bring a place into a scenario: an elevation model, a catalogue
// of rocks, sites of a model by their slopes, laws that fit a catalogue.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rockyard::app {

struct SiteOptions {
  std::string dem;
  std::string crop;
  std::string at;
  double size_m = 60.0;
  std::string crs;
  std::optional<double> cell_m;
  std::optional<double> height_scale;
  bool fill = false;
  std::optional<double> resolution_m;
  std::string credit;
  bool no_roughness = false;
  std::string start;
  std::string goal;
  std::string rocks;
  std::string columns;
  std::string rock_places;
  std::string around;
  std::optional<double> radius_m;
  bool keep_bumps = false;
  bool rest = false;
  bool scan = false;
  std::string slope_median;
  std::string slope_high;
  int count = 10;
  std::string fit;
  std::optional<double> area_m2;
  std::optional<double> max_diameter_m;

  // Whether a scenario of a place is asked for.
  bool MakesScenario() const { return !dem.empty() || !rocks.empty(); }
};

// Adds the options. `options` must outlive the command.
void AddSiteOptions(CLI::App& command, SiteOptions& options);

// Writes the scenario of a place to `out` and prints what it has. `scenario` is a word for a
// scenario file. Throws core::UserError, also where `out` is there.
void WriteSite(const SiteOptions& options, const std::string& scenario,
               const std::vector<std::string>& overrides, const std::string& out);

// Prints the sites of a model.
void ShowSites(const SiteOptions& options);

// Prints which laws fit a catalogue whose smallest complete diameter is given.
void ShowRockFit(const SiteOptions& options, std::optional<double> min_diameter_m);

}  // namespace rockyard::app
