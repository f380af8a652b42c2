#!/bin/sh
# The Debian package holds a command that works away from its sources: it finds scenarios by name,
# drives, writes a page, and completion is there. Unpacked, not installed: no root is needed.
# Usage: deb_test.sh CPACK_CONFIG
set -eu
config=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "deb_test: $*" >&2
  exit 1
}

cpack --config "$config" -B "$folder/made" > "$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "no package"; }
set -- "$folder"/made/*.deb
[ $# -eq 1 ] || fail "not one package: $*"
depends=$(dpkg-deb -f "$1" Depends)
for library in libsqlite3-0 libbullet libgomp1 libjpeg62-turbo; do
  case "$depends" in
    *"$library"*) ;;
    *) fail "$library is not in Depends: $depends" ;;
  esac
done
dpkg-deb -x "$1" "$folder/root"
command=$folder/root/usr/bin/rockyard
mkdir "$folder/elsewhere"
cd "$folder/elsewhere"

"$command" list | grep -q "  nominal.json " || fail "the scenarios are not listed"
"$command" run nominal --trials 4 --set rover.fidelity=quasi_static --out run > out.txt
grep -q "declared success" out.txt || fail "no result"
"$command" report run --replays 0 --tracks 0 > /dev/null
grep -q "<title>" run/report.html || fail "no page"
"$command" rover mfex > /dev/null
[ -s "$folder/root/usr/share/bash-completion/completions/rockyard" ] || fail "no completion"
[ -s "$folder/root/usr/share/doc/rockyard/docs/tutorial.md" ] || fail "no documentation"
/usr/bin/python3 - "$folder/root/usr/share/doc/rockyard/docs" << 'EOF' || fail "links of the pages lead nowhere"
import pathlib, re, sys
dead = [f"{page}: {link}" for page in pathlib.Path(sys.argv[1]).rglob("*.md")
        for link in re.findall(r"\]\((\.\./[^)#]+)", page.read_text()) if not (page.parent / link).exists()]
print("\n".join(dead))
sys.exit(bool(dead))
EOF
"$command" report run --replays 0 --tracks 0 2>&1 | grep -q "holds no reference" && fail "the references are not found"
[ -s "$folder/root/usr/share/man/man1/rockyard-run.1" ] || fail "no man page"
[ -s "$folder/root/usr/share/rockyard/trace_to_mcap.mjs" ] || fail "no converter to MCAP"
[ -s "$folder/root/usr/share/doc/rockyard/THIRD_PARTY.txt" ] || fail "no notices"
[ -s "$folder/root/usr/share/doc/rockyard/copyright" ] || fail "no licence"
"$command" new navigator mine > /dev/null
cmake -S mine -B mine/build -DCMAKE_PREFIX_PATH="$folder/root/usr" > cmake.log 2>&1 || fail "no package to be found: $(cat cmake.log)"
cmake --build mine/build > cmake.log 2>&1 || fail "a plugin does not build: $(cat cmake.log)"
"$command" run mine/mine.json --trials 2 --set rover.fidelity=quasi_static --out mine/run > /dev/null || fail "a plugin does not drive"
! "$command" run nominl > /dev/null 2> err.txt || fail "a scenario that is not there"
grep -q 'did you mean "nominal"' err.txt || fail "no suggestion"
