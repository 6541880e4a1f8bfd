#!/usr/bin/env python3
"""The repository's shape: its top level, and what no file of it may hold."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOP_LEVEL = {
    "CMakeLists.txt", "schemes", "intersect", "tools", "tests", "data", "docs", "README.md", "LICENSE", "CHANGELOG.md",
    "CONTRIBUTING.md", "CMakePresets.json", ".clang-format", ".clang-tidy", ".ci", ".gitignore",
}
UNTRACKED = {".git", "build", "out"}
EXECUTABLE = {"tools/build_preset", "tools/quickstart", "tools/test", "tools/setup", ".ci/run", "data/generate.py"}
LONGEST_SOURCE = 500  # lines; CONTRIBUTING.md asks for about 400
LARGEST_FILE = 512 * 1024
LARGEST_MODEL = 60 * 1024
LARGEST_PICTURE = 200 * 1024
PICTURES = "docs/images/"  # the only files that are not text: PNG
# Split, so that this file does not hold what it looks for.
FORBIDDEN = {
    "an unfinished mark": re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b"),
    "a path of one machine": re.compile(r"(?<![\w.])/(?:home|root|Users|tmp|work|workspace|mnt|opt)/\w"),
    "a conflict mark": re.compile(r"^(<{7}|>{7}|={7})( |$)", re.M),
    "white space at a line's end": re.compile(r"[ \t]+$", re.M),
    "a tab": re.compile(r"\t"),
}
LICENSE_TEXT = {"LICENSE"}  # not ours to edit


def files():
    """What git has or would add; without git, everything but the folders that it ignores."""
    command = ["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listing = subprocess.run(command, capture_output=True).stdout if shutil.which("git") else b""
    if listing:
        paths = sorted(set(listing.decode().split("\0")) - {""})
    else:
        paths = sorted(p.relative_to(ROOT).as_posix() for p in ROOT.rglob("*") if p.is_file())
        paths = [p for p in paths if p.split("/")[0] not in UNTRACKED and "__pycache__" not in p]
    return [p for p in paths if (ROOT / p).is_file()]


def faults_of(path):
    file = ROOT / path
    data = file.read_bytes()
    is_picture = path.startswith(PICTURES)
    limit = LARGEST_PICTURE if is_picture else LARGEST_MODEL if path.startswith("data/") else LARGEST_FILE
    if len(data) > limit:
        yield f"{path}: {len(data)} bytes, more than {limit}"
    if is_picture:
        if not data.startswith(b"\x89PNG\r\n"):
            yield f"{path}: not a PNG file"
        return
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        yield f"{path}: not a text file"
        return
    if path in LICENSE_TEXT:
        return
    if text and not text.endswith("\n"):
        yield f"{path}: no newline at the end"
    if path.endswith((".h", ".cpp")) and text.count("\n") > LONGEST_SOURCE:
        yield f"{path}: {text.count(chr(10))} lines, more than {LONGEST_SOURCE}"
    for name, pattern in FORBIDDEN.items():
        for match in pattern.finditer(text):
            yield f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {name}"


def main():
    paths = files()
    top = {p.split("/")[0] for p in paths}
    faults = [f"{name}: not a name of the top level" for name in sorted(top - TOP_LEVEL)]
    faults += [f"{name}: missing at the top level" for name in sorted(TOP_LEVEL - top)]
    faults += [f"{p}: missing or not executable" for p in sorted(EXECUTABLE) if not os.access(ROOT / p, os.X_OK)]
    faults += [fault for path in paths for fault in faults_of(path)]
    print("\n".join(faults) or f"{len(paths)} files are in order")
    return 1 if faults else 0


sys.exit(main())
