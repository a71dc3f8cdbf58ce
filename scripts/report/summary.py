"""What ran, how it went, and where it came from: read from the manifests."""

from dataclasses import dataclass, field

from report.gates import GateFile
from report.runs import Run


@dataclass
class Note:
    level: str  # bad, warn
    text: str
    runs: list[str] = field(default_factory=list)


def plural(count: int, noun: str) -> str:
    return f"{count:,} {noun}" + ("" if count == 1 else "s")


def duration(seconds: object) -> str:
    if not isinstance(seconds, (int, float)) or isinstance(seconds, bool):
        return ""
    if seconds < 60:
        return f"{seconds:.3g} s"
    whole = round(seconds)
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02} min"


def count(run: Run, name: str) -> int | None:
    value = run.part("run").get(name)
    return value if isinstance(value, int) and not isinstance(value, bool) else None


def state(run: Run) -> tuple[str, str]:
    """In a word, and how grave it is."""
    if run.interrupted:
        return "interrupted", "warn"
    if count(run, "points_failed"):
        return "some failed", "bad"
    if not run.manifest:
        return "no manifest", "warn"
    return ("complete", "good") if run.part("run").get("complete") is True else ("incomplete", "warn")


def names(values: object) -> list[str]:
    return [str(v) for v in values] if isinstance(values, list) else []


def notes_of_run(run: Run) -> list[Note]:
    notes = []
    points, failed = count(run, "points"), count(run, "points_failed")
    if failed:
        notes.append(Note("bad", f"{failed:,} of {plural(points or 0, 'point')} failed and have no row", [run.name]))
    if run.interrupted:
        of = f" of {points:,}" if points else ""
        notes.append(Note("warn", f"stopped before its end: {len(run.rows):,}{of} rows are there", [run.name]))
    if not run.manifest:
        notes.append(Note("warn", "no manifest beside the table: where its numbers come from is unknown", [run.name]))
    if skipped := names(run.manifest.get("skipped_scenes")):
        notes.append(Note("warn", f"scenes left out, since their sources are missing: {', '.join(skipped)}", [run.name]))
    if run.part("run").get("timing") is False:
        notes.append(Note("warn", "ran without timing", [run.name]))
    if run.part("program").get("git_dirty") is True:
        notes.append(Note("warn", "built from a tree with uncommitted changes", [run.name]))
    floors = [row["at_floor"] for row in run.rows if row.get("at_floor")]
    if low := floors.count("true"):
        notes.append(Note("warn", f"{low:,} of {plural(len(floors), 'row')} with a reference are at its floor: their error is "
                                  "not told apart from the reference's own", [run.name]))
    return notes


def notes(runs: list[Run], gates: list[GateFile]) -> list[Note]:
    """What the reader must know before trusting a number, gravest first."""
    found = [note for run in runs for note in notes_of_run(run)]
    for file in gates:
        if failed := file.count("failed"):
            found.append(Note("bad", f"{failed:,} of {plural(len(file.gates), 'gate')} failed in {file.name}"))
    for label, part, key in (("commits", "program", "git_commit"), ("processors", "machine", "cpu")):
        values = {str(run.part(part)[key]) for run in runs if run.part(part).get(key)}
        if len(values) > 1:
            found.append(Note("warn", f"the runs come from {len(values)} {label}: do not compare times across them"
                              if part == "machine" else f"the runs come from {len(values)} {label}"))
    merged: dict[tuple[str, str], Note] = {}
    for note in found:
        merged.setdefault((note.level, note.text), Note(note.level, note.text)).runs.extend(note.runs)
    return sorted(merged.values(), key=lambda note: note.level != "bad")


def failures(run: Run) -> list[tuple[str, str]]:
    """Points that failed, as (what tells them apart, message); empty where the manifest does not list them."""
    listed = run.part("run").get("failures")
    swept = [*run.part("config", "sweep"), "scene", "camera"]
    found = []
    for failure in listed if isinstance(listed, list) else []:
        if isinstance(failure, dict):
            parameters = failure.get("parameters")
            named = {name: parameters[name] for name in dict.fromkeys(swept) if name in parameters} if isinstance(
                parameters, dict) else {}
            found.append((settings_text(named) or str(failure.get("id", "")), str(failure.get("message", ""))))
    return found


def settings_text(values: dict) -> str:
    return ", ".join(f"{name} = {value_text(value)}" for name, value in values.items())


def value_text(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return ", ".join(value_text(v) for v in value) if isinstance(value, list) else str(value)


def provenance(run: Run) -> list[tuple[str, str]]:
    """What made the numbers, as (label, text); empty entries are left out."""
    config, program, machine, ran = (run.part(name) for name in ("config", "program", "machine", "run"))
    commit = str(program.get("git_commit", ""))
    if commit and program.get("git_dirty") is True:
        commit += " with uncommitted changes"
    memory = machine.get("memory_bytes")
    scenes = [f"{name} {facts.get('content_hash', '')} ({facts['triangles']:,} triangles)"
              if isinstance(facts.get("triangles"), int) else f"{name} {facts.get('content_hash', '')}"
              for name, facts in run.part("scenes").items() if isinstance(facts, dict)]
    entries = [
        ("config", str(config.get("file", ""))),
        ("changed by", ", ".join([f"--set {s}" for s in names(config.get("set"))] +
                                 [f"--filter {f}" for f in names(config.get("filter"))])),
        ("shard", "{index} of {count}".format_map({"index": "", "count": "", **run.part("shard")})
         if run.part("shard") else ""),
        ("seed", str(config.get("seed", ""))),
        ("parameters", settings_text(run.part("config", "parameters"))),
        ("sweep", "; ".join(f"{name}: {value_text(values)}" for name, values in run.part("config", "sweep").items())),
        ("commit", commit),
        ("version", str(program.get("version", ""))),
        ("compiler", f"{program.get('compiler', '')} ({program.get('build_type', '')}) {program.get('flags', '')}"
         if program else ""),
        ("libraries", ", ".join(f"{name} {version}" for name, version in run.part("program", "libraries").items())),
        ("processor", str(machine.get("cpu", ""))),
        ("instruction sets", ", ".join(names(machine.get("instruction_sets")))),
        ("threads", f"{ran.get('threads', '')} of {machine.get('hardware_threads', '')}" if ran else ""),
        ("memory", f"{memory / 2**30:.1f} GiB" if isinstance(memory, int) else ""),
        ("scenes", "; ".join(scenes)),
        ("wall time", duration(ran.get("wall_time_s"))),
    ]
    return [(label, text) for label, text in entries if text]
