"""The scene Col-Henge: a henge of Greek columns, one of them fallen, around a polished ball."""
from math import cos, pi, sin

from .mesh import INFINITE, Mesh
from .scene import Scene, instance
from .solids import ball, block, cap, finished, lathe

COLUMNS = 12
FALLEN = 10  # the column of which only a stump stands
RADIUS = 5.5  # of the ring of columns
TOP = 4.75  # of the columns
FLUTES = 16
# Radius, height, sharpness.
BASE = [(0.66, 0.2, 3), (0.7, 0.33, 0), (0.58, 0.44, 2), (0.6, 0.54, 0), (0.5, 0.62, 2)]
CAPITAL = [(0.4, 4.0, 2), (0.46, 4.08, 2), (0.44, 4.14, 2), (0.62, 4.34, 0), (0.66, 4.5, 3)]
SHAFT = [(0.55, 0.58), (0.535, 1.8), (0.49, 3.0), (0.42, 4.06)]
STEPS = [
    (8.4, -0.9, INFINITE), (8.4, -0.6, 5), (7.7, -0.6, INFINITE), (7.7, -0.3, 5), (7.0, -0.3, INFINITE), (7.0, 0, 5),
    (4.0, 0, 0),
]


def fluted(mesh, rings):
    """Rings of (radius, height) whose every second point is drawn in; the arrises between the flutes are sharp."""
    def place(radius, height):
        def at(angle):
            flute = round(angle * FLUTES / pi) % 2
            r = radius * (0.86 if flute else 1)
            return r * cos(angle), height, -r * sin(angle)
        return at

    made = [mesh.ring(2 * FLUTES, place(*ring)) for ring in rings]
    for lower, upper in zip(made, made[1:]):
        mesh.band(lower, upper)
    for arris in range(0, 2 * FLUTES, 2):
        mesh.crease([ring[arris] for ring in made], INFINITE)
    return made


def shaft(scheme):
    mesh = Mesh(scheme, "A column's shaft: flutes between sharp arrises, a slight swelling; open above and below.")
    fluted(mesh, SHAFT)
    return finished(mesh)


def drum(scheme):
    mesh = Mesh(scheme, "A drum of a broken column: fluted, closed, its ends worn.")
    low, high = fluted(mesh, [(0.53, -0.6), (0.515, 0.6)])
    for ring in (low, high):
        mesh.crease(ring, 3, closed=True)
    cap(mesh, low[::-1], -0.52)
    cap(mesh, high, 0.66)
    return finished(mesh)


def turned(scheme, profile, comment):
    mesh = Mesh(scheme, comment)
    lathe(mesh, profile, 12)
    return finished(mesh)


def lintel(scheme):
    """Lies on the columns; its middle is at the angle 0 of the ring, its ends are at plus and minus half a slot."""
    mesh = Mesh(scheme, "A curved lintel with a cornice, closed, all its edges semi-sharp creases.")
    section = [(-0.42, 0), (0.42, 0), (0.42, 0.5), (0.62, 0.58), (0.62, 0.76), (-0.42, 0.76)]
    half = pi / COLUMNS - 0.006
    ends = []
    for angle in (half, 0, -half):
        ends.append(
            [mesh.point((RADIUS + r) * cos(angle), TOP + y, -(RADIUS + r) * sin(angle)) for r, y in section]
        )
    for a, b in zip(ends, ends[1:]):
        mesh.band(a, b)
    for end, side in ((ends[0], -1), (ends[-1], 1)):
        for corners in ((0, 1, 2, 5), (2, 3, 4, 5)):
            mesh.face(*[end[c] for c in corners[::side]])
        mesh.crease(end, 5, closed=True)
    for line in range(len(section)):
        mesh.crease([end[line] for end in ends], 5)
    return finished(mesh)


def steps(scheme):
    mesh = Mesh(scheme, "A round platform of three steps with sharp edges, open below.")
    rings = lathe(mesh, STEPS, 24)
    cap(mesh, rings[-1], 0)
    return finished(mesh)


def ground(scheme):
    """A ring: its hole is under the steps."""
    mesh = Mesh(scheme, "Rolling land around the platform, a ring with two boundaries.")
    rings = []
    for distance, swell in ((90, 4.0), (34, 1.6), (16, 0.4), (7.5, 0)):
        def place(angle, distance=distance, swell=swell):
            height = -0.85 + swell * (0.5 * cos(3 * angle) - 0.4 * sin(5 * angle) - 0.2)
            return distance * cos(angle), height, -distance * sin(angle)

        rings.append(mesh.ring(24, place))
    for outer, inner in zip(rings, rings[1:]):
        mesh.band(outer, inner)
    return finished(mesh)


def around(name, material, slot, distance=0.0):
    """An instance turned to a place on the ring; slots count from 0 and may lie between columns."""
    angle = 2 * pi * slot / COLUMNS
    place = (distance * cos(angle), 0, -distance * sin(angle)) if distance else None
    return {"name": name, "material": material, "rotate": (0, 1, 0, 360 * slot / COLUMNS), "translate": place}


def objects(henge):
    scheme = henge.scheme
    henge.model("shaft", shaft(scheme))
    henge.model("base", turned(scheme, BASE, "A column's base, turned, without top and bottom."))
    henge.model("capital", turned(scheme, CAPITAL, "A column's capital, turned, without top and bottom."))
    henge.model("drum", drum(scheme))
    henge.model("block", block(scheme, "A block of stone with slightly rounded edges.", 4))
    henge.model("lintel", lintel(scheme))
    henge.model("steps", steps(scheme))
    henge.model("ground", ground(scheme))
    henge.model("ball", ball(scheme, "A ball."))
    plinth = instance("block", scale=(0.72, 0.1, 0.72), translate=(0, 0.1, 0))
    abacus = instance("block", scale=(0.68, 0.125, 0.68), translate=(0, 4.625, 0))
    henge.group("column", plinth, instance("base"), instance("shaft"), instance("capital"), abacus)
    henge.group("stump", plinth, instance("base"), instance("drum", scale=(1, 1.1, 1), translate=(0, 1.2, 0)))
    henge.group("fallen", instance("lintel", translate=(-RADIUS, -TOP, 0)))


def scene(scheme):
    henge = Scene("col-henge", scheme)
    objects(henge)
    henge.material("marble", (0.62, 0.57, 0.49))
    henge.material("floor", (0.42, 0.39, 0.36), 0.15)
    henge.material("grass", (0.13, 0.2, 0.06))
    henge.material("rock", (0.24, 0.23, 0.21))
    henge.material("silver", (0.3, 0.3, 0.32), 0.75)

    henge.show("ground", "grass")
    henge.show("steps", "floor")
    for slot in range(COLUMNS):
        henge.show(**around("stump" if slot == FALLEN else "column", "marble", slot, RADIUS))
        if slot not in (FALLEN, FALLEN - 1):
            henge.show(**around("lintel", "marble", slot + 0.5))
    henge.show("block", "marble", scale=(0.55, 0.6, 0.55), translate=(0, 0.6, 0))
    henge.show("ball", "silver", scale=0.77, translate=(0, 1.97, 0))
    henge.show("drum", "marble", rotate=(0.9, 0, 0.5, 90), translate=(1.15, 0.46, 6.0))
    henge.show("block", "marble", scale=(0.68, 0.125, 0.68), rotate=(0.2, 0.1, 1, 24), translate=(4.9, 0.22, 4.3))
    henge.show("fallen", "marble", rotate=(0.05, 1, 0.08, 110), translate=(5.6, -0.85, 8.6))
    henge.show("block", "marble", scale=(0.45, 0.5, 0.4), rotate=(0.5, 0.4, 0.6, 58), translate=(7.6, -0.55, 7.2))
    henge.show("ball", "rock", scale=(0.9, 0.55, 0.72), rotate=(0, 1, 0, 30), translate=(1.3, -0.72, 10.3))
    henge.show("ball", "rock", scale=(0.45, 0.33, 0.38), rotate=(0, 1, 0, 70), translate=(3.0, -0.72, 10.0))
    henge.camera((7.4, 6.2, 18.6), (0.1, 1.3, 0), 45)
    henge.light((-60, 70, 40), (1.1, 1.0, 0.84))
    henge.background((0.3, 0.42, 0.6))
    return henge
