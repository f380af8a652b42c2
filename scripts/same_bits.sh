#!/bin/sh
# Whether trials come out the same bit for bit at another optimization level and on other numbers of
# threads: builds with -O2 the small program that hashes trials (tests/determinism), drives the
# nominal Pathfinder scenario in both fidelities on 1 and on 2 threads with it and with that of
# another build, and compares the hashes (one compiler, this CPU).
#
# Usage: scripts/same_bits.sh [OPTION]...
#   --against PROGRAM  hash_trials of the other build
#                      (default: build/test/tests/determinism/hash_trials, of preset test: -O3)
#   --trials N         trials of each run (default: 20)
#   --jobs N           compile N files at a time (default: the number of processors)
# The -O2 build stays in build/same_bits; nothing else is touched.
# Exit code: 0 if the hashes of each fidelity agree, 1 if not, else that of what failed.
set -eu
cd "$(dirname "$0")/.."

trials=20
jobs=$(nproc)
other=build/test/tests/determinism/hash_trials
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,14s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --against | --trials | --jobs)
      [ $# -ge 2 ] || { echo "same_bits: $1 needs a value" >&2; exit 2; }
      case "$1" in
        --against) other=$2 ;;
        --trials) trials=$2 ;;
        --jobs) jobs=$2 ;;
      esac
      shift 2
      ;;
    *) echo "same_bits: unknown option $1 (try --help)" >&2; exit 2 ;;
  esac
done
[ -x "$other" ] || { echo "same_bits: no program $other: build preset test first" >&2; exit 2; }

folder=build/same_bits
mkdir -p "$folder"
# -w: gcc's warnings depend on the level, and they are the test build's matter.
cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG -w" \
  -DROCKYARD_BUILD_TESTS=ON -DROCKYARD_BUILD_BENCHMARKS=OFF > "$folder.log" 2>&1 ||
  { cat "$folder.log" >&2; exit 1; }
cmake --build "$folder" --target hash_trials -j "$jobs"

differs=0
for fidelity in multibody quasi_static; do
  first=""
  for program in "$folder/tests/determinism/hash_trials" "$other"; do
    for threads in 1 2; do
      hash=$("$program" scenarios/pathfinder/nominal.json "$trials" "$threads" \
        "rover.fidelity=$fidelity")
      [ -n "$hash" ] || { echo "same_bits: no hash from $program" >&2; exit 1; }
      verdict=same
      if [ "$hash" != "${first:=$hash}" ]; then verdict=DIFFERS; differs=1; fi
      printf '%-14s %s thread(s)  %s  %s  %s\n' "$fidelity" "$threads" "$hash" "$verdict" "$program"
    done
  done
done
exit "$differs"
