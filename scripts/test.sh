#!/bin/sh
# Everything that must hold before a change is accepted: installs what is missing, builds with
# contracts on and every warning an error, compares trials of -O2 and -O3 builds bit for bit
# (scripts/same_bits.sh), then runs all tests, the layer check, clang-format and clang-tidy. The last
# lines are ctest's summary.
#
# Usage: scripts/test.sh [OPTION]...
#   --quick          only tests that take no long simulation: labels unit, property and physics,
#                    without the comparison of builds, which sanitizers leave out, too
#   --label LABEL    only tests of that label: unit, property, statistical, physics, differential,
#                    determinism (with the comparison of builds), regression, cli, fuzz, lint
#   --no-lint        without clang-format and clang-tidy
#   --preset PRESET  another build: debug, asan, tsan, release (default: test)
#   --jobs N         compile and test N at a time (default: the number of processors)
# Exit code: 0 if everything passes.
set -eu
cd "$(dirname "$0")/.."

preset="test"
jobs=$(nproc)
label=""
exclude=""
usage() {
  echo "test: $1 (try --help)" >&2
  exit 2
}
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,16s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --quick) label='^(unit|property|physics)$'; shift ;;
    --no-lint) exclude='^lint$'; shift ;;
    --label | --preset | --jobs)
      [ $# -ge 2 ] || usage "$1 needs a value"
      case "$1" in
        --label) label="^$2\$" ;;
        --preset) preset=$2 ;;
        --jobs) jobs=$2 ;;
      esac
      shift 2
      ;;
    *) usage "unknown option $1" ;;
  esac
done

groups="build pages test figures"
if [ "$preset" = tsan ]; then groups="$groups tsan"; fi
# shellcheck disable=SC2086  # a list of words
scripts/install_dependencies.sh $groups

# Quickstart configures the release preset without tests.
cmake --preset "$preset" -DROCKYARD_BUILD_TESTS=ON
cmake --build --preset "$preset" -j "$jobs"
case "$preset $label" in
  "test " | "release " | "test ^determinism$") scripts/same_bits.sh --jobs "$jobs" ;;
esac
set -- --preset "$preset" -j "$jobs"
if [ -n "$label" ]; then set -- "$@" -L "$label"; fi
if [ -n "$exclude" ]; then set -- "$@" -LE "$exclude"; fi
ctest "$@" --no-tests=error --output-on-failure
