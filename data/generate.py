#!/usr/bin/env python3
"""Writes the models and scenes of this folder: generate.py [FOLDER].

The same bytes on every machine; a test compares them.
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from generator import basic, col_henge, eggs_n_bunnies, frogship  # noqa: E402
from generator.rook import rook  # noqa: E402
from generator.whale import whale  # noqa: E402

MODELS = [
    basic.cube_creases, basic.dart, basic.hole, basic.loop_torus, basic.ngon_body, basic.pole, basic.sail, basic.saddle,
    basic.tetrahedron, basic.torus, rook, whale,
]
SCENES = [frogship, col_henge, eggs_n_bunnies]


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(text.encode("ascii"))


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    for model in MODELS:
        write(folder / f"{model.__name__}.obj", model().text())
    for scene in [module.scene(scheme) for module in SCENES for scheme in ("loop", "catmark")]:
        write(folder / "scenes" / f"{scene.name}.json", scene.text())
        for file, mesh in scene.models.items():
            write(folder / "scenes" / scene.folder / file, mesh.text())


if __name__ == "__main__":
    main()
