#!/bin/sh
# Whether trials come out the same bit for bit at another optimization level and on other numbers of
# threads: builds the command with -O2 and with -O3 (one compiler, this CPU), drives the nominal
# Pathfinder scenario in both fidelities on 1 and on 2 threads, and compares the trial hashes.
#
# Usage: scripts/same_bits.sh [OPTION]...
#   --trials N   trials of each run (default: 20)
#   --jobs N     compile N files at a time (default: the number of processors)
# Builds stay in build/same_bits, runs in build/same_bits/runs; nothing else is touched. About two
# minutes of driving, and two builds of the command the first time.
# Exit code: 0 if the hashes of each fidelity agree, 1 if not, else that of what failed.
set -eu
cd "$(dirname "$0")/.."

trials=20
jobs=$(nproc)
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --trials | --jobs)
      [ $# -ge 2 ] || { echo "same_bits: $1 needs a value" >&2; exit 2; }
      if [ "$1" = --trials ]; then trials=$2; else jobs=$2; fi
      shift 2
      ;;
    *) echo "same_bits: unknown option $1 (try --help)" >&2; exit 2 ;;
  esac
done

folder=build/same_bits
mkdir -p "$folder/runs"
for level in O2 O3; do
  # -w: gcc's warnings depend on the level, and they are the test build's matter.
  cmake -S . -B "$folder/$level" -G Ninja -DCMAKE_BUILD_TYPE=Release -DROCKYARD_PAGES=OFF \
    -DCMAKE_CXX_FLAGS_RELEASE="-$level -DNDEBUG -w" \
    -DROCKYARD_BUILD_TESTS=OFF -DROCKYARD_BUILD_BENCHMARKS=OFF > "$folder/$level.log" 2>&1 ||
    { cat "$folder/$level.log" >&2; exit 1; }
  cmake --build "$folder/$level" --target rockyard -j "$jobs"
done

"$folder/O2/bin/rockyard" --version
differs=0
for fidelity in multibody quasi_static; do
  first=""
  for level in O2 O3; do
    for threads in 1 2; do
      run=$folder/runs/$fidelity-$level-$threads
      "$folder/$level/bin/rockyard" run scenarios/pathfinder/nominal.json \
        --set "rover.fidelity=$fidelity" --trials "$trials" --threads "$threads" --force \
        --out "$run" > "$run.log" 2>&1 || { code=$?; cat "$run.log" >&2; exit "$code"; }
      hash=$(sed -n 's/.*"trial_hash": "\([0-9a-f]*\)".*/\1/p' "$run/summary.json")
      [ -n "$hash" ] || { echo "same_bits: no trial hash in $run/summary.json" >&2; exit 1; }
      verdict=same
      if [ "$hash" != "${first:=$hash}" ]; then verdict=DIFFERS; differs=1; fi
      printf '%-14s -%s  %s thread(s)  %s  %s\n' "$fidelity" "$level" "$threads" "$hash" "$verdict"
    done
  done
done
exit "$differs"
