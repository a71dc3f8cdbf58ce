#!/usr/bin/python3
"""Compares the metrics of a config's run with the accepted ones in results/baseline/, or accepts new ones.

Metrics do not depend on threads or timing, but the general tracer's instruction set may move rays that lie within rounding of an edge.
Fractions may therefore differ by 20 rays in 100,000; keys and counts may not differ at all, but for the rays themselves.
"""

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEYS = ("scene", "camera", "width", "height", "depth_convention", "derivatives")
NOT_A_METRIC = ("id", "threads", "repeats", "level0_margin_ulp")
SHARE_OF_RAYS = 2e-4
Row = dict[str, str]


def read(path: Path) -> list[Row]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def key_of(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in KEYS)


def measure(program: Path, config: Path) -> list[Row]:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", config, "--no-timing", "-q", "-o", folder], check=True)
        return read(Path(folder) / f"{config.stem}.csv")


def metrics_of(rows: list[Row]) -> list[str]:
    return [name for name in rows[0] if name not in NOT_A_METRIC and any(row[name] for row in rows)]


def differs(name: str, old: str, new: str) -> bool:
    if old == new:
        return False
    try:
        a, b = float(old), float(new)
    except ValueError:
        return True
    if name.endswith("_fraction") or name in ("alpha", "alpha_max", "precision", "precision_loose", "recall"):
        return abs(a - b) > SHARE_OF_RAYS
    if name in ("steps_per_ray", "rays", "paths_skipped", "geometric_mirror_rays", "buffer_bytes"):
        return abs(a - b) > SHARE_OF_RAYS * max(abs(a), abs(b)) + 2
    if name == "far_m":
        return abs(a - b) > 1e-12 * abs(a)
    return True


def compare(old_rows: list[Row], new_rows: list[Row]) -> list[str]:
    found = []
    new_by_key = {key_of(row): row for row in new_rows}
    old_by_key = {key_of(row): row for row in old_rows}
    found += [f"missing point: {' '.join(key)}" for key in old_by_key if key not in new_by_key]
    found += [f"point without a baseline: {' '.join(key)}" for key in new_by_key if key not in old_by_key]
    for key in old_by_key.keys() & new_by_key.keys():
        old, new = old_by_key[key], new_by_key[key]
        found += [f"{' '.join(key)}: {name} was {value or '(empty)'}, is {new.get(name, '') or '(empty)'}"
                  for name, value in old.items() if differs(name, value, new.get(name, ""))]
    return sorted(found)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("config", type=Path, nargs="?", default=ROOT / "configs" / "quickstart.json")
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "release" / "hybray")
    parser.add_argument("--accept", action="store_true", help="make the new metrics the baseline, and print what changed")
    arguments = parser.parse_args()
    baseline = ROOT / "results" / "baseline" / f"{arguments.config.stem}.csv"
    rows = measure(arguments.program, arguments.config)
    if not arguments.accept and not baseline.exists():
        print(f"no baseline: {baseline.relative_to(ROOT)}; --accept makes one", file=sys.stderr)
        return 1
    changes = compare(read(baseline), rows) if baseline.exists() else []
    print("\n".join(changes) if changes else f"{len(rows)} points: every metric as in the baseline")
    if not arguments.accept:
        return 1 if changes else 0
    columns = metrics_of(rows)
    partial = baseline.with_suffix(".part")
    with partial.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    partial.replace(baseline)
    return 0


if __name__ == "__main__":
    sys.exit(main())
