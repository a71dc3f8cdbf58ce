"""Reads the files of a results folder, and says in one sentence what is wrong with one: which file, and where in it."""

import json
from pathlib import Path

NOT_RUNS = {"figures", "gates", "pictures"}
SHARDS = "shard-*-of-*"


class InputError(Exception):
    """An input that cannot be used. The message names the file and, where there is one, the place in it."""


def read_text(file: Path) -> str:
    try:
        return file.read_bytes().decode("utf-8")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: not UTF-8 at byte {error.start}") from error


def read_manifest(file: Path) -> dict:
    """The manifest of a run; empty where there is none."""
    if not file.exists():
        return {}
    try:
        manifest = json.loads(read_text(file))
    except json.JSONDecodeError as error:
        raise InputError(f"{file}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from error
    if not isinstance(manifest, dict):
        raise InputError(f"{file}: expected an object with the parts config, program, machine and run")
    return manifest


def part(manifest: dict, *names: str) -> dict:
    """A nested object of a manifest; empty where it is missing or no object."""
    for name in names:
        manifest = manifest.get(name)
        if not isinstance(manifest, dict):
            return {}
    return manifest


def run_folders(results: Path) -> list[Path]:
    """The folders of a results folder that may hold a run: itself and those in it. A shard is a part of a run, until it is merged."""
    if not results.is_dir():
        raise InputError(f"{results}: no such folder; `hybray run` makes one")
    return [results, *sorted(f for f in results.iterdir() if f.is_dir() and f.name not in NOT_RUNS and not f.match(SHARDS))]
