#include "app/examples.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace rockyard::app {
namespace {

constexpr CommandExample kExamples[] = {
    {"run", "rockyard run scenarios/pathfinder/nominal.json --trials 300 --out results/runs/first",
     "300 trials into a folder of their own"},
    {"run", "rockyard run nominal --until-half-width 0.02",
     "as many trials as the success rate to 2 % takes"},
    {"run",
     "rockyard run scenarios/pathfinder/vl2.json --set perception.hazard.enabled=false --trials 50",
     "with a changed setting"},
    {"sweep", "rockyard sweep scenarios/sweeps/abundance.json --trials 100",
     "every cell of a sweep file"},
    {"sweep", "rockyard sweep abundance --dry-run",
     "what it would cost; runs a few trials and writes the plan"},
    {"check", "rockyard check results/runs/first --against results/reference/matthies1995.json",
     "runs against the published values"},
    {"check", "rockyard check results/runs/first --against results/baselines/regression.json --all",
     "runs against a baseline, equivalent metrics too"},
    {"baseline", "rockyard baseline results/runs/first --out baseline.json --reason first",
     "keeps a run to check later builds against"},
    {"compare", "rockyard compare results/runs/first results/runs/second",
     "trial by trial where their seeds are the same"},
    {"merge", "rockyard merge parts/1 parts/2 --out results/runs/whole",
     "the parts of `rockyard run --shard`"},
    {"report", "rockyard report results/runs/first", "a page for a browser beside the run"},
    {"report", "rockyard report results/runs/first results/runs/second --out both.html",
     "two runs, compared with the first"},
    {"rover", "rockyard rover scenarios/pathfinder/nominal.json", "sizes, masses, wheel loads"},
    {"rover", "rockyard rover scenarios/pathfinder/nominal.json --out rocky_3_2.urdf",
     "as a URDF file"},
    {"rover", "rockyard rover mine.urdf --out mine.json",
     "a rover file of a URDF file, for scenarios to extend"},
    {"mobility", "rockyard mobility nominal --out mobility",
     "charts and tables of the rover of a scenario on three soils"},
    {"mobility", "rockyard mobility mine.urdf --soil mars_drift --slopes 0:30:2 --draws 0",
     "of another rover on one soil, without bands"},
    {"mobility", "rockyard mobility nominal --load 1 --load 1.5 --points measured.csv --out loads",
     "of two loads, with measured points drawn in"},
    {"bench", "rockyard bench run examples/bench/gestalt.json --layouts 2 --out bench/gestalt",
     "an entry over two layouts of each cell"},
    {"bench", "rockyard bench report bench/gestalt bench/mine --out bench/table",
     "entries beside the first of them"},
    {"bench", "rockyard bench verify bench/mine --sample 300", "the chain, and 300 drives again"},
    {"terrain", "rockyard terrain scenarios/pathfinder/vl2.json --trial 3 --out field.svg",
     "a picture of one trial's rocks"},
    {"terrain", "rockyard terrain --dem dtm.tif --scan-sites --size 60 --slope-median 4..8",
     "parts of an elevation model with such slopes"},
    {"terrain",
     "rockyard terrain gestalt/abundance --dem dtm.tif --at -4.59,137.44 --size 60 --out site.json",
     "a scenario of one of them"},
    {"render", "rockyard render gestalt/abundance --out pair",
     "what the rover's front cameras see at the start"},
    {"render",
     "rockyard render gestalt/abundance --out pair --x 3 --set sensors.sun.elevation_deg=15",
     "from elsewhere, under a low sun"},
    {"render", "rockyard render gestalt/abundance --out way --pairs 12 --step-m 0.25",
     "a sequence of pairs on a way of 2.75 m"},
    {"stereo", "rockyard stereo left.png right.png --out pair",
     "disparities of a pair whose rows are aligned"},
    {"stereo", "rockyard stereo left.png right.png --cameras cameras.json --nearest 1 --out pair",
     "points and a map of what is 1 m away or farther"},
    {"stereo",
     "rockyard stereo left.png right.png --reference truth.png --reference-samples 4 --out pair",
     "how many of the matches are wrong"},
    {"vo", "rockyard vo way --cameras way/cameras.json --truth way/poses.txt --out path",
     "the path of a sequence that rockyard render took, and its errors"},
    {"vo", "rockyard vo sequences/00 --truth poses/00.txt --out path",
     "of KITTI's layout, with the cameras of its calib.txt"},
    {"vo", "rockyard vo MH_01_easy --cameras cameras.json --every 2 --out path",
     "every second pair of a sequence of EuRoC"},
    {"cylinder", "rockyard cylinder left.png right.png --cameras cameras.json --out seen",
     "where the cylinder is, with a picture of its regions"},
    {"cylinder", "rockyard cylinder left.png right.png --cameras cameras.json --published",
     "as Matthies 1995 did it"},
    {"calibrate", "rockyard calibrate board*.png --target board.json --out camera",
     "one camera from images of a chessboard"},
    {"calibrate",
     "rockyard calibrate left*.png --right right*.png --target board.json --out cameras",
     "a pair for rockyard stereo --cameras cameras/cameras.json"},
    {"trace", "rockyard trace results/runs/first --trial 0 --svg trial.svg",
     "what happened in a trial, and a plan view"},
    {"trace", "rockyard trace scenarios/pathfinder/nominal.json --trial 7 --csv trial.csv",
     "a trial that need not have been run before"},
    {"trace", "rockyard trace results/runs/first --trial 0 --mcap trial.mcap",
     "for Foxglove and other readers of MCAP"},
    {"replay", "rockyard replay results/runs/first --trial 0", "one trial of a run again"},
    {"replay", "rockyard replay results/runs/first --trial 0 --scan 12 --out scan",
     "one scan of it as pictures"},
    {"validate", "rockyard validate scenarios/pathfinder/nominal.json",
     "whether a scenario can be run"},
    {"validate", "rockyard validate gestalt/abundance vl2", "those of these names"},
    {"defaults", "rockyard defaults", "every setting of a scenario, with its default"},
    {"schema", "rockyard schema", "what editors check scenario files with"},
    {"list", "rockyard list", "scenarios and sweeps"},
    {"list", "rockyard list scenarios/pathfinder --json", "of one folder, for programs"},
    {"list", "rockyard list --ablations", "what `rockyard run --ablate` takes away"},
    {"parameters", "rockyard parameters scenarios/pathfinder/nominal.json --origin assumed",
     "the settings that rest on an assumption"},
    {"parameters", "rockyard parameters --search slope", "the settings about slopes"},
    {"plan", "rockyard plan half-width --half-width 0.02 --rate 0.9",
     "trials for a rate of 90 % to 2 %"},
    {"plan", "rockyard plan claim --below 0.01", "trials that show a rate below 1 %"},
    {"metrics", "rockyard metrics", "what of a trial is measured"},
    {"metrics", "rockyard metrics mine.json", "and what the navigators of a scenario count"},
    {"new", "rockyard new navigator mine",
     "in C++: source, build file, scenario and README in mine"},
    {"new", "rockyard new navigator mine --python --out work/mine",
     "in Python, in a folder of another name"},
    {"help", "rockyard help run", "all of a command, with examples"},
    {"completion", "eval \"$(rockyard completion bash)\"", "in this shell; ~/.bashrc keeps it"},
    {"completion", "rockyard completion zsh > \"${fpath[1]}/_rockyard\"", "for zsh"},
    {"completion", "rockyard completion fish > ~/.config/fish/completions/rockyard.fish",
     "for fish"},
};

}  // namespace

std::span<const CommandExample> Examples() { return kExamples; }

std::string ExampleText(std::string_view command) {
  std::string text;
  for (const CommandExample& example : Examples()) {
    if (example.command != command) continue;
    text += fmt::format("  {}\n      {}\n", example.line, example.what);
  }
  return text.empty() ? "" : fmt::format("Examples:\n{}\n", text);
}

void AddExamples(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    command->footer(ExampleText(command->get_name()) + command->get_footer());
  }
}

}  // namespace rockyard::app
