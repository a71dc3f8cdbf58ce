#!/usr/bin/python3
"""Checks that includes point downward only: base < scene < optics < tracer < gbuffer < {ssrm, caustics, lighting} < truth, metrics < harness."""

import re
import sys
from pathlib import Path

FLOORS = {
    "core/base": 0,
    "core/scene": 1,
    "core/optics": 2,
    "core/tracer": 3,
    "core/gbuffer": 4,
    "core/ssrm": 5,
    "core/caustics": 5,
    "core/lighting": 5,
    "core/truth": 6,
    "core/metrics": 7,
    "harness": 8,
}
HEAVY = ("nlohmann/", "valijson/", "tiny_gltf", "CLI/", "spdlog/", "OpenImageIO/")
LIGHT = ("nlohmann/json_fwd.hpp",)
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def module_of(path: str) -> str | None:
    return next((module for module in FLOORS if path.startswith(module + "/")), None)


def problems_of(file: Path) -> list[str]:
    module = module_of(file.as_posix())
    found = []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        target = match.group(1)
        if file.suffix == ".h" and target.startswith(HEAVY) and target not in LIGHT:
            found.append(f"{file}:{number}: heavy header {target} belongs in a .cpp file")
        other = module_of(target)
        if module and other and other != module and FLOORS[other] >= FLOORS[module]:
            found.append(f"{file}:{number}: {module} must not include {other}")
    return found


def main() -> int:
    files = sorted(p for root in ("core", "harness") for p in Path(root).rglob("*") if p.suffix in (".h", ".cpp"))
    problems = [problem for file in files for problem in problems_of(file)]
    print("\n".join(problems), file=sys.stderr, end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
