#!/usr/bin/env bash
# Builds the editor and tests it in Chromium. Needs Node.js 20, the compiler's target for browsers (by rustup) and Chromium. Where they can't be
# had it says so, and fails where CI=true.
set -euo pipefail
cd "$(dirname "$0")"

without() {
  echo "== THE EDITOR IS NOT BUILT: $1" >&2
  if [ "${CI:-}" = true ]; then exit 1; fi
  exit 0
}

if ! command -v npm > /dev/null && [ "${CI:-}" = true ] && command -v apt-get > /dev/null; then
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then as_root="sudo"; fi
  $as_root apt-get install -y -qq --no-install-recommends nodejs npm > /dev/null
fi
command -v npm > /dev/null || without "there is no npm; install Node.js 20 or newer"
target=wasm32-unknown-unknown
if ! rustc --print target-libdir --target "$target" 2> /dev/null | xargs -I{} test -d {}; then
  command -v rustup > /dev/null || without "the target $target is missing, and there is no rustup"
  rustup target add "$target" || without "rustup can't add the target $target"
fi

npm ci --ignore-scripts --no-audit --no-fund --silent
node build.mjs
npx --no-install tsc --noEmit
command -v chromium > /dev/null || command -v google-chrome > /dev/null || without "there is no Chromium to test it in"
# Two at a time, and then alone what measures how long things take.
pace=tests/pace.test.mjs
node --test --test-concurrency=2 $(ls tests/*.test.mjs | grep -v "^$pace$")
node --test "$pace"
