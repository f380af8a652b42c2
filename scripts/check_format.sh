#!/bin/sh
# Checks that every C++ file is formatted as .clang-format says; with --fix, formats them.
# Usage: scripts/check_format.sh [--fix]
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = --fix ]; then
  set -- -i
else
  set -- --dry-run -Werror
fi
find src tests -name '*.h' -print0 -o -name '*.cc' -print0 | xargs -0 -r clang-format "$@"
