#!/bin/sh
# Holds this build against the committed baseline of the regression campaign.
#   scripts/ci/regression.sh BUILD/bin/rockyard [FOLDER]
# Exit code of rockyard check: 0 no change, 1 changed, 4 inconclusive, 2 another
# scenario. FOLDER (default: a temporary one) gets the run, regression.xml (JUnit) and regression.csv.
set -eu
program=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
if [ $# -gt 1 ]; then
  folder=$2
  mkdir -p "$folder"
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
"$program" sweep "$root/scenarios/sweeps/regression.json" --out "$folder/run" --force --quiet
"$program" check "$folder/run" --against "$root/results/baselines/regression.json" \
  --junit "$folder/regression.xml" --csv "$folder/regression.csv"
