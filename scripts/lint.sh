#!/usr/bin/env bash
# Fails where a source file is not formatted (scripts/lint.sh --fix formats it), or the tree holds what it must not.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-format >/dev/null || scripts/setup.sh --dev
mapfile -d '' sources < <(git ls-files -z '*.h' '*.cpp')
if [ "${1:-}" = --fix ]; then
  clang-format -i "${sources[@]}"
else
  clang-format --dry-run --Werror "${sources[@]}"
fi
/usr/bin/python3 scripts/check_includes.py
