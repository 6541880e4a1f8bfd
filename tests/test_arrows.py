#!/usr/bin/env python3
"""Fails on an include against the arrows of docs/architecture.md, and on an oracle where none may be."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# Which rooms a room's files may include.
MAY_USE = {
    "schemes": {"schemes"},
    "intersect": {"schemes", "intersect"},
    "tools": {"schemes", "intersect", "tools"},
    "tests": {"schemes", "intersect", "tools", "tests"},
}
# Parties that our answers are checked against, or raced with, share no code with the answers.
ORACLE = re.compile(r"^(opensubdiv/|embree|CGAL/|OpenMesh/)")
ORACLES_IN = ("tools/validate/", "tools/bench/", "tests/")
# CGAL's exact predicates decide where a patch may overlap itself; they construct nothing.
PREDICATES = {
    "intersect/overlap.cpp": {"CGAL/Exact_predicates_inexact_constructions_kernel.h", "CGAL/Projection_traits_3.h"}
}


def room_of(include, quoted, file):
    """The room that an include leads to; None for a system header."""
    if quoted:
        beside = (file.parent / include).resolve()
        target = beside if beside.is_file() else ROOT / include
        if not target.is_file() or ROOT not in target.parents:
            return None
        return target.relative_to(ROOT).parts[0]
    parts = include.split("/")
    if parts[0] == "shaolin" and len(parts) > 1:
        return parts[1]
    return parts[0] if len(parts) > 1 and parts[0] in MAY_USE and (ROOT / include).is_file() else None


def faults_of(file):
    path = file.relative_to(ROOT).as_posix()
    room = path.split("/")[0]
    for match in INCLUDE.finditer(file.read_text(encoding="utf-8")):
        quoted, include = match[1] == '"', match[2]
        target = room_of(include, quoted, file)
        if target is not None and target not in MAY_USE[room]:
            yield f"{path}: {room} may not include {include} ({target})"
        if quoted and target is None:
            yield f'{path}: "{include}" is no file of this repository'
        allowed = path.startswith(ORACLES_IN) or include in PREDICATES.get(path, ())
        if ORACLE.match(include) and not allowed:
            yield f"{path}: the oracle {include} belongs to {', '.join(ORACLES_IN)} only"


def main():
    files = [f for room in MAY_USE for f in sorted((ROOT / room).rglob("*")) if f.suffix in (".h", ".cpp", ".inl")]
    faults = [fault for file in files for fault in faults_of(file)]
    print("\n".join(faults) or f"{len(files)} files keep to the arrows")
    return 1 if faults or not files else 0


sys.exit(main())
