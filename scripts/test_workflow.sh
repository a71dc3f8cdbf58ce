#!/usr/bin/env bash
# Tests the Snakemake workflow with two local cores: set-up, build, a small config in three shards, figures and report; then that the
# merged metrics are those of a run in one piece. The environment variable SNAKEMAKE may name another Snakemake than Debian's.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --workflow
scripts/build.sh release -DHYBRAY_TESTS=ON -DHYBRAY_BENCH=ON
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
small=(--set resolution=320x180 --set repeats=1)
"${SNAKEMAKE:-/usr/bin/snakemake}" -s scripts/Snakefile --cores 2 --quiet --config configs=configs/quickstart.json shards=3 out="$folder/sharded" \
  options="${small[*]} --no-timing -q"
build/release/hybray run configs/quickstart.json "${small[@]}" --no-timing -q --threads 1 -o "$folder/single"
cmp "$folder/sharded/quickstart/quickstart.csv" "$folder/single/quickstart.csv"
test -s "$folder/sharded/report.html"
echo "workflow: three shards and one run agree byte for byte"
