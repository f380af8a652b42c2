#!/bin/sh
# From a fresh Debian 12 to the comparison with the published trials, in one command:
# installs what is missing, builds the command, runs 40 quick trials and writes their page, then runs the
# published Pathfinder scenarios, prints the comparison and writes its page.
#
# Usage: scripts/quickstart.sh [OPTION]...
#   Options go to `rockyard run`, for example --trials 50 --seed 2 --threads 1 (default: 40 trials for
#   the first page, then 300 of each scenario).
#   --first     end with the first page
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
few="--trials 40"
first=no
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
        -h | --help) sed -n '2,16s/^# \{0,1\}//p' "$0"; exit 0 ;;
        --first) first=yes; continue ;;
        --out) take=out; continue ;;
        --out=*) out=${word#--out=}; continue ;;
        --trials) trials=""; few=""; take=other ;;
        --trials=*) trials=""; few="" ;;
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

tell_path() {
  echo "So that your shell finds rockyard: export PATH=\"$PWD/build/release/bin:\$PATH\""
}
say() { printf '\n== %s\n' "$*"; }

say "What comes"
echo "Missing packages (some 80 on a bare Debian 12, 106 MB to fetch), a build, 40 drives and a first page to
look at, which takes some minutes; then 1,800 drives, some minutes more. Disk: 0.7 GB, packages included.
Interrupt it when you like: it goes on where it was."

say "Packages"
scripts/install_dependencies.sh build

say "Build"
if [ -f build/release/CMakeCache.txt ]; then
  cmake --preset release > /dev/null
else
  cmake --preset release -DROCKYARD_BUILD_TESTS=OFF -DROCKYARD_BUILD_BENCHMARKS=OFF > /dev/null
fi
cmake --build --preset release --target rockyard
rockyard=build/release/bin/rockyard

# Goes on with the run that lies there; sets it aside where the scenario or the program changed.
run() {
  name=$1; shift
  "$rockyard" run "scenarios/pathfinder/$name.json" --resume --force "$@"
}

say "A first look: nominal terrain, simplified physics"
# shellcheck disable=SC2086  # a list of words
run nominal --out "$out/first_look" --set rover.fidelity=quasi_static $few "$@"
"$rockyard" report "$out/first_look" --out "$out/first_look.html"
echo "Open $out/first_look.html in a browser."
if [ "$first" = yes ]; then
  tell_path
  exit 0
fi

runs=""
for scenario in $scenarios; do
  say "Trials of $scenario"
  # shellcheck disable=SC2086  # a list of words
  run "$scenario" --out "$out/$scenario" $trials "$@"
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
  --out "$page"

say "Results"
echo "The run folders are in $out: summary.json, trials.csv, distance_cdf.csv, results.sqlite."
echo "With and without dead-reckoning errors, and replays of the worst trials: $page (open it in a browser)."
echo "Any other trial as a 3-D replay: $rockyard replay $out/nominal --trial 1"
echo "Run scripts/quickstart.sh again to go on after an interruption."
tell_path
