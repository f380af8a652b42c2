#!/bin/sh
# Everything that must hold before a change is accepted: installs what is missing, builds with
# contracts on and every warning an error, then runs tests of every kind: those of the code, first trials
# bit for bit, the commands of README and docs, the pages in a browser, layers, format, and clang-tidy
# on what changed. The last lines are ctest's summary.
#
# Usage: scripts/test.sh [OPTION]... [FOLDER]...
#   FOLDER...        only the tests of these folders of tests/ (navigation, trial, ...), and of the
#                    build only what they need
#   --fast           only the fast tier: under a minute after a build
#   --long           instead: the tests of the tier that these leave out
#   --label LABEL    only tests of that label: unit, property, statistical, physics, differential,
#                    determinism, regression, cli, fuzz, web, lint
#   --no-lint        without clang-format and clang-tidy
#   --preset PRESET  another build: debug, asan, tsan, release (default: test)
#   --jobs N         compile and test N at a time (default: the number of processors)
#   --times [N]      instead: the N (50) dearest tests of the last run
#   --all [NAME]...  instead: what a release needs beside these tests, all or the entries of these
#                    names (--all --list); goes on where it was interrupted
# build/last_test then says what ran, on which commit, how it ended, and how long it took.
# Exit code: 0 if everything passes.
set -eu
cd "$(dirname "$0")/.."

preset="test"
jobs=$(nproc)
label=""
tier="full"
lint=yes
folders=""
usage() {
  echo "test: $1 (try --help)" >&2
  exit 2
}
# What each test took: program or "ctest", test, seconds of the clock and of processors.
record() { printf '%s/build/%s/test_times.tsv' "$PWD" "$preset"; }
dearest() {
  [ -f "$(record)" ] || usage "no times: $(record) is not there"
  printf '%9s %9s\n' cpu_s clock_s
  sort -t "$(printf '\t')" -k 4,4nr "$(record)" | head -n "$1" |
    awk -F '\t' '{ printf "%9.1f %9.1f  %s %s\n", $4, $3, $1 == "ctest" ? "" : $1, $2 }'
}
if [ "${1:-}" = --all ]; then
  shift
  exec scripts/long_tests.py "$@"
fi
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,24s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --all) usage "--all stands before everything else" ;;
    --times)
      [ $# -le 2 ] || usage "--times stands last"
      dearest "${2:-50}"
      exit 0
      ;;
    --fast) tier="fast"; shift ;;
    --long) tier="long"; shift ;;
    --no-lint) lint=no; shift ;;
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

case "$tier,$lint" in
  long,yes) exclude="^\$" ;;
  long,no) exclude='^lint$' ;;
  *,yes) exclude='^long$' ;;
  *,no) exclude='^(long|lint)$' ;;
esac

# What ran goes to build/last_test, also where something fails or the run is interrupted.
start=$(date +%s)
commit=$(git rev-parse HEAD 2> /dev/null || echo unknown)
if [ -n "$(git status --porcelain 2> /dev/null)" ]; then commit="$commit with uncommitted changes"; fi
what="preset $preset, tier $tier${label:+, label $label}, without $exclude"
what="$what${folders:+, folders$folders}"
tell() {
  code=$?
  mkdir -p build
  {
    if [ "$code" -eq 0 ]; then echo "passed: commit $commit"; else echo "FAILED: commit $commit"; fi
    echo "ran: $what"
    echo "ended: $(date -u '+%Y-%m-%d %H:%M') UTC, exit code $code, $(($(date +%s) - start)) s"
  } > build/last_test
}
trap tell EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# Debian's Python, whose packages the tests use; a shim of another one takes half a second a call.
if [ -x /usr/bin/python3 ]; then
  mkdir -p build/bin
  ln -sf /usr/bin/python3 build/bin/python3
  PATH="$PWD/build/bin:$PATH"
  export PATH
fi

groups="build mpi python pages test figures"
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

# Browsers and the command's processes wait for each other: twice as many tests keep all processors busy.
set -- --preset "$preset" -j "$((2 * jobs))"
if [ -n "$wanted" ]; then set -- "$@" -L "^($wanted)\$"; fi
if [ "$tier" != full ]; then set -- "$@" -L "^$tier\$"; fi
if [ -n "$label" ]; then set -- "$@" -L "$label"; fi
ROCKYARD_TEST_TIMES=$(record)
export ROCKYARD_TEST_TIMES
mkdir -p "build/$preset"
: > "$ROCKYARD_TEST_TIMES"
ctest "$@" -LE "$exclude" --no-tests=error --output-on-failure
