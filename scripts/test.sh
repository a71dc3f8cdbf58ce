#!/usr/bin/env bash
# Sets up if needed, builds, and runs all tests: scripts/test.sh [CTEST_OPTION...]
# With the environment variable CI set, warnings are errors.
set -euo pipefail
cd "$(dirname "$0")/.."
werror=OFF
[ -z "${CI:-}" ] || werror=ON
scripts/build.sh release -DHYBRAY_TESTS=ON -DHYBRAY_BENCH=ON -DHYBRAY_WERROR=$werror
exec ctest --preset release -j "$(nproc)" "$@"
