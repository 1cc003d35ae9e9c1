#!/usr/bin/env bash
# The way of a stranger, timed: clone, build and run the lock, a model of one's own from the tutorial, its pictures; then the tests and the program to hand on.
#   benches/stranger.sh [--quick] [DIR]    --quick leaves out the tests and the handed-on program; DIR (new) is kept, otherwise a temporary one is removed
# Every command is read from README.md or docs/tutorial.md of the clone. A command that fails, or a result that is not there, ends the script.
set -euo pipefail
source_of="$(cd "$(dirname "$0")/.." && pwd)"
quick=""
if [ "${1:-}" = --quick ]; then quick=yes; shift; fi
if [ $# -gt 0 ]; then
  mkdir "$1"
  place="$(cd "$1" && pwd)"
else
  place="$(mktemp -d)"
  trap 'rm -rf "$place"' EXIT
fi
most_bytes=12000000

# Seconds of a step, its name, and what came out of it in the log beside it.
stage() {
  local name="$1" begun ended
  shift
  begun=$(date +%s.%N)
  if ! "$@" >> "$place/log.txt" 2>&1; then
    echo "failed: $name ($*)" >&2
    tail -n 20 "$place/log.txt" >&2
    exit 1
  fi
  ended=$(date +%s.%N)
  awk -v from="$begun" -v to="$ended" -v name="$name" 'BEGIN { printf "%9.2f s  %s\n", to - from, name }'
}

# A command must stand in the page word for word; then it is what a reader would type.
stands() {
  if ! grep -Fqx -e "$2" -e "\$ $2" "$1"; then
    echo "$1 does not give the command: $2" >&2
    exit 1
  fi
}

# The first block of a page that is to be saved under a name.
saved() {
  awk -v head="file:$2" '$1 == "```json" && $2 == head { on = 1; next } on && /^```/ { exit } on' "$1" > "$2"
  if [ ! -s "$2" ]; then
    echo "$1 has no block for $2" >&2
    exit 1
  fi
}

there() {
  for file in "$@"; do
    if [ ! -s "$file" ]; then
      echo "not written: $file" >&2
      exit 1
    fi
  done
}

stage "clone" git clone --quiet "$source_of" "$place/linkdyn"
cd "$place/linkdyn"
export CARGO_TARGET_DIR="$place/target"

first="cargo run --release -- run lock -o out"
stands README.md "$first"
stage "first command, everything built: $first" $first
there out/report.html out/results.csv out/summary.json
stage "the same again" $first

mkdir "$place/own"
saved docs/tutorial.md press.json
mv press.json "$place/own"
tutorial="$place/linkdyn/docs/tutorial.md"
cd "$place/own"
PATH="$CARGO_TARGET_DIR/release:$PATH"
for command in "linkdyn check press.json" "linkdyn run press.json -o out"; do
  stands "$tutorial" "$command"
  stage "own model: $command" $command
done
there out/report.html out/results.csv
stage "picture: linkdyn plot out --y punch.x" linkdyn plot out --y punch.x -o stroke.svg
stage "film: linkdyn animate out" linkdyn animate out -o press.gif
there stroke.svg press.gif
if [ -n "$quick" ]; then exit 0; fi

cd "$place/linkdyn"
second="cargo test --release"
stands README.md "$second"
stage "second command: $second" $second
install="cargo install --path . --locked --profile dist --features dist"
stands README.md "$install"
stage "install: $install" $install --root "$place/installed"
bytes=$(wc -c < "$place/installed/bin/linkdyn")
echo "$bytes bytes, at most $most_bytes: the installed program"
[ "$bytes" -le "$most_bytes" ]
