#!/usr/bin/env python3
"""Runs data/generate.py again: it must write the models and scenes that are in data/, byte for byte, and no others but
the few made by hand. The scenes of the paper must have the numbers of control faces that the paper states, and nothing that is not shown."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

DATA = Path(__file__).resolve().parent.parent / "data"
# Müller, Techmann and Fellner 2003, section 9.2; the versions in quads have as many as they have.
FACES = {"frogship": 268, "col-henge": 5756, "eggs-n-bunnies": 10328}
MADE_BY_HAND = {"scenes/mirrors.json", "scenes/plate.obj", "scenes/schema.json"}


def written(folder):
    files = {p.relative_to(folder).as_posix(): p for pattern in ("*.obj", "scenes/**/*.*") for p in folder.glob(pattern)}
    return {name: p.read_bytes() for name, p in files.items() if name not in MADE_BY_HAND}


class Count:
    """Counts a scene's control faces over its instances, and remembers what it has met."""

    def __init__(self, file):
        self.folder = file.parent
        self.scene = json.loads(file.read_text())
        self.objects, self.materials, self.models, self.sizes = set(), set(), set(), set()
        self.faces = self.instances(self.scene)

    def instances(self, group):
        self.materials |= {i["material"] for i in group["instances"] if "material" in i}
        return sum(self.object(i["object"]) for i in group["instances"])

    def object(self, name):
        self.objects.add(name)
        shape = self.scene["objects"][name]
        if "instances" in shape:
            return self.instances(shape)
        self.models.add(shape["model"])
        lines = (self.folder / shape["model"]).read_text().splitlines()
        self.sizes |= {len(line.split()) - 1 for line in lines if line.startswith("f ")}
        assert f"t scheme 0/0/1 {self.scene['scheme']}" in lines, f"{shape['model']} is for another scheme"
        return sum(line.startswith("f ") for line in lines)


def winding_fault(file):
    """What is wrong with the sides of a model's faces: neighbours must agree, and a closed one show its outside."""
    lines = [line.split() for line in file.read_text().splitlines()]
    points = [[float(x) for x in words[1:]] for words in lines if words[0] == "v"]
    faces = [[int(v) - 1 for v in words[1:]] for words in lines if words[0] == "f"]
    edges = [edge for face in faces for edge in zip(face, face[1:] + face[:1])]
    if len(set(edges)) < len(edges):
        return "neighbouring faces wind differently"
    if {v for face in faces for v in face} != set(range(len(points))):
        return "has isolated points"
    closed = {(b, a) for a, b in edges} == set(edges)
    volume = sum(determinant(*(points[v] for v in (f[0], f[i], f[i + 1]))) for f in faces for i in range(1, len(f) - 1))
    return "shows its inside" if closed and volume <= 0 else None


def determinant(a, b, c):
    return sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))


def faults(name, count):
    scheme = count.scene["scheme"]
    if scheme == "loop" and count.faces != FACES.get(name):
        yield f"has {count.faces} control faces, expected {FACES.get(name)}"
    if count.sizes != ({3} if scheme == "loop" else {4}):
        yield f"has faces of {sorted(count.sizes)} corners"
    if len(count.scene["lights"]) != 1:
        yield "has more than one light"
    if count.objects != count.scene["objects"].keys() or count.materials != count.scene["materials"].keys():
        yield "defines objects or materials that it does not show"


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, str(DATA / "generate.py"), folder], check=True)
        fresh, kept = written(Path(folder)), written(DATA)
    errors = [
        f"{name}: differs from what the generator writes"
        for name in sorted(fresh.keys() | kept.keys()) if fresh.get(name) != kept.get(name)
    ]
    made = [DATA / name for name in sorted(fresh) if name.endswith(".json")]
    counts = {file.stem: Count(file) for file in made}
    errors += [f"{name}: {fault}" for name, count in counts.items() for fault in faults(name, count)]
    expected = FACES.keys() | {f"{name}-catmark" for name in FACES}
    errors += [f"{name}: missing or not expected" for name in sorted(counts.keys() ^ expected)]
    shown = {f"scenes/{model}" for count in counts.values() for model in count.models}
    models = {name for name in kept if name.startswith("scenes/") and name.endswith(".obj")}
    errors += [f"{name}: in no scene" for name in sorted(models - shown)]
    errors += [f"{name}: {fault}" for name in sorted(shown) if (fault := winding_fault(DATA / name))]
    sizes = ", ".join(f"{name} {count.faces}" for name, count in counts.items())
    print("\n".join(errors) or f"{len(kept)} files are the generator's; control faces: {sizes}")
    return 1 if errors or not kept else 0


sys.exit(main())
