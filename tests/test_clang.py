#!/usr/bin/env python3
"""Holds every source that the build compiles free of warnings under Clang: test_clang.py COMPILE_COMMANDS FOLDER.

Reads the build's own command lines, so that include paths and definitions are the same, and compiles into FOLDER
without optimisation; through ccache, if it is there, so that what has not changed costs nothing.
"""
import json
import os
import shlex
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"]
KEPT = ("-I", "-D", "-std")


def command(entry, compiler, target):
    words = shlex.split(entry["command"])
    flags = [w for w in words if w.startswith(KEPT)]
    for flag, folder in zip(words, words[1:]):
        if flag == "-isystem":
            flags += [flag, folder]
    language = ["-x", "c" if entry["file"].endswith(".c") else "c++"]
    return [*compiler, *WARNINGS, *flags, *language, "-c", entry["file"], "-o", str(target)]


def main():
    clang = shutil.which("clang++")
    if clang is None:
        print("clang++ is not installed; tools/setup installs it")
        return 1
    compiler = [shutil.which("ccache"), clang] if shutil.which("ccache") else [clang]
    with open(sys.argv[1], encoding="utf-8") as file:
        entries = json.load(file)
    folder = Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)

    def compile_one(numbered):
        number, entry = numbered
        words = command(entry, compiler, folder / f"{number}.o")
        return subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(compile_one, enumerate(entries)))
    faults = [r.stderr for r in results if r.returncode != 0]
    print("".join(faults) or f"{len(entries)} sources are clean")
    return 1 if faults or not entries else 0


sys.exit(main())
