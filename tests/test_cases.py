#!/usr/bin/env python3
"""Replays the recorded failures of data/cases (its README has the format) with the tool in SHAOLIN_BINARY."""
import csv
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = Path(os.environ["SHAOLIN_DATA"]) / "cases"
TOLERANCE = 1e-10  # times the magnitude of what is compared, or 1 if that is larger
RAY = ["ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"]
PARAMETER = ["face", "sub", "u", "v"]


def rows(file):
    with open(file, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def answers(command, model, option, questions, columns):
    """Runs the tool on the question columns of a case; returns its rows."""
    with tempfile.TemporaryDirectory() as folder:
        given, found = Path(folder) / "given.csv", Path(folder) / "found.csv"
        with open(given, "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, columns, extrasaction="ignore")
            writer.writeheader()
            writer.writerows(questions)
        tool = os.environ["SHAOLIN_BINARY"]
        subprocess.run([tool, command, str(model), option, str(given), "-o", str(found)], check=True)
        return rows(found)


def answer_columns(file, questions):
    """What a case says besides the question; a file that says nothing would never fail."""
    columns = [column for column in rows(file)[0] if column not in questions]
    assert columns, f"{file.name} has no answers"
    return columns


def differs(expected, found):
    if expected == "" or found == "":
        return expected != found
    return not math.isclose(float(expected), float(found), rel_tol=TOLERANCE, abs_tol=TOLERANCE)


def faults_of(model):
    kinds = [("rays", "query", "--rays", RAY), ("params", "eval", "--params", PARAMETER)]
    recorded = [(model.with_suffix(f".{kind[0]}.csv"), *kind) for kind in kinds]
    if not any(file.is_file() for file, *_ in recorded):
        yield f"{model.name}: has neither rays nor params"
    for file, _, command, option, given in recorded:
        if not file.is_file():
            continue
        cases, wanted = rows(file), answer_columns(file, given)
        found = answers(command, model, option, cases, given)
        if len(found) != len(cases):
            yield f"{file.name}: {len(cases)} rows in, {len(found)} rows out"
        for number, (case, answer) in enumerate(zip(cases, found), start=2):
            for column in wanted:
                if differs(case[column], answer[column]):
                    is_now, expected = answer[column] or "empty", case[column] or "empty"
                    yield f"{file.name}:{number}: {column} is {is_now}, expected {expected}"


models = sorted(CASES.glob("*.obj"))
faults = [fault for model in models for fault in faults_of(model)]
print("\n".join(faults) or f"{len(models)} recorded failures stay mended")
sys.exit(1 if faults else 0)
