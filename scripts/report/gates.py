"""Results of gates: the JUnit XML that a check wrote, or its Markdown summary as it stands."""

from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from inputs import InputError, read_text


@dataclass
class Gate:
    name: str
    group: str
    result: str  # passed, failed, skipped
    message: str


@dataclass
class GateFile:
    name: str
    gates: list[Gate] = field(default_factory=list)
    text: str = ""  # a summary that is not JUnit

    def count(self, result: str) -> int:
        return sum(gate.result == result for gate in self.gates)


def read_junit(file: Path) -> list[Gate]:
    try:
        root = ElementTree.fromstring(read_text(file))
    except ElementTree.ParseError as error:
        raise InputError(f"{file}:{error.position[0]}:{error.position[1] + 1}: not XML: {error.msg}") from error
    if root.tag not in ("testsuites", "testsuite"):
        raise InputError(f"{file}: expected JUnit XML, whose root is testsuites or testsuite, found {root.tag}")
    gates = []
    for case in root.iter("testcase"):
        result, said = "passed", [case.findtext("system-out") or ""]
        for tag, label in (("skipped", "skipped"), ("failure", "failed"), ("error", "failed")):
            note = case.find(tag)
            if note is not None:
                result, said = label, [note.get("message") or "", note.text or "", *said]
        lines = [line.strip() for text in said for line in text.splitlines()]
        message = "\n".join(dict.fromkeys(filter(None, lines)))
        gates.append(Gate(case.get("name", ""), case.get("classname", "").removeprefix("hybray."), result, message))
    return sorted(gates, key=lambda gate: ("failed", "skipped", "passed").index(gate.result))


def read_gates(results: Path) -> list[GateFile]:
    """What is in RESULTS/gates and in the folder `gates` of each run: every NAME.xml, and NAME.md where it has no NAME.xml."""
    found = []
    for folder in (results / "gates", *sorted(results.glob("*/gates"))):
        prefix = "" if folder.parent == results else folder.parent.name + "/"
        for file in sorted(folder.glob("*.xml")):
            found.append(GateFile(prefix + file.stem, read_junit(file)))
        for file in sorted(folder.glob("*.md")):
            if not file.with_suffix(".xml").exists():
                found.append(GateFile(prefix + file.stem, text=read_text(file)))
    return found
