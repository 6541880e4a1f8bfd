"""A whale, swimming along -x."""
from math import cos, sin

from .mesh import Mesh

SIDES = 12
# x, height of the spine, half height, half width of each cross-section.
STATIONS = [
    (-2.05, -0.06, 0.34, 0.36), (-1.8, -0.02, 0.56, 0.58), (-1.35, 0.02, 0.74, 0.72), (-0.8, 0.04, 0.8, 0.78),
    (-0.2, 0.04, 0.76, 0.74), (0.4, 0.06, 0.64, 0.62), (0.95, 0.12, 0.48, 0.46), (1.45, 0.24, 0.33, 0.31),
    (1.85, 0.4, 0.21, 0.21), (2.15, 0.55, 0.13, 0.17), (2.4, 0.66, 0.08, 0.13),
]


def body(mesh):
    """Rings from nose to tail, point 0 on the +z side, then downwards; returns them and each band's first face."""
    nose = mesh.point(-2.2, -0.08, 0)
    rings = [
        mesh.ring(SIDES, lambda a, s=s: (s[0], s[1] - s[2] * sin(a), s[3] * cos(a))) for s in STATIONS
    ]
    tail = mesh.point(2.5, 0.7, 0)
    for i in range(SIDES):
        mesh.face(nose, rings[0][(i + 1) % SIDES], rings[0][i])
        mesh.face(rings[-1][i], rings[-1][(i + 1) % SIDES], tail)
    bands = []
    for front, back in zip(rings, rings[1:]):
        bands.append(len(mesh.faces))
        for i in range(SIDES):
            j = (i + 1) % SIDES
            mesh.face(front[i], front[j], back[j], back[i])
    return rings, bands


def fin(mesh, face, steps, side, sharpness):
    """Pulls a face out in steps of (offset, scale), mirrored in z for side -1; its leading edge and rim are creases."""
    leading = [mesh.faces[face][0]]
    for (x, y, z), scale in steps:
        tip = mesh.extrude(face, (x, y, z * side), scale)
        leading.append(tip[0])
    mesh.crease(leading, sharpness)
    mesh.crease(tip, sharpness, closed=True)


def whale():
    mesh = Mesh("loop", "A whale of triangles, closed; the fins' edges and the mouth are semi-sharp creases.")
    rings, bands = body(mesh)

    for side in (1, -1):
        # The bands' faces start at +z and go down: face 0 is just below +z, face SIDES/2 - 1 just below -z.
        flipper = bands[2] + (1 if side == 1 else SIDES // 2 - 2)
        steps = [((0.12, -0.12, 0.3), 0.75), ((0.3, -0.16, 0.45), 0.8), ((0.3, -0.06, 0.35), 0.55)]
        fin(mesh, flipper, steps, side, 1.5)
        fluke = bands[9] + (0 if side == 1 else SIDES // 2 - 1)
        steps = [((0.08, 0.07, 0.22), 1.5), ((0.22, 0.1, 0.38), 1.2), ((0.3, 0.06, 0.36), 0.6)]
        fin(mesh, fluke, steps, side, 2)

    back = bands[5] + 3 * SIDES // 4
    fin(mesh, back, [((0.12, 0.14, 0), 0.6), ((0.22, 0.16, 0), 0.4)], 1, 1.5)
    mouth = [rings[2][SIDES // 2 - 1], rings[1][SIDES // 2 - 1], rings[0][SIDES // 2 - 1]]
    mouth += [rings[0][i] for i in range(SIDES // 2 - 2, 0, -1)] + [rings[1][1], rings[2][1]]
    mesh.crease(mouth, 2)
    mesh.triangulate()
    return mesh
