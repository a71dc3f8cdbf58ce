#!/usr/bin/python3
"""Draws all tables and figures from the CSVs of a results folder, as PDF, SVG and PNG; the tables as text and LaTeX.

What has no CSV yet is skipped with a line that says so. The same CSVs give the same bytes.
"""

import argparse
import fnmatch
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

try:
    from figures import accuracy, caustics, designs, pictures, scaling, ssrm, ssrm_layers, ssrm_rays, stability, time_error
    from figures.results import Results, Skip
    from inputs import InputError
except ModuleNotFoundError as missing:
    print(f"figures: Python's {missing.name} is missing; scripts/setup.sh installs it for /usr/bin/python3", file=sys.stderr)
    sys.exit(2)

Draw = Callable[[Results, Path], list[Path]]
FIGURES: dict[str, Draw] = {
    "ssrm_tables": ssrm.draw_tables,
    "ssrm_times": ssrm.draw_times,
    "ssrm_verdicts": pictures.draw_verdicts,
    "ssrm_alpha": ssrm.draw_alpha,
    "ssrm_precision_recall": ssrm.draw_precision_recall,
    "ssrm_designs": designs.draw,
    "ssrm_scaling": scaling.draw,
    "ssrm_thickness": accuracy.draw,
    "ssrm_layers": ssrm_layers.draw,
    "ssrm_breakeven": ssrm_rays.draw_break_even,
    "ssrm_distribution": ssrm_rays.draw_distribution,
    "stability": stability.draw,
    "caustics_onoff": pictures.draw_onoff,
    "caustics_rays": partial(caustics.draw_rays, name="caustics_rays"),
    "caustics_rays_objects": partial(caustics.draw_rays, name="caustics_rays_objects"),
    "caustics_depth": partial(caustics.draw_depth, name="caustics_depth"),
    "caustics_depth_objects": partial(caustics.draw_depth, name="caustics_depth_objects"),
    "caustics_lights": caustics.draw_lights,
}


def all_figures(results: Results) -> dict[str, Draw]:
    """The figures above, and run time against error for every table."""
    return FIGURES | {f"time_error_{name}": partial(time_error.draw, name=name) for name in results.paths}


def chosen(names: list[str], patterns: list[str]) -> list[str]:
    """Names that match a pattern, all without patterns; exits where a pattern matches none."""
    for pattern in patterns:
        if not fnmatch.filter(names, pattern):
            print(f"figures: --only {pattern}: no such figure; there are {', '.join(names)}", file=sys.stderr)
            sys.exit(2)
    return [n for n in names if not patterns or any(fnmatch.fnmatchcase(n, p) for p in patterns)]


def shown(path: Path) -> str:
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, nargs="?", default=ROOT / "results" / "out", help="folder of the runs (results/out)")
    parser.add_argument("-o", "--output", type=Path, help="folder for the figures (RESULTS/figures)")
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="only this figure; * stands for anything")
    arguments = parser.parse_args()
    folder = arguments.output or arguments.results / "figures"
    failed = False
    try:
        results = Results(arguments.results)
        figures = all_figures(results)
        names = chosen(list(figures), arguments.only)
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            try:
                written = figures[name](results, folder)
                stems = dict.fromkeys(path.stem for path in written)
                files = [f"{stem} ({', '.join(p.suffix[1:] for p in written if p.stem == stem)})" for stem in stems]
                print(f"made     {name}: {', '.join(files)}")
            except Skip as reason:
                print(f"skipped  {name}: {reason}")
            except InputError as error:
                print(f"figures: {name}: {error}", file=sys.stderr)
                failed = True
        print(f"in {shown(folder)}")
    except InputError as error:
        print(f"figures: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"figures: {error.filename or folder}: {error.strerror}", file=sys.stderr)
        return 2
    return 2 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
