#!/usr/bin/env python3
"""Runs data/generate.py again: it must write the models that are in data/, byte for byte, and no others."""
import subprocess
import sys
import tempfile
from pathlib import Path

DATA = Path(__file__).resolve().parent.parent / "data"


def models(folder):
    return {p.name: p.read_bytes() for p in sorted(folder.glob("*.obj"))}


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, str(DATA / "generate.py"), folder], check=True)
    fresh, kept = models(Path(folder)), models(DATA)

different = [name for name in sorted(fresh.keys() | kept.keys()) if fresh.get(name) != kept.get(name)]
if different:
    print("differ from what the generator writes: " + ", ".join(different))
else:
    print(f"{len(kept)} models are the generator's")
sys.exit(1 if different or not kept else 0)
