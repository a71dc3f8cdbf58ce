#!/usr/bin/env bash
# Sets up if needed, builds, and runs experiment configs: scripts/run.sh [CONFIG...] [OPTION...]
# Without a config: configs/quickstart.json, then its tables. Options are those of `hybray run`.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/build.sh release -DHYBRAY_TESTS=OFF -DHYBRAY_BENCH=OFF
if [ $# -eq 0 ]; then
  build/release/hybray run configs/quickstart.json
  exec /usr/bin/python3 scripts/tables.py results/out/quickstart/quickstart.csv
fi
exec build/release/hybray run "$@"
