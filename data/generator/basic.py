"""Small models, each for one thing that a subdivision surface can do."""
from math import cos, pi, sin, sqrt

from .mesh import INFINITE, Mesh, circle

CUBE_POINTS = [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]
CUBE_FACES = [(0, 1, 2, 3), (5, 4, 7, 6), (3, 2, 6, 7), (1, 0, 4, 5), (1, 5, 6, 2), (4, 0, 3, 7)]


def cube(comment):
    mesh = Mesh("catmark", comment)
    for p in CUBE_POINTS:
        mesh.point(*p)
    for f in CUBE_FACES:
        mesh.face(*f)
    return mesh


def cube_creases():
    mesh = cube("A cube: top outline infinitely sharp, three bottom edges semi-sharp, a sharp and a semi-sharp corner.")
    mesh.crease([3, 2, 6, 7], INFINITE, closed=True)
    mesh.crease([0, 1], 1.5)
    mesh.crease([1, 5], 2.25)
    mesh.crease([5, 4], 3)
    mesh.corner(4, INFINITE)
    mesh.corner(0, 1.25)
    return mesh


def hole():
    mesh = cube("A cube whose top face is a hole: it shapes its neighbours and has no surface itself.")
    mesh.tag("hole 1/0/0 2")
    return mesh


def tetrahedron():
    mesh = Mesh("loop", "A regular tetrahedron: every vertex has valence 3, no edge is regular.")
    for p in [(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)]:
        mesh.point(*p)
    for f in [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]:
        mesh.face(*f)
    return mesh


def torus_points(mesh, around, across, major, minor):
    """Rings of points across the tube; index [i][j]: i around the axis, j around the tube."""
    rings = []
    for i in range(around):
        a = 2 * pi * i / around

        def place(b, a=a):
            distance = major + minor * cos(b)
            return distance * cos(a), minor * sin(b), -distance * sin(a)

        rings.append(mesh.ring(across, place))
    return rings


def torus():
    mesh = Mesh("catmark", "A torus of quads: regular everywhere, no boundary, no crease.")
    rings = torus_points(mesh, 12, 8, 1, 0.4)
    for i in range(12):
        for j in range(8):
            k, m = (i + 1) % 12, (j + 1) % 8
            mesh.face(rings[i][j], rings[k][j], rings[k][m], rings[i][m])
    return mesh


def loop_torus():
    mesh = Mesh("loop", "A torus of triangles, valence 6 everywhere, with infinitely sharp and semi-sharp creases.")
    rings = torus_points(mesh, 12, 8, 1, 0.4)
    for i in range(12):
        for j in range(8):
            k, m = (i + 1) % 12, (j + 1) % 8
            mesh.face(rings[i][j], rings[k][j], rings[k][m])
            mesh.face(rings[i][j], rings[k][m], rings[i][m])
    mesh.crease([r[0] for r in rings], INFINITE, closed=True)
    mesh.crease(rings[2], 2.5, closed=True)
    mesh.crease(rings[7][2:6], INFINITE)
    mesh.crease([r[4] for r in rings[3:9]], 1.2)
    return mesh


def dart():
    mesh = Mesh("catmark", "A hilly grid with a boundary; one sharp and one semi-sharp crease end inside it as darts.")
    n = 7
    rows = []
    for z in range(n):
        hills = [0.8 * sin(0.9 * x) * cos(0.7 * z) + 0.15 * (x - 3) for x in range(n)]
        rows.append([mesh.point(x - 3, hills[x], 3 - z) for x in range(n)])
    for z in range(n - 1):
        for x in range(n - 1):
            mesh.face(rows[z][x], rows[z][x + 1], rows[z + 1][x + 1], rows[z + 1][x])
    mesh.crease([rows[z][2] for z in range(0, 4)], INFINITE)
    mesh.crease(rows[4][2:6], 2.5)
    return mesh


def saddle():
    mesh = Mesh("loop", "A saddle of triangles with a boundary: boundary edges are sharp, its corners are rounded.")
    n = 5
    rows = []
    for j in range(n):
        y = 1 - j / 2
        rows.append([mesh.point(i / 2 - 1, (i / 2 - 1) ** 2 - y * y, y) for i in range(n)])
    for j in range(n - 1):
        for i in range(n - 1):
            a, b, c, d = rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]
            if (i + j) % 2 == 0:
                mesh.face(a, b, c)
                mesh.face(a, c, d)
            else:
                mesh.face(a, b, d)
                mesh.face(b, c, d)
    mesh.tag("interpolateboundary 1/0/0 2")
    return mesh


def sail():
    mesh = Mesh("catmark", "A sail of quads: its boundary is one smooth curve, corners too; a seam ends at one of them.")
    rows = []
    for j in range(4):
        rows.append([mesh.point(i, j, (i - 1.5) ** 2 / 4 - (j - 1) ** 2 / 8) for i in range(4)])
    for j in range(3):
        for i in range(3):
            mesh.face(rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i])
    top = [mesh.point(3 + i, 4 - i, 1) for i in range(2)]  # the last corner has three faces
    mesh.face(rows[3][2], rows[3][3], top[0], mesh.point(2, 4, 0.5))
    mesh.face(rows[3][3], rows[2][3], top[1], top[0])
    mesh.tag("interpolateboundary 1/0/0 2")
    return mesh


def pole():
    mesh = Mesh("catmark", "A lantern whose two poles have valence 32.")
    bottom = mesh.point(0, -1, 0)
    rings = [mesh.ring(64, circle(r, y)) for r, y in [(0.5, -0.9), (0.9, -0.45), (0.8, 0.2), (0.4, 0.6)]]
    top = mesh.point(0, 1, 0)
    mesh.quad_cap(rings[0][::-1], bottom)
    for lower, upper in zip(rings, rings[1:]):
        mesh.band(lower, upper)
    mesh.quad_cap(rings[-1], top)
    return mesh


def icosahedron():
    g = (1 + sqrt(5)) / 2
    points = [(s * a, t * b, 0) for a, b in [(1, g)] for s in (-1, 1) for t in (-1, 1)]
    points = points + [(z, x, y) for x, y, z in points] + [(y, z, x) for x, y, z in points]

    def near(i, j):
        return sum((p - q) ** 2 for p, q in zip(points[i], points[j])) < 4.5

    faces = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if near(i, j) and near(j, k) and near(i, k):
                    a, b, c = points[i], points[j], points[k]
                    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                    outward = sum(x * y for x, y in zip(n, a)) > 0
                    faces.append((i, j, k) if outward else (i, k, j))
    return points, faces


# How some of the football's hexagons are cut.
HEXAGON_PIECES = {
    0: [(0, 1, 2, 3), (0, 3, 4, 5)],
    1: [(0, 1, 2), (0, 2, 3, 4), (0, 4, 5)],
    2: [(0, 2, 4), (0, 1, 2), (2, 3, 4), (4, 5, 0)],
}


def ngon_body():
    mesh = Mesh("catmark", "A football, flattened, of pentagons, hexagons, quads and triangles; some edges semi-sharp.")
    points, faces = icosahedron()
    cut = {}  # (a, b): the point a third of the way from a to b
    after = {}  # (vertex, neighbour): the next neighbour around the vertex, clockwise seen from outside
    for a, b, c in faces:
        for i, j, k in ((a, b, c), (b, c, a), (c, a, b)):
            cut[i, j] = mesh.point(*(s * (2 * p + q) / 3 for s, p, q in zip((1, 0.7, 0.85), points[i], points[j])))
            after[i, k] = j
    for number, (a, b, c) in enumerate(faces):
        h = [cut[a, b], cut[b, a], cut[b, c], cut[c, b], cut[c, a], cut[a, c]]
        for piece in HEXAGON_PIECES.get(number % 5, [range(6)]):
            mesh.face(*(h[i] for i in piece))
    for v in range(12):
        first = next(k for i, k in after if i == v)
        neighbours = [first]
        while after[v, neighbours[-1]] != first:
            neighbours.append(after[v, neighbours[-1]])
        pentagon = [cut[v, k] for k in reversed(neighbours)]
        mesh.face(*pentagon)
        if v % 4 == 0:
            mesh.crease(pentagon, 2, closed=True)
    return mesh
