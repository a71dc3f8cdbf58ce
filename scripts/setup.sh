#!/usr/bin/env bash
# Installs what hybray needs on Debian 12 or newer. Safe to run again: it installs only what is missing.
#   scripts/setup.sh                 what the build, the tests and the scripts need
#   scripts/setup.sh --dev           clang-format too, for scripts/lint.sh
#   scripts/setup.sh --report-test   a browser too, for scripts/test_report.sh
#   scripts/setup.sh --workflow      Snakemake too, for scripts/test_workflow.sh
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config ccache git python3 python3-matplotlib
  libembree-dev libopenimageio-dev libglm-dev libtinygltf-dev nlohmann-json3-dev libvalijson-dev
  libtbb-dev libboost-dev libcli11-dev libspdlog-dev libfmt-dev libhwy-dev libxxhash-dev libgtest-dev libbenchmark-dev
  python3-jinja2 python3-pil
  python3-munkres # with it, matplotlib's fonttools does without SciPy and its 200 MiB of compilers and libraries
)
case "${1:-}" in
  "") ;;
  --dev) packages+=(clang-format) ;;
  --report-test) packages+=(chromium chromium-driver fonts-dejavu-core python3-selenium python3-numpy) ;;
  --workflow) packages+=(snakemake) ;;
  *) sed -n '2,6p' "$0"; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup: this system has no apt; install the equivalents of these Debian packages, then build with cmake --preset release:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 2
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: everything is installed already" >&2
  exit 0
fi

echo "setup: installing ${missing[*]}" >&2
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup: run it as root, or install sudo, to add: ${missing[*]}" >&2; exit 2; }
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -qq && "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  cat "$log" >&2
  unknown=()
  for package in "${missing[@]}"; do apt-cache show "$package" >/dev/null 2>&1 || unknown+=("$package"); done
  [ ${#unknown[@]} -eq 0 ] || echo "setup: this system's package lists do not have: ${unknown[*]}" >&2
  echo "setup: the installation failed (the packages are those of Debian 12)" >&2
  exit 2
fi
