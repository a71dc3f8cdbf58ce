#!/usr/bin/env bash
# Sets up if needed, builds, runs a suite, and draws its tables and figures: scripts/reproduce.sh [CONFIG...]
# Without a config: configs/all.json, which is both papers. Everything lands in results/out.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- configs/all.json
code=0
scripts/run.sh "$@" || code=$?
# 3: some points failed. The others are there to be drawn.
[ "$code" -eq 0 ] || [ "$code" -eq 3 ] || exit "$code"
/usr/bin/python3 scripts/figures.py results/out || code=$?
/usr/bin/python3 scripts/report.py results/out || code=$?
exit "$code"
