"""A chess rook."""
from .mesh import Mesh, circle

COLUMNS = 24  # six merlons of three columns and a gap of one
# Radius, height, sharpness of the ring.
PROFILE = [
    (1.0, 0.0, 3), (1.0, 0.2, 2), (0.88, 0.3, 0), (0.84, 0.42, 2.5), (0.6, 0.56, 0), (0.5, 0.95, 0), (0.46, 1.4, 0),
    (0.5, 1.72, 2), (0.62, 1.76, 2), (0.62, 1.86, 2), (0.56, 1.9, 1), (0.7, 2.02, 2.5), (0.72, 2.2, 0),
]
WALL_TOP = 2.52
INNER_RADIUS = 0.54
WELL_FLOOR = 2.06


def merlon(mesh, outer, inner, columns):
    """Raises the wall over the edges between consecutive columns."""
    low_out, low_in = [outer[c] for c in columns], [inner[c] for c in columns]
    high_out = [mesh.point(mesh.points[v][0], WALL_TOP, mesh.points[v][2]) for v in low_out]
    high_in = [mesh.point(mesh.points[v][0], WALL_TOP, mesh.points[v][2]) for v in low_in]
    for i in range(len(columns) - 1):
        mesh.face(low_out[i], low_out[i + 1], high_out[i + 1], high_out[i])
        mesh.face(high_out[i], high_out[i + 1], high_in[i + 1], high_in[i])
        mesh.face(low_in[i + 1], low_in[i], high_in[i], high_in[i + 1])
    mesh.face(low_in[0], low_out[0], high_out[0], high_in[0])
    mesh.face(low_out[-1], low_in[-1], high_in[-1], high_out[-1])
    mesh.crease(high_out + high_in[::-1], 2.5, closed=True)
    for end in (0, -1):
        mesh.crease([high_out[end], low_out[end], low_in[end], high_in[end]], 2.5)


def rook():
    mesh = Mesh("catmark", "A chess rook: quads only, closed, its rims and merlons with semi-sharp creases.")
    foot = mesh.point(0, 0, 0)
    rings = []
    for radius, height, sharpness in PROFILE:
        rings.append(mesh.ring(COLUMNS, circle(radius, height)))
        if sharpness:
            mesh.crease(rings[-1], sharpness, closed=True)
    mesh.quad_cap(rings[0][::-1], foot)
    for lower, upper in zip(rings, rings[1:]):
        mesh.band(lower, upper)

    outer = rings[-1]
    inner = mesh.ring(COLUMNS, circle(INNER_RADIUS, PROFILE[-1][1]))
    floor = mesh.ring(COLUMNS, circle(INNER_RADIUS, WELL_FLOOR))
    mesh.band(inner, floor)
    mesh.crease(floor, 2, closed=True)
    mesh.quad_cap(floor, mesh.point(0, WELL_FLOOR, 0))
    for first in range(0, COLUMNS, 4):
        merlon(mesh, outer, inner, range(first, first + 4))
        c, d = first + 3, (first + 4) % COLUMNS
        mesh.face(outer[c], outer[d], inner[d], inner[c])
        mesh.crease([outer[c], outer[d]], 2.5)
        mesh.crease([inner[c], inner[d]], 2.5)
    return mesh
