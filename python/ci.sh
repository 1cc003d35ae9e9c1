#!/usr/bin/env bash
# Builds the wheel and tests it in an environment of its own, below target/. Needs Python 3.11 or newer, and the network for packages.
#   python/ci.sh
set -euo pipefail
cd "$(dirname "$0")"
place="${CARGO_TARGET_DIR:-$PWD/../target}/python"
rm -rf "$place"
mkdir -p "$place"

# Debian has what makes environments in a package of its own.
if ! python3 -m venv "$place/venv" > /dev/null 2>&1; then
  rm -rf "$place/venv"
  if [ "${CI:-}" = true ] && command -v apt-get > /dev/null; then
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then as_root="sudo"; fi
    $as_root apt-get update -qq
    $as_root apt-get install -y -qq --no-install-recommends python3-venv > /dev/null
  fi
  python3 -m venv "$place/venv"
fi
export PATH="$place/venv/bin:$PATH"
unset PYTHONPATH PYTHONHOME
pinned() { grep "^$1==" tests/requirements.txt; }
pip install --quiet --disable-pip-version-check "$(pinned uv)" "$(pinned maturin)"
# While Rust is compiled.
uv pip install --quiet --requirement tests/requirements.txt &
installing=$!

stage() {
  echo "-- $* (${SECONDS} s)"
  "$@"
}

# With the profile of the tests, which have compiled everything but what is Python's own.
stage maturin build --quiet --release --locked --out "$place/wheels"
# The library of functional mock-up units, which the tests have compiled, too.
stage cargo build --quiet --release --locked -p linkdyn -p linkdyn-fmi --lib
target="${CARGO_TARGET_DIR:-$PWD/../target}/release"
for file in "$target"/{lib,}linkdyn_fmi.{so,dylib,dll}; do
  if [ -e "$file" ]; then export LINKDYN_FMU_LIBRARY="$file"; fi
done
wait "$installing"
# The source distribution has all that its manifests name.
stage maturin sdist --out "$place/sdist" 2> "$place/sdist.log" || { cat "$place/sdist.log" >&2; exit 1; }
tar -xzf "$place"/sdist/linkdyn-*.tar.gz -C "$place/sdist" --strip-components 1
cargo metadata --quiet --offline --locked --no-deps --format-version 1 --manifest-path "$place/sdist/python/Cargo.toml" > "$place/sdist.json"
uv pip install --quiet --no-deps "$place"/wheels/linkdyn-*.whl

# The package that is tested is the installed one, not the folder beside the tests.
cp -r tests examples pyproject.toml "$place"
cp -r ../tests/cases/schema.json ../crates/exchange/tests/linkages "$place/tests"
mkdir "$place/docs"
cp ../docs/{cluster,python}.md "$place/docs"
stage ruff check .
stage ruff format --check .
cd "$place"
# Types are looked at while the tests run, and tell what they found behind them.
types() {
  stage mypy --package linkdyn
  stage mypy tests
  stage python -m mypy.stubtest linkdyn._linkdyn
}
(set -e; types) > types.log 2>&1 &
typing=$!
stage pytest tests --doctest-modules --pyargs linkdyn
wait "$typing" || { cat types.log >&2; exit 1; }
cat types.log
echo "-- done (${SECONDS} s)"
