#!/bin/sh
# The Debian packages hold a command and a package for Python that work away from their sources: they
# find scenarios by name and drive, a page is written, and completion is there. Unpacked, not installed:
# no root is needed. The same from the sources by pip, in an environment of its own.
# Usage: deb_test.sh CPACK_CONFIG SOURCES
set -eu
config=$1
source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "deb_test: $*" >&2
  exit 1
}

cpack --config "$config" -B "$folder/made" > "$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "no package"; }
set -- "$folder"/made/*.deb
[ $# -eq 2 ] || fail "not two packages: $*"
python_package=$1 # in alphabetical order
depends=$(dpkg-deb -f "$python_package" Depends)
case "$depends" in "rockyard (= "*python3-numpy*) ;; *) fail "Depends of the package for Python: $depends" ;; esac
dpkg-deb -x "$python_package" "$folder/root"
shift
depends=$(dpkg-deb -f "$1" Depends)
case "$depends" in *python* | *boost*) fail "the command depends on what the package for Python needs: $depends" ;; esac
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
[ -s "$folder/root/usr/share/doc/rockyard/THIRD_PARTY.txt" ] || fail "no notices"
[ -s "$folder/root/usr/share/doc/rockyard/copyright" ] || fail "no licence"
drive="import rockyard; print(rockyard.run('nominal', trials=4, set={'rover.fidelity': 'quasi_static'}, folder='FOLDER').hash)"
by_command=$(grep -o '"trial_hash": "[0-9a-f]*"' run/summary.json | cut -d '"' -f 4)
by_python=$(PYTHONPATH=$folder/root/usr/lib/python3/dist-packages /usr/bin/python3 -c "$(echo "$drive" | sed s/FOLDER/python/)")
[ "$by_python" = "$by_command" ] || fail "Python drives otherwise: $by_python, $by_command"
build=$(dirname "$config")
/usr/bin/python3 -m venv --system-site-packages "$folder/venv"
mkdir "$folder/source" && (cd "$source" && tar cf - --exclude=./build --exclude=./.git .) | tar xf - -C "$folder/source" # where pip may write
(cd "$folder/source" && ROCKYARD_BUILD=$build "$folder/venv/bin/pip" install -q --no-index --no-build-isolation .) || fail "pip"
by_pip=$("$folder/venv/bin/python" -c "$(echo "$drive" | sed s/FOLDER/pip/)")
[ "$by_pip" = "$by_command" ] || fail "the package by pip drives otherwise: $by_pip, $by_command"
"$command" new navigator mine > /dev/null
cmake -S mine -B mine/build -DCMAKE_PREFIX_PATH="$folder/root/usr" > cmake.log 2>&1 || fail "no package to be found: $(cat cmake.log)"
cmake --build mine/build > cmake.log 2>&1 || fail "a plugin does not build: $(cat cmake.log)"
"$command" run mine/mine.json --trials 2 --set rover.fidelity=quasi_static --out mine/run > /dev/null || fail "a plugin does not drive"
! "$command" run nominl > /dev/null 2> err.txt || fail "a scenario that is not there"
grep -q 'did you mean "nominal"' err.txt || fail "no suggestion"
