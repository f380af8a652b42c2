#!/bin/sh
# From a fresh Debian 12 to the comparison with the published trials, in one command:
# installs what is missing, builds, runs the published Pathfinder scenarios, prints the table and
# writes a page for a browser.
#
# Usage: scripts/quickstart.sh [OPTION]...
#   Options go to `rockyard run`, for example --trials 50 --seed 2 --threads 1 (default: 300 trials).
#   --out DIR   where the run folders go (default: results/runs/quickstart; with options that
#               change the results, a folder of its own beside it)
#
# Safe to repeat: only what changed is built, runs that were interrupted go on, finished runs stay;
# runs of another scenario or another build of the program are set aside, never deleted.
# Exit code: that of the first step that fails; a comparison that differs is no failure.
set -eu
cd "$(dirname "$0")/.."

# What the comparison needs: the four published sets of trials, then the runs that it refers to.
scenarios="obstacles_0.28 obstacles_0.57 obstacles_0.85 nominal nominal_perfect_localization level_sand"
reference=results/reference/matthies1995.json

trials="--trials 300"
out=""
settings=""
take=""
for word in "$@"; do
  shift
  case "$take" in
    out) out=$word; take=""; continue ;;
    setting) settings="$settings $word"; take="" ;;
    other) take="" ;;
    *)
      case "$word" in
        -h | --help) sed -n '2,14s/^# \{0,1\}//p' "$0"; exit 0 ;;
        --out) take=out; continue ;;
        --out=*) out=${word#--out=}; continue ;;
        --trials) trials=""; take=other ;;
        --trials=*) trials="" ;;
        --threads) take=other ;;
        --threads=*) ;;
        --seed | --set) settings="$settings $word"; take=setting ;;
        *) settings="$settings $word" ;;
      esac
      ;;
  esac
  set -- "$@" "$word"
done
if [ -z "$out" ]; then
  out=results/runs/quickstart
  if [ -n "$settings" ]; then
    out="$out-$(printf '%s' "$settings" | cksum | cut -d ' ' -f 1)"
  fi
fi

say() { printf '\n== %s\n' "$*"; }

say "Packages"
scripts/install_dependencies.sh build pages

say "Build"
if [ -f build/release/CMakeCache.txt ]; then
  cmake --preset release > /dev/null
else
  cmake --preset release -DROCKYARD_BUILD_TESTS=OFF -DROCKYARD_BUILD_BENCHMARKS=OFF
fi
cmake --build --preset release --target rockyard
rockyard=build/release/bin/rockyard

runs=""
for scenario in $scenarios; do
  file=scenarios/pathfinder/$scenario.json
  say "Trials of $scenario"
  # Goes on with the run that lies there; sets it aside where the scenario or the program changed.
  # shellcheck disable=SC2086  # a list of words
  "$rockyard" run "$file" --out "$out/$scenario" --resume --force $trials "$@"
  runs="$runs $out/$scenario"
done

say "Comparison with the published trials"
# shellcheck disable=SC2086
"$rockyard" check $runs --against "$reference" && verdict=0 || verdict=$?
case "$verdict" in
  0 | 1 | 4) ;;
  *) exit "$verdict" ;;
esac

say "A page to look at"
page="$out/report.html"
"$rockyard" report "$out/nominal" "$out/nominal_perfect_localization" --against "$reference" \
  --out "$page" && written=0 || written=$?
case "$written" in
  0) ;;
  2) page="" ;;  # said by the program: built without npm, it has no pages
  *) exit "$written" ;;
esac

say "Results"
echo "The run folders are in $out: summary.json, trials.csv, distance_cdf.csv, results.sqlite."
if [ -n "$page" ]; then
  echo "With and without dead-reckoning errors, and replays of the worst trials: $page (open it in a browser)."
fi
echo "Any other trial as a 3-D replay: $rockyard replay $out/nominal --trial 1"
echo "Run scripts/quickstart.sh again to go on after an interruption."
