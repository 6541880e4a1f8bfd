#!/usr/bin/env python3
"""Writes the models of this folder: generate.py [FOLDER]. The same bytes on every machine; a test compares them."""
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from generator import basic  # noqa: E402
from generator.rook import rook  # noqa: E402
from generator.whale import whale  # noqa: E402

MODELS = [
    basic.cube_creases, basic.dart, basic.hole, basic.loop_torus, basic.ngon_body, basic.pole, basic.sail, basic.saddle,
    basic.tetrahedron, basic.torus, rook, whale,
]


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    for model in MODELS:
        (folder / f"{model.__name__}.obj").write_bytes(model().text().encode("ascii"))


if __name__ == "__main__":
    main()
