#!/bin/sh
# Holds this build against the committed baselines of the regression campaigns.
#   scripts/ci/regression.sh BUILD/bin/rockyard [FOLDER [TRIALS]]
# Exit code of rockyard check: 0 no change, 1 changed, 4 inconclusive, 2 another scenario; of both
# campaigns the first that is not 0. FOLDER (default: a temporary one) gets of each campaign the run,
# and as NAME.xml (JUnit) and NAME.csv what the check found. TRIALS: only the first ones of each cell,
# of which it is no failure that they decide nothing (0 instead of 4).
set -eu
program=$1
trials=${3:-}
root=$(cd "$(dirname "$0")/../.." && pwd)
if [ $# -gt 1 ]; then
  folder=$2
  mkdir -p "$folder"
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
code=0
for name in regression regression_continuous; do
  "$program" sweep "$root/scenarios/sweeps/$name.json" --out "$folder/$name" --force --quiet \
    ${trials:+--trials "$trials"}
  found=0
  "$program" check "$folder/$name" --against "$root/results/baselines/$name.json" \
    --junit "$folder/$name.xml" --csv "$folder/$name.csv" || found=$?
  if [ "$code" -eq 0 ]; then code=$found; fi
done
if [ -n "$trials" ] && [ "$code" -eq 4 ]; then code=0; fi
exit "$code"
