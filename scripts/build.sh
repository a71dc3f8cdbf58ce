#!/usr/bin/env bash
# Sets up if needed, configures and builds one CMake preset (default: release): scripts/build.sh [PRESET [CMAKE_OPTION...]]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
shift || true
scripts/setup.sh
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
echo "build: build/$preset" >&2
cmake --build "build/$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
grep -E 'warning:' "$log" >&2 || true
