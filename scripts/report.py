#!/usr/bin/python3
"""Makes one self-contained HTML page from a results folder: summary, tables, figures, picture comparisons, provenance."""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

try:
    from inputs import InputError
    from report.page import make_page
except ModuleNotFoundError as missing:
    print(f"report: Python's {missing.name} is missing; scripts/setup.sh installs it for /usr/bin/python3", file=sys.stderr)
    sys.exit(2)


def positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"expected a positive integer, found {text}")
    return value


def write(file: Path, text: str) -> None:
    """By write-and-rename, so that there is never half a page."""
    partial = file.with_name(file.name + ".part")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(file)
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path, nargs="?", default=ROOT / "results" / "out",
                        help="folder of one run, or of a folder for each run (default: results/out)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="the page (default: report.html in the results folder)")
    parser.add_argument("--program", type=Path, help="the built hybray, which says what the columns mean "
                                                     "(default: build/release/hybray, if it is there)")
    parser.add_argument("--title", default="hybray report")
    parser.add_argument("--max-side", type=positive, default=1280, metavar="PIXELS",
                        help="shrink pictures whose longer side is longer than this (default: 1280)")
    parser.add_argument("--max-mb", type=positive, default=25, metavar="MB",
                        help="compress pictures with loss, then shrink them, until they take no more than this (default: 25)")
    options = parser.parse_args()
    output = options.output or options.results / "report.html"
    program = options.program or next((p for p in [ROOT / "build" / "release" / "hybray"] if p.exists()), None)
    try:
        page = make_page(options.results, output, program, options.title, options.max_side, options.max_mb * 1_000_000)
        write(output, page)
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"report: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    print(f"report: {output} ({len(page.encode()) / 1e6:.1f} MB)", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
