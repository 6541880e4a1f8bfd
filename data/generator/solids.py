"""Shapes that several scenes share."""
from math import sqrt

from .basic import CUBE_FACES, CUBE_POINTS
from .mesh import Mesh, circle

ICOSAHEDRON_FACES = [
    (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
    (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
    (9, 8, 1),
]


def ball(scheme, comment):
    """About a unit sphere: the control points lie outside, as far as the limit draws them in."""
    mesh = Mesh(scheme, comment)
    if scheme == "loop":
        g = (1 + sqrt(5)) / 2
        points = [
            (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1),
            (g, 0, 1), (-g, 0, -1), (-g, 0, 1),
        ]
        size, faces = 0.75, ICOSAHEDRON_FACES
    else:
        points, size, faces = CUBE_POINTS, 1.173, CUBE_FACES
    for p in points:
        mesh.point(*(size * x for x in p))
    for f in faces:
        mesh.face(*f)
    return mesh


def block(scheme, comment, sharpness):
    """A cube from -1 to 1 whose edges are rounded a little."""
    mesh = Mesh(scheme, comment)
    for p in CUBE_POINTS:
        mesh.point(*p)
    for f in CUBE_FACES:
        mesh.face(*f)
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)):
        mesh.crease([a, b], sharpness)
    return finished(mesh)


def lathe(mesh, profile, sides):
    """A surface of revolution around y from (radius, height, sharpness) upwards; returns its rings."""
    rings = []
    for radius, height, sharpness in profile:
        rings.append(mesh.ring(sides, circle(radius, height)))
        if sharpness:
            mesh.crease(rings[-1], sharpness, closed=True)
    for lower, upper in zip(rings, rings[1:]):
        mesh.band(lower, upper)
    return rings


def cap(mesh, ring, height):
    """Closes a ring, counter-clockwise seen from outside, around a point on the axis y."""
    centre = mesh.point(0, height, 0)
    if mesh.scheme == "loop":
        for i in range(len(ring)):
            mesh.face(ring[i], ring[(i + 1) % len(ring)], centre)
    else:
        mesh.quad_cap(ring, centre)


def finished(mesh):
    """The mesh, of triangles where its scheme wants them."""
    if mesh.scheme == "loop":
        mesh.triangulate()
    return mesh
