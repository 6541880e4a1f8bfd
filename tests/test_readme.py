#!/usr/bin/env python3
"""Runs every documented command line of the tool, and holds the README's library example against tests/consumer.

test_readme.py FOLDER: FOLDER is made anew and holds the checkout's data/ while the commands run; the environment's
SHAOLIN_BINARY is the tool. A line counts if it stands in an `sh` block and begins with `shaolin ` or
`build/release/shaolin `; lines that end in a backslash go on. Each must exit with 0.
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
NAMES = ("shaolin", "build/release/shaolin")


def blocks(file, language):
    return [body for name, body in BLOCK.findall(file.read_text(encoding="utf-8")) if name == language]


def commands(file):
    for body in blocks(file, "sh"):
        for line in body.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words and words[0] in NAMES:
                yield words[1:]


def main():
    binary = os.environ["SHAOLIN_BINARY"]
    folder = Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "out").mkdir(parents=True)
    (folder / "data").symlink_to(ROOT / "data", target_is_directory=True)

    faults, ran = [], 0
    for file in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for words in commands(file):
            ran += 1
            done = subprocess.run([binary, *words], cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                faults.append(f"{file.name}: shaolin {shlex.join(words)}: exit {done.returncode}\n{done.stderr}")

    consumer = ROOT / "tests" / "consumer"
    for language, source in (("cmake", consumer / "CMakeLists.txt"), ("cpp", consumer / "main.cpp")):
        examples = blocks(ROOT / "README.md", language)
        if not examples or any(example not in source.read_text(encoding="utf-8") for example in examples):
            faults.append(f"README.md: its {language} example is not part of tests/consumer/{source.name}")

    print("\n".join(faults) or f"{ran} documented commands ran, the library example is the one that is built")
    return 1 if faults or ran == 0 else 0


sys.exit(main())
