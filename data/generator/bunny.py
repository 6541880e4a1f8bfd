"""A sitting rabbit, facing +z, its feet at y = 0."""
from math import cos, pi, sin

from .mesh import Mesh
from .solids import finished

POINTS = 6  # of a half ring, from top to bottom
# Height and z of the centre, direction in degrees above +z, half height, half width; from rump to nose.
SPINE = [
    (0.46, -0.98, 10, 0.26, 0.28), (0.55, -0.78, 14, 0.52, 0.54), (0.66, -0.38, 18, 0.68, 0.64),
    (0.76, 0.06, 26, 0.66, 0.60), (0.90, 0.40, 44, 0.56, 0.48), (1.14, 0.60, 58, 0.42, 0.39),
    (1.36, 0.66, 48, 0.40, 0.37), (1.54, 0.72, 18, 0.42, 0.40), (1.58, 0.98, -8, 0.43, 0.45),
    (1.49, 1.26, -16, 0.31, 0.32), (1.44, 1.45, -16, 0.16, 0.16),
]
# Centre, half extents in x and z of the sections of the limbs on the right, from the body outwards.
EAR = [
    ((0.19, 2.04, 0.62), 0.11, 0.09), ((0.26, 2.32, 0.52), 0.19, 0.08), ((0.32, 2.64, 0.40), 0.22, 0.06),
    ((0.35, 2.90, 0.28), 0.17, 0.05), ((0.35, 3.08, 0.20), 0.07, 0.03),
]
FORELEG = [((0.22, 0.48, 0.66), 0.13, 0.13), ((0.21, 0.14, 0.70), 0.12, 0.13), ((0.21, 0.0, 0.80), 0.14, 0.26)]
HIND_LEG = [
    ((0.56, 0.44, -0.12), 0.22, 0.42), ((0.48, 0.12, -0.24), 0.15, 0.34), ((0.48, 0.0, -0.02), 0.18, 0.58),
]


def half_ring(mesh, y, z, slope, height, width):
    c, s = cos(slope * pi / 180), sin(slope * pi / 180)
    ring = []
    for i in range(POINTS):
        angle = pi * i / (POINTS - 1)
        up = height * cos(angle)
        across = width * sin(angle) if i < POINTS - 1 else 0
        ring.append(mesh.point(across, y + up * c, z - up * s))
    return ring


def half_cap(mesh, ring, forward):
    top, a, b, c, d, bottom = ring
    for corners in ((bottom, d, a, top), (d, c, b, a)):
        mesh.face(*(corners if forward else corners[::-1]))


def limb(mesh, face, sections, order):
    """Pulls a face out through sections; `order` says for each corner on which side in x and z it comes to lie."""
    for (x, y, z), across, along in sections:
        corners = mesh.extrude(face, (0, 0, 0))
        for v, (side, front) in zip(corners, order):
            mesh.points[v] = (x + side * across, y, z + front * along)
    return corners


def bunny(scheme):
    mesh = Mesh(scheme, "A sitting rabbit, closed; its soles have semi-sharp creases.")
    rings = [half_ring(mesh, *station) for station in SPINE]
    faces = [
        [mesh.face(front[i], front[i + 1], rear[i + 1], rear[i]) for i in range(POINTS - 1)]
        for rear, front in zip(rings, rings[1:])
    ]
    half_cap(mesh, rings[0], False)
    half_cap(mesh, rings[-1], True)

    # Corners of these faces: front above, front below, rear below, rear above.
    limb(mesh, faces[7][1], EAR, [(-1, 1), (1, 1), (1, -1), (-1, -1)])
    downwards = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    for face, sections in ((faces[4][3], FORELEG), (faces[2][3], HIND_LEG)):
        mesh.crease(limb(mesh, face, sections, downwards), 2, closed=True)
    for i in (2, 3):  # the haunch
        x, y, z = mesh.points[rings[2][i]]
        mesh.points[rings[2][i]] = (x + 0.1, y + 0.06, z)
    mesh.mirror()
    return finished(mesh)
