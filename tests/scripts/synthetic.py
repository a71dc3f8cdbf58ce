"""Small tables like those of `hybray run`, for tests of the scripts."""

import csv
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

sys.dont_write_bytecode = True
SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

# One row of `ssrm`, whose numbers agree with one another.
SSRM = {"id": "0", "scene": "sphere", "camera": "front", "width": "1280", "height": "720", "derivatives": "plane", "alpha": "0.4",
        "alpha_max": "0.5", "miss_fraction": "0.1", "precision": "0.99", "recall": "0.8", "steps_per_ray": "30", "pyramid_ms": "1",
        "t_ss_ms": "4", "t_hw_ms": "10", "t_hw_single_ms": "20", "t_hybrid_ms": "12", "t_hybrid_single_ms": "18",
        "speedup_sequential": "1", "speedup_partitioned": "1.3", "speedup_measured": "0.8", "speedup_measured_vs_single": "1.1",
        "unresolved_cost_ratio": "1.2", "break_even_alpha": "0.4", "threads": "2"}
# One row of `ssrm_layers`.
LAYERS = {"id": "0", "scene": "sphere", "camera": "front", "width": "960", "height": "540", "layers": "1", "guard_band": "0",
          "alpha": "0.4", "alpha_gain": "1.2", "precision": "0.98", "single_precision": "0.99", "buffer_bytes": "300",
          "single_buffer_bytes": "100", "speedup_over_single_layer": "0.8", "threads": "2"}
# One row of `caustics`.
CAUSTICS = {"id": "0", "scene": "glass_ball", "camera": "front", "width": "320", "height": "180", "caustics": "true",
            "rays_per_texel": "1", "mirror_depth": "3", "lights_visible": "0", "lights_invisible": "1", "filter": "none",
            "relmse": "100", "relmse_low": "90", "relmse_high": "120", "at_floor": "false", "energy_ratio": "1",
            "energy_ratio_low": "0.9", "energy_ratio_high": "1.1", "total_ms": "10", "total_spread_ms": "1", "main_view_ratio": "3",
            "threads": "2", "repeats": "3"}
Row = dict[str, str]


def changed(row: Row, **cells: object) -> Row:
    return row | {name: str(value) for name, value in cells.items()}


def write(root: Path, name: str, rows: list[Row]) -> Path:
    """Writes root/name/name.csv, as `hybray run` does."""
    path = root / name / f"{name}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return path


def rays() -> list[Row]:
    """Twice the rays take twice the time and halve the error; the filter takes 1 ms more and leaves a quarter of it."""
    return [changed(CAUSTICS, rays_per_texel=r, filter=f, total_ms=10 * r + (1 if f == "wavelet" else 0),
                    relmse=100 / r / (4 if f == "wavelet" else 1), relmse_low=20 / r, relmse_high=130 / r)
            for r in (0.25, 0.5, 1, 2, 4) for f in ("none", "wavelet")]


def lights() -> list[Row]:
    return [changed(CAUSTICS, lights_visible=v, lights_invisible=i, total_ms=3 * v + 2 * i + 1 + 0.01 * ((7 * v + 3 * i) % 5),
                    relmse="", relmse_low="", relmse_high="") for v in (0, 2, 4) for i in (0, 2, 4)]


def run(script: str, *arguments: object, interpreter: Sequence[str] = ("/usr/bin/python3",),
        env: dict[str, str] | None = None) -> subprocess.CompletedProcess:
    return subprocess.run([*interpreter, str(SCRIPTS / script), *map(str, arguments)], capture_output=True, text=True, env=env)
