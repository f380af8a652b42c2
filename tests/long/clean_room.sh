#!/bin/sh
# Tries commands on a bare Debian 12: makes a root folder with the base system and git only, copies
# the committed state of this project into it and runs the commands there (root needed).
# Usage: tests/long/clean_room.sh [--root DIR] [COMMAND]...
#   COMMAND     run inside the project's copy (default: scripts/quickstart.sh, then scripts/test.sh)
#   --root DIR  make the root folder here and leave it, or use the one that is here again
#               (default: a temporary folder that is removed at the end)
# The package archive is the one that this machine's own apt is configured for.
set -eu
export LC_ALL=C
project=$(cd "$(dirname "$0")/../.." && pwd)
root=""
keep=yes
while [ $# -gt 0 ]; do
  case "$1" in
    --root) root=$2; shift 2 ;;
    -h | --help) sed -n '2,8s/^# //p' "$0"; exit 0 ;;
    -*) echo "clean_room: unknown option $1 (try --help)" >&2; exit 2 ;;
    *) break ;;
  esac
done
[ $# -gt 0 ] || set -- scripts/quickstart.sh scripts/test.sh

fail() {
  echo "clean_room: $*" >&2
  exit 1
}
[ "$(id -u)" -eq 0 ] || fail "making a root folder needs root"
"$project/scripts/install_dependencies.sh" clean_room
if [ -z "$root" ]; then
  root=$(mktemp -d)
  chmod 755 "$root" # tests become nobody, who has to get to /tmp
  keep=no
fi

leave() {
  for point in proc sys dev/pts dev; do
    if mountpoint -q "$root/$point"; then umount "$root/$point"; fi
  done
  if [ "$keep" = no ]; then
    rm -rf --one-file-system "$root"
  fi
}
trap leave EXIT INT TERM

if [ ! -x "$root/usr/bin/git" ]; then
  # shellcheck disable=SC2016  # apt's own placeholders
  archive=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' |
    awk '$2 == "bookworm" { print $1; exit }')
  [ -n "$archive" ] || fail "this machine's apt has no source for Debian 12 (bookworm)"
  debootstrap --variant=minbase --include=ca-certificates,git bookworm "$root" "$archive"
  rm -rf "$root/etc/apt/sources.list" "$root/etc/apt/sources.list.d" "$root/etc/apt/apt.conf.d"
  for item in sources.list sources.list.d apt.conf.d; do
    if [ -e "/etc/apt/$item" ]; then cp -r "/etc/apt/$item" "$root/etc/apt/"; fi
  done
fi
for item in resolv.conf hosts ssl/certs/ca-certificates.crt; do
  if [ -e "/etc/$item" ]; then cp -L --remove-destination "/etc/$item" "$root/etc/$item"; fi
done
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t devpts devpts "$root/dev/pts" # terminals, which the bound folder has not
mount -t sysfs sys "$root/sys" 2> /dev/null || true

if [ -d "$root/srv/rockyard" ]; then
  git -C "$root/srv/rockyard" pull --quiet --ff-only
else
  git clone --quiet "$project" "$root/srv/rockyard"
fi
for command in "$@"; do
  echo "== $command"
  start=$(date +%s)
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM="${TERM:-dumb}" \
    chroot "$root" sh -c "cd /srv/rockyard && $command" && status=0 || status=$?
  echo "== $command: exit code $status after $(($(date +%s) - start)) s"
  [ "$status" -eq 0 ] || exit "$status"
done
