"""The scene Frogship: a spaceship in the shape of a leaping frog, flying along +z."""
from math import cos, pi, sin

from .mesh import Mesh
from .scene import Scene, instance
from .solids import ball

# z, top, shoulder (x, y), side (x, y), chine (x, y), bottom of each cross-section of the right half, from nose to tail.
STATIONS = [
    (1.95, 0.22, (0.46, 0.20), (0.86, 0.00), (0.52, -0.16), -0.18),
    (1.40, 0.36, (0.52, 0.36), (1.22, 0.02), (0.78, -0.30), -0.36),
    (0.60, 0.46, (0.44, 0.60), (1.14, 0.10), (0.74, -0.40), -0.50),
    (-0.20, 0.74, (0.54, 0.60), (0.90, 0.14), (0.58, -0.36), -0.46),
    (-1.05, 0.70, (0.46, 0.54), (0.70, 0.16), (0.40, -0.20), -0.28),
    (-1.80, 0.46, (0.22, 0.38), (0.32, 0.18), (0.18, 0.02), -0.02),
]
FOOT = (1.66, 0.36, -1.95)  # centre of the right one


def hull_half():
    """The right half's rings (top, shoulder, side, chine, bottom) and faces[band][column]."""
    mesh = Mesh("", "")
    rings = [
        [mesh.point(*p, z) for p in ((0, top), shoulder, side, chine, (0, bottom))]
        for z, top, shoulder, side, chine, bottom in STATIONS
    ]
    faces = [
        [mesh.face(a[c], a[c + 1], b[c + 1], b[c]) for c in range(4)] for a, b in zip(rings, rings[1:])
    ]
    nose, tail = mesh.point(0, 0.02, 2.12), mesh.point(0, 0.22, -1.95)
    top, shoulder, side, chine, bottom = rings[0]
    mesh.face(nose, side, shoulder, top)
    mesh.face(nose, bottom, chine, side)
    top, shoulder, side, chine, bottom = rings[-1]
    mesh.face(tail, top, shoulder, side)
    mesh.face(tail, side, chine, bottom)
    return mesh, rings, faces, nose


def across(mesh, corners, centre, half):
    """Turns the end of a limb to face backwards, as a square."""
    x, y, z = centre
    for v, (right, up) in zip(corners, ((1, 1), (1, -1), (-1, -1), (-1, 1))):
        mesh.points[v] = (x + half * right, y + half * up, z)


def hull(scheme):
    mesh, rings, faces, nose = hull_half()
    mesh.scheme = scheme
    mesh.comment = "A frog's body as a hull, closed; sharp and semi-sharp creases edge its panels and limbs."

    socket = mesh.extrude(faces[1][1], (0.03, 0.26, 0.04), 1.12)
    mesh.crease(socket, 4, closed=True)

    # Forelegs: fins that sweep forward and down, with webbed toes.
    fin = faces[2][2]
    mesh.extrude(fin, (0.36, -0.14, 0.16), (0.7, 0.7, 0.55))
    web = mesh.extrude(fin, (0.46, -0.34, 0.42), (2.2, 0.5, 1.9))
    if scheme == "loop":
        mesh.fan(fin, (0.16, -0.10, 0.34))
    mesh.crease(web, 3, closed=True)

    # Hind legs: a thigh, a shank, and a foot that holds the engine.
    leg = faces[3][1]
    mesh.extrude(leg, (0.60, 0.16, 0.10), (0.9, 1.1, 1.0))
    across(mesh, mesh.extrude(leg, (0, 0, 0)), (1.72, 0.46, -1.2), 0.26)
    foot = mesh.extrude(leg, (0, 0, 0))
    across(mesh, foot, FOOT, 0.3)
    mesh.crease(foot, 10, closed=True)

    mesh.crease([nose] + [r[2] for r in rings[:3]], 10)  # the mouth
    mesh.crease([r[0] for r in rings[2:]], 2)  # the spine
    mesh.crease([r[3] for r in rings], 3)  # the chine
    mesh.mirror()
    if scheme == "loop":
        mesh.triangulate()
    return mesh


# Radius and distance along the axis.
NOZZLE = [(0.2, -0.15), (0.42, 0.36), (0.16, -0.1)]


def nozzle(scheme):
    mesh = Mesh(scheme, "An engine's nozzle along -z: a ring of four sides with two boundaries and a sharp lip.")
    rings = [
        mesh.ring(4, lambda a, r=r, z=z: (r * cos(a + pi / 4), -r * sin(a + pi / 4), -z)) for r, z in NOZZLE
    ]
    for inner, outer in zip(rings, rings[1:]):
        mesh.band(inner, outer)
    mesh.crease(rings[1], 10, closed=True)
    if scheme == "loop":
        mesh.triangulate()
    return mesh


def scene(scheme):
    frogship = Scene("frogship", scheme)
    frogship.model("hull", hull(scheme))
    frogship.model("eye", ball(scheme, "An eye, and the window of a cockpit: a ball."))
    frogship.model("nozzle", nozzle(scheme))
    frogship.material("skin", (0.08, 0.27, 0.05), 0.06)
    frogship.material("glass", (0.6, 0.3, 0.03), 0.35)
    frogship.material("steel", (0.35, 0.36, 0.4), 0.4)
    parts = [instance("hull", "skin")]
    for side in (1, -1):
        parts.append(instance("eye", "glass", scale=0.32, translate=(0.87 * side, 0.59, 1.03)))
        parts.append(instance("nozzle", "steel", translate=(FOOT[0] * side, *FOOT[1:])))
    frogship.group("ship", *parts)
    frogship.show("ship", rotate=(0, 0, 1, -9))
    frogship.camera((3.4, 2.1, 6.2), (0.12, 0.05, 0), 37)
    frogship.light((20, 40, 30), (1, 0.97, 0.9))
    frogship.background((0.03, 0.04, 0.09))
    return frogship
