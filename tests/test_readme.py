#!/usr/bin/env python3
"""Runs every documented command line of the tool, and holds the examples of code against tests/consumer.

test_readme.py FOLDER [--small]: FOLDER is made anew and holds the checkout's data/ and build/release/ while the
commands run; the environment's
SHAOLIN_BINARY is the tool, and the benchmarks stand beside it. A line counts if it stands in an `sh` block and begins with
`shaolin `, `build/release/shaolin ` or `build/release/shaolin_bench_...`; lines that end in a backslash go on. Each must
exit with 0. --small draws images of a sixteenth of the pixels: sanitizers take minutes for the documented ones.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
TOOL = re.compile(r"(?:build/release/)?(shaolin)|build/release/(shaolin_bench_\w+)")


def blocks(file, language):
    return [body for name, body in BLOCK.findall(file.read_text(encoding="utf-8")) if name == language]


def commands(file):
    for body in blocks(file, "sh"):
        for line in body.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            tool = TOOL.fullmatch(words[0]) if words else None
            if tool:
                yield tool[1] or tool[2], words[1:]


def smaller(words):
    """A rendering's words with large sizes divided by four."""
    if words[:1] != ["render"]:
        return words
    return [re.sub(r"^(\d{3,})x(\d{3,})$", lambda m: f"{int(m[1]) // 4}x{int(m[2]) // 4}", word) for word in words]


def main():
    binary = os.environ["SHAOLIN_BINARY"]
    folder = Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "out").mkdir(parents=True)
    (folder / "data").symlink_to(ROOT / "data", target_is_directory=True)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(Path(binary).resolve().parent, target_is_directory=True)

    faults, ran = [], set()  # what several pages show runs once
    for file in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for tool, words in commands(file):
            if "--small" in sys.argv[2:]:
                words = smaller(words)
            if (tool, *words) in ran:
                continue
            ran.add((tool, *words))
            program = binary if tool == "shaolin" else Path(binary).resolve().parent / tool
            done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                faults.append(f"{file.name}: {tool} {shlex.join(words)}: exit {done.returncode}\n{done.stderr}")

    consumer = ROOT / "tests" / "consumer"
    for page, language, source in (("README.md", "cmake", "CMakeLists.txt"), ("README.md", "cpp", "main.cpp"),
                                   ("docs/schemes.md", "cmake", "CMakeLists.txt"),
                                   ("docs/schemes.md", "cpp", "midpoints.cpp")):
        examples = blocks(ROOT / page, language)
        built = (consumer / source).read_text(encoding="utf-8")
        if not examples or any(example not in built for example in examples):
            faults.append(f"{page}: its {language} example is not part of tests/consumer/{source}")

    print("\n".join(faults) or f"{len(ran)} documented commands ran, the examples are those that are built")
    return 1 if faults or not ran else 0


sys.exit(main())
