"""The scene Eggs'n'Bunnies: rabbits on a hill around an egg that mirrors them."""
from math import cos, pi, sin

from .bunny import bunny
from .mesh import Mesh
from .scene import Scene, instance
from .solids import ball, cap, finished, lathe

EGG = [(0.32, 0.03, 0), (0.54, 0.36, 0), (0.53, 0.74, 0), (0.39, 1.1, 0), (0.18, 1.32, 0)]
NEST = [(0.75, -0.05), (1.1, 0.12), (1.16, 0.42), (0.92, 0.5), (0.7, 0.22)]
CELLS, CELL = 14, 3.5  # of the ground
SHELLS = ("rose", "sky", "lemon", "mint", "lilac")
# x, z, scale, heading in degrees from +z to +x, fur.
BUNNIES = [
    (-3.3, 2.0, 1.0, 105, "brown"), (3.5, 1.3, 0.95, -60, "white"), (-1.5, 4.7, 0.6, 165, "grey"),
    (1.9, 4.9, 0.5, -35, "brown"), (-5.9, -1.6, 1.05, 55, "white"), (6.0, -1.6, 1.0, -35, "grey"),
    (-3.2, -4.4, 1.0, 20, "grey"), (3.0, -4.6, 1.05, -15, "brown"), (0.2, -7.6, 1.1, 0, "white"),
    (5.5, 2.9, 0.6, -100, "white"), (-4.9, 3.5, 0.55, 40, "brown"), (-8.6, -6.2, 1.0, 35, "brown"),
]
NESTS = [(-3.2, 6.6, 10), (3.9, 4.7, 100), (8.4, 0.9, 200), (-7.9, 1.4, 300)]  # x, z, heading
SINGLE_EGGS = 30


def height(x, z):
    return 0.05 - 0.006 * (x * x + z * z) + 0.25 * sin(0.35 * x + 1) * cos(0.3 * z)


def ground(scheme):
    mesh = Mesh(scheme, "A grassy hill, a grid with a boundary.")
    half = CELLS * CELL / 2
    rows = []
    for j in range(CELLS + 1):
        z = half - j * CELL
        rows.append([mesh.point(i * CELL - half, height(i * CELL - half, z), z) for i in range(CELLS + 1)])
    for front, back in zip(rows, rows[1:]):
        for i in range(CELLS):
            mesh.face(front[i], front[i + 1], back[i + 1], back[i])
    return finished(mesh)


def egg(scheme):
    mesh = Mesh(scheme, "An egg, closed, its blunt end down.")
    rings = lathe(mesh, EGG, 8)
    cap(mesh, rings[0][::-1], -0.1)
    cap(mesh, rings[-1], 1.4)
    return finished(mesh)


def nest(scheme):
    """Its straw goes up and down from one column to the next."""
    mesh = Mesh(scheme, "A nest of straw, open below.")
    rings = []
    for level, (radius, y) in enumerate(NEST):
        def place(angle, level=level, radius=radius, y=y):
            sway = 1 if (round(angle * 6 / pi) + level) % 2 else -1
            r = radius + 0.07 * sway
            return r * cos(angle), y + 0.08 * sway, -r * sin(angle)

        rings.append(mesh.ring(12, place))
    for lower, upper in zip(rings, rings[1:]):
        mesh.band(lower, upper)
    cap(mesh, rings[-1], 0.16)
    return finished(mesh)


def objects(meadow):
    scheme = meadow.scheme
    meadow.model("ground", ground(scheme))
    meadow.model("rabbit", bunny(scheme))
    meadow.model("ball", ball(scheme, "A ball: an eye, or a rabbit's tail."))
    meadow.model("egg", egg(scheme))
    meadow.model("nest", nest(scheme))
    parts = [instance("rabbit"), instance("ball", "white", scale=0.24, translate=(0, 0.5, -0.98))]
    for side in (1, -1):
        parts.append(instance("ball", "black", scale=0.08, translate=(0.325 * side, 1.66, 1.02)))
    meadow.group("bunny", *parts)
    clutch = [instance("nest", "straw")]
    for i, shell in enumerate(SHELLS):
        angle = 2 * pi * i / 5
        axis = (sin(angle), 0, cos(angle), -24)  # leans outwards
        place = (0.46 * cos(angle), 0.24, -0.46 * sin(angle))
        clutch.append(instance("egg", shell, scale=0.62, rotate=axis, translate=place))
    meadow.group("clutch", *clutch)


class Scatter:
    """Places that keep clear of each other, from a small generator of numbers that is the same everywhere."""

    def __init__(self):
        self.state = 2003
        self.taken = []

    def number(self, low, high):
        self.state = (self.state * 1103515245 + 12345) % 2**31
        return low + (high - low) * (self.state >> 8) / 2**23

    def place(self, radius):
        while True:
            x, z = self.number(-9, 9), self.number(-7, 8.5)
            if all((x - a) ** 2 + (z - b) ** 2 > (radius + r) ** 2 for a, b, r in self.taken):
                self.taken.append((x, z, radius))
                return x, z


def show_single_eggs(meadow):
    scatter = Scatter()
    scatter.taken = [(0, 0, 2.2)] + [(x, z, 1.3 * scale) for x, z, scale, *_ in BUNNIES]
    scatter.taken += [(x, z, 1.3) for x, z, _ in NESTS]
    for i in range(SINGLE_EGGS):
        size = scatter.number(0.5, 0.9)
        x, z = scatter.place(0.75 * size)
        turn, lies = scatter.number(0, 360), i % 3 == 0
        axis = (cos(turn), 0, sin(turn), 96) if lies else (cos(turn), 0, sin(turn), 6)
        place = (x, height(x, z) + (0.46 * size if lies else -0.03), z)
        meadow.show("egg", SHELLS[i % len(SHELLS)], scale=size, rotate=axis, translate=place)


def scene(scheme):
    meadow = Scene("eggs-n-bunnies", scheme)
    objects(meadow)
    meadow.material("grass", (0.12, 0.24, 0.05))
    meadow.material("straw", (0.42, 0.3, 0.1))
    meadow.material("brown", (0.27, 0.14, 0.06))
    meadow.material("grey", (0.22, 0.21, 0.21))
    meadow.material("white", (0.62, 0.6, 0.57))
    meadow.material("black", (0.01, 0.01, 0.01), 0.25)
    meadow.material("gold", (0.5, 0.32, 0.06), 0.5)
    meadow.material("rose", (0.6, 0.16, 0.22), 0.06)
    meadow.material("sky", (0.12, 0.3, 0.6), 0.06)
    meadow.material("lemon", (0.62, 0.5, 0.08), 0.06)
    meadow.material("mint", (0.15, 0.48, 0.3), 0.06)
    meadow.material("lilac", (0.36, 0.2, 0.52), 0.06)

    meadow.show("ground", "grass")
    meadow.show("egg", "gold", scale=3.2, translate=(0, height(0, 0) - 0.1, 0))
    for x, z, scale, heading, fur in BUNNIES:
        meadow.show("bunny", fur, scale=scale, rotate=(0, 1, 0, heading), translate=(x, height(x, z) - 0.03, z))
    for x, z, heading in NESTS:
        meadow.show("clutch", scale=0.9, rotate=(0, 1, 0, heading), translate=(x, height(x, z) - 0.02, z))
    show_single_eggs(meadow)
    meadow.camera((2.2, 5.8, 17.5), (0.1, 1.0, 0.6), 44)
    meadow.light((-40, 60, 45), (1.05, 1.0, 0.88))
    meadow.background((0.3, 0.45, 0.68))
    return meadow
