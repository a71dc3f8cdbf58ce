#!/usr/bin/env bash
# Makes a report from two small runs and uses it in headless Chromium: scripts/test_report.sh [UNITTEST_OPTION...]
# Installs the browser if it is missing; apart from scripts/test.sh, which needs none.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --report-test
scripts/build.sh release -DHYBRAY_TESTS=OFF -DHYBRAY_BENCH=OFF
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/hybray run -q configs/quickstart.json -o "$folder/quickstart" --filter scene=sphere --set resolution=320x180
build/release/hybray run -q configs/caustics_rays_objects.json -o "$folder/caustics_rays_objects" --filter scene=glass_ball \
  --filter rays_per_texel=0.25 --set resolution=160x90 --set frames=2 --set repeats=1 --set reference_paths=20000 --set picture=true
mkdir "$folder/gates" "$folder/figures"
echo '<testsuite><testcase name="one"/><testcase name="two"><failure message="missed"/></testcase><testcase name="three"><skipped message="known"/></testcase></testsuite>' \
  >"$folder/gates/made_up.xml"
echo '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"><circle cx="1" cy="0.5" r="0.4"/></svg>' >"$folder/figures/circle.svg"
tests/report/report_page_test.py "$folder" "$@"
