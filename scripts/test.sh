#!/bin/sh
# Everything that must hold before a change is accepted: installs what is missing, builds with
# contracts on and every warning an error, then runs all tests: those of the code, the comparison of
# trials of -O2 and -O3 builds bit for bit (scripts/same_bits.sh), the README's commands, the pages in
# a browser, the layer check, clang-format and clang-tidy. The last lines are ctest's summary.
#
# Usage: scripts/test.sh [OPTION]... [FOLDER]...
#   FOLDER...        only the tests of these folders of tests/ (navigation, trial, ...), and of the
#                    build only what they need
#   --fast           only the fast tier: under a minute after a build
#   --label LABEL    only tests of that label: unit, property, statistical, physics, differential,
#                    determinism, regression, cli, fuzz, web, lint
#   --no-lint        without clang-format and clang-tidy
#   --preset PRESET  another build: debug, asan, tsan, release (default: test)
#   --jobs N         compile and test N at a time (default: the number of processors)
#   --long [NAME]... instead: the long tests of these names, or all (scripts/long_tests.py --list)
# build/last_test then says what ran, on which commit, and how it ended.
# Exit code: 0 if everything passes.
set -eu
cd "$(dirname "$0")/.."

preset="test"
jobs=$(nproc)
label=""
tier="full"
exclude=""
folders=""
usage() {
  echo "test: $1 (try --help)" >&2
  exit 2
}
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,19s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --long) shift; exec scripts/long_tests.py "$@" ;;
    --fast) tier="fast"; shift ;;
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
    -*) usage "unknown option $1" ;;
    *)
      [ -d "tests/$1" ] || usage "tests/ has no folder $1"
      folders="$folders ${1%/}"
      shift
      ;;
  esac
done

# What ran goes to build/last_test, also where something fails.
commit=$(git rev-parse HEAD 2> /dev/null || echo unknown)
if [ -n "$(git status --porcelain 2> /dev/null)" ]; then commit="$commit with uncommitted changes"; fi
what="preset $preset, tier $tier${label:+, label $label}${exclude:+, without $exclude}"
what="$what${folders:+, folders$folders}"
tell() {
  code=$?
  mkdir -p build
  {
    if [ "$code" -eq 0 ]; then echo "passed: commit $commit"; else echo "FAILED: commit $commit"; fi
    echo "ran: $what"
    echo "ended: $(date -u '+%Y-%m-%d %H:%M') UTC, exit code $code"
  } > build/last_test
}
trap tell EXIT

groups="build mpi pages test figures"
if [ "$preset" = tsan ]; then groups="$groups tsan"; fi
# shellcheck disable=SC2086  # a list of words
scripts/install_dependencies.sh $groups

# Quickstart configures the release preset without tests.
cmake --preset "$preset" -DROCKYARD_BUILD_TESTS=ON

targets=""
wanted=""  # tests/navigation|tests/trial: labels of folders
for folder in $folders; do
  targets="$targets tests/$folder/all"
  wanted="${wanted:+$wanted|}tests/$folder"
done
# shellcheck disable=SC2086  # a list of words
cmake --build --preset "$preset" -j "$jobs" ${targets:+--target $targets}

set -- --preset "$preset" -j "$jobs"
if [ -n "$wanted" ]; then set -- "$@" -L "^($wanted)\$"; fi
if [ "$tier" = fast ]; then set -- "$@" -L '^fast$'; fi
if [ -n "$label" ]; then set -- "$@" -L "$label"; fi
if [ -n "$exclude" ]; then set -- "$@" -LE "$exclude"; fi
ctest "$@" --no-tests=error --output-on-failure
