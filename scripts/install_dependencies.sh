#!/bin/sh
# Installs the Debian packages of the named groups that are missing (default: build).
# Usage: scripts/install_dependencies.sh [GROUP]...       groups: see scripts/debian_packages.txt
set -eu
export LC_ALL=C
list="$(dirname "$0")/debian_packages.txt"

case "${1:-}" in
  -h | --help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
esac
[ $# -gt 0 ] || set -- build

fail() {
  echo "install_dependencies: $*" >&2
  exit 1
}

missing=""
for group in "$@"; do
  packages=$(awk -v group="$group" '!/^#/ && $2 == group { print $1 }' "$list")
  [ -n "$packages" ] || fail "no package of group '$group' in $list"
  command -v dpkg-query > /dev/null || fail "this is not a Debian system: install these yourself:
$(printf '%s\n' "$packages" | sed 's/:.*//')"
  for entry in $packages; do
    package=${entry%%:*}
    if [ "$package" != "$entry" ] && command -v "${entry#*:}" > /dev/null; then continue; fi
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null) || status=absent
    [ "$status" = installed ] || missing="$missing $package"
  done
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo > /dev/null; then
  as_root=sudo
else
  fail "these packages are missing and installing them needs root or sudo:$missing"
fi

# The package index is fetched only if it is absent or does not lead to the packages.
install() {
  # shellcheck disable=SC2086  # both are lists of words
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
}
echo "Installing:$missing"
# shellcheck disable=SC2086
if apt-cache show $missing > /dev/null 2>&1 && install; then
  exit 0
fi
$as_root apt-get update || fail "apt-get update failed: see its messages above"
install || fail "apt-get could not install:$missing"
