#!/usr/bin/python3
"""Lists where the large scenes come from, fetches what can be fetched, and checks files against known checksums.

Fetched files go to scenes/external/NAME/. A file whose checksum the project knows must match it. Of a file whose checksum it does not know,
the checksum of the first download is recorded in scenes/external/CHECKSUMS and every later check is against that: this notices damage and
change, but says nothing about the first download itself.
"""

import argparse
import hashlib
import os
import sys
import urllib.error
import urllib.request
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

ROOT = Path(__file__).resolve().parent.parent
EXTERNAL = ROOT / "scenes" / "external"
RECORD = EXTERNAL / "CHECKSUMS"
CHUNK = 1 << 20


@dataclass(frozen=True)
class Download:
    """One file to fetch into scenes/external/NAME/."""

    url: str
    file: str
    sha256: str = ""  # empty: not known to the project


@dataclass(frozen=True)
class Scene:
    name: str
    original: str  # where the original is, for people
    attribution: str
    note: str = ""
    downloads: tuple[Download, ...] = ()
    converted_sha256: str = ""  # of the geometry-only NAME.glb that the project's results were made with


KHRONOS = (
    "https://raw.githubusercontent.com/KhronosGroup/glTF-Sample-Assets/"
    "05beb3484291a666e5543d8007a4b2a7b8c1c1a7/Models/Sponza/glTF/"
)

SCENES = (
    Scene(
        name="sponza",
        original="GitHub KhronosGroup/glTF-Sample-Assets, Models/Sponza/glTF/",
        attribution="Crytek Sponza: Frank Meinl / Crytek, after the Sponza atrium of Marko Dabrovic. "
        "Licence: Cryengine Limited License Agreement.",
        note="The same triangles as the converted file, up to the rounding of its positions; textures are not "
        "needed. The commit is pinned; the checksum is the one recorded at the first download.",
        downloads=(Download(KHRONOS + "Sponza.gltf", "sponza.gltf"), Download(KHRONOS + "Sponza.bin", "Sponza.bin")),
        converted_sha256="7c94ec854659fa6f413871901abdb81377319759ecd3700eb5fdd0cda9c0473d",
    ),
    Scene(
        name="bistro",
        original="NVIDIA ORCA, 'Amazon Lumberyard Bistro' (Bistro_v5_2.zip: exterior and interior); converted: GitHub "
        "zeux/niagara_bistro (bistro.gltf, bistro.bin) and mmp/pbrt-v4-scenes (bistro/)",
        attribution="Amazon Lumberyard Bistro, Open Research Content Archive (ORCA), Amazon Lumberyard 2017, CC BY 4.0; "
        "Godot port (GitHub Jamsers/Bistro-Demo-Tweaked, commit "
        "48e343493b49fb88f9045fe9e59e7af2cb6f2e8b) by Logan Preshaw and John James Gutib.",
        note="Has to be converted: the converted file has the Godot port's meshes, seven sections of it simplified "
        "(1,591,928 triangles; materials of those sections end in _standin). Another conversion gives other results, "
        "and cameras may have to move.",
        converted_sha256="f400a6305b5a15361da8bbbcd1cb71530ea4a6999498b22f405862754a85deea",
    ),
    Scene(
        name="glass_table",
        original="GitHub wjakob/nori, scenes/pa5/table/ (meshes as .obj, lights and materials in its XML)",
        attribution="Table scene designed by Olesya Jakob (Nori). The repository states no licence for it.",
        note="Has to be converted: several .obj files, turned from Z up to Y up (x, y, z to x, z, -y).",
        converted_sha256="1f5757f0c153810d61dbcdc02daac02892206238e79f21a1509364ac9ceb2c63",
    ),
    Scene(
        name="stanford_bunny",
        original="Stanford 3D Scanning Repository, https://graphics.stanford.edu/data/3Dscanrep/ (bun_zipper.ply)",
        attribution="Stanford Computer Graphics Laboratory. Free for research; commercial use needs their permission.",
        note="Has to be converted from .ply, with smooth normals.",
        converted_sha256="9008625a93f24eda73bc69c5eb4e6bece17c9bcbea89eaa62cd24587b1ed16c1",
    ),
    Scene(
        name="stanford_dragon",
        original="Stanford 3D Scanning Repository, https://graphics.stanford.edu/data/3Dscanrep/ (dragon_vrip_res2.ply)",
        attribution="Stanford Computer Graphics Laboratory. Free for research; commercial use needs their permission.",
        note="Has to be converted from .ply, with smooth normals.",
        converted_sha256="9f0b9be393c49a16ebc7e68c2d1bf45007acf45555bfaf1f6e474ab1fee744e7",
    ),
)


def sha256_of(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while block := stream.read(CHUNK):
            digest.update(block)
    return digest.hexdigest()


def read_record() -> dict[str, str]:
    """Checksums recorded at first downloads, by path below scenes/external."""
    if not RECORD.exists():
        return {}
    lines = [line.split(maxsplit=1) for line in RECORD.read_text().splitlines() if line.strip()]
    return {path: digest for digest, path in lines}


def write_record(record: dict[str, str]) -> None:
    part = RECORD.with_name(RECORD.name + ".part")
    part.write_text("".join(f"{digest}  {path}\n" for path, digest in sorted(record.items())))
    part.replace(RECORD)


def download(url: str, target: Path) -> None:
    """Fetches `url` to `target` by way of target.part, which a later call continues where it broke off."""
    part = target.with_name(target.name + ".part")
    have = part.stat().st_size if part.exists() else 0
    request = urllib.request.Request(url, headers={"Range": f"bytes={have}-"} if have else {})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            continues = have > 0 and answer.status == 206
            remaining = answer.headers.get("Content-Length")
            expected = int(remaining) + (have if continues else 0) if remaining else None
            with part.open("ab" if continues else "wb") as stream:
                while block := answer.read(CHUNK):
                    stream.write(block)
    except urllib.error.HTTPError as error:
        if error.code != 416:  # 416: nothing is left to continue; the checksum decides about what is there
            raise
        expected = None
    if expected is not None and part.stat().st_size != expected:
        raise OSError(f"the connection broke off at {part.stat().st_size} of {expected} bytes; run again to continue")
    part.replace(target)


def fetch_file(scene: Scene, item: Download, record: dict[str, str]) -> bool:
    target = EXTERNAL / scene.name / item.file
    key = f"{scene.name}/{item.file}"
    known = item.sha256 or record.get(key, "")
    if target.exists() and known and sha256_of(target) == known:
        print(f"{key}: already there")
        return True
    print(f"{key}: fetching {item.url}", flush=True)
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        download(item.url, target)
    except (OSError, urllib.error.URLError) as error:
        reason = getattr(error, "reason", error)
        print(f"{key}: cannot reach {urlsplit(item.url).netloc}: {reason}", file=sys.stderr)
        return False
    digest = sha256_of(target)
    if known and digest != known:
        rejected = target.with_name(target.name + ".rejected")
        target.replace(rejected)
        print(f"{key}: sha256 {digest} is not the expected {known}; kept as {rejected.name}", file=sys.stderr)
        return False
    if not known:
        record[key] = digest
        write_record(record)
        print(f"{key}: its checksum was not known; recorded {digest}")
    return True


def list_scenes() -> int:
    for scene in SCENES:
        print(f"{scene.name}\n  original: {scene.original}\n  attribution: {scene.attribution}")
        if scene.note:
            print(f"  note: {scene.note}")
        for item in scene.downloads:
            print(f"  file: {item.url}\n        sha256 {item.sha256 or '(not known; recorded at the first download)'}")
        if not scene.downloads:
            print("  file: none that loads as it is")
        print(f"  converted file {scene.name}.glb: sha256 {scene.converted_sha256}")
    return 0


def source_folders() -> list[Path]:
    folders = [EXTERNAL]
    folders += [Path(f) for f in os.environ.get("HYBRAY_SCENE_PATH", "").split(":") if f]
    return folders


def verify() -> int:
    """Checks every scene file found in the source folders; 1 if one is wrong."""
    bad = found = 0
    record = read_record()
    for path in sorted(record):
        if (EXTERNAL / path).exists():
            found += 1
            good = sha256_of(EXTERNAL / path) == record[path]
            bad += not good
            print(f"{EXTERNAL / path}: {'as at its first download' if good else 'CHANGED since its first download'}")
    for folder in source_folders():
        for scene in SCENES:
            for path in (folder / f"{scene.name}.glb", folder / scene.name / f"{scene.name}.glb"):
                if path.exists():
                    found += 1
                    good = sha256_of(path) == scene.converted_sha256
                    bad += not good
                    print(f"{path}: {'good' if good else 'NOT the file that the results were made with'}")
    if found == 0:
        print(f"no scene files in: {', '.join(str(f) for f in source_folders())}", file=sys.stderr)
    return 1 if bad or found == 0 else 0


def fetch(names: list[str]) -> int:
    by_name = {scene.name: scene for scene in SCENES}
    unknown = [name for name in names if name not in by_name]
    if unknown:
        print(f"unknown scene: {', '.join(unknown)}; there are: {', '.join(by_name)}", file=sys.stderr)
        return 2
    record = read_record()
    failed = False
    for name in names or list(by_name):
        scene = by_name[name]
        if not scene.downloads:
            print(f"{name}: no single file loads as it is; the original: {scene.original}")
            failed |= bool(names)
        for item in scene.downloads:
            if not fetch_file(scene, item, record):
                failed = True
                break
    return 1 if failed else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", help="scenes to fetch (default: all that can be fetched)")
    parser.add_argument("--list", action="store_true", help="list originals, licences, files and checksums")
    parser.add_argument("--verify", action="store_true", help="check the files that are there, and HYBRAY_SCENE_PATH")
    arguments = parser.parse_args()
    if arguments.list:
        return list_scenes()
    if arguments.verify:
        return verify()
    return fetch(arguments.scene)


if __name__ == "__main__":
    sys.exit(main())
