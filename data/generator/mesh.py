"""A polygon mesh with tags that writes itself as OBJ, and the few modelling steps that the models share."""
from math import cos, pi, sin

INFINITE = 10  # sharpness from here on is infinite


class Mesh:
    def __init__(self, scheme, comment):
        self.scheme = scheme
        self.comment = comment
        self.points = []
        self.faces = []  # lists of point indices, counted from 0, counter-clockwise seen from outside
        self.tags = []  # texts, or (a, b, sharpness) for a crease

    def point(self, x, y, z):
        self.points.append((x, y, z))
        return len(self.points) - 1

    def face(self, *corners):
        self.faces.append(list(corners))
        return len(self.faces) - 1

    def ring(self, count, place):
        """`count` points place(angle) around a full turn; returns their indices."""
        return [self.point(*place(2 * pi * i / count)) for i in range(count)]

    def band(self, lower, upper):
        """Quads between two rings of equal length; outside is on the right when walking along the lower one upwards."""
        count = len(lower)
        for i in range(count):
            j = (i + 1) % count
            self.face(lower[i], lower[j], upper[j], upper[i])

    def quad_cap(self, ring, centre):
        """Closes an even ring by quads around a centre point, each with two of the ring's edges."""
        count = len(ring)
        for i in range(0, count, 2):
            self.face(ring[i], ring[i + 1], ring[(i + 2) % count], centre)

    def extrude(self, face, offset, scale=1.0):
        """Pulls a face out by `offset`, scaled about its own centre, along each axis if `scale` is a triple;
        returns its new corners. It keeps its index.
        """
        scales = scale if isinstance(scale, tuple) else (scale,) * 3
        old = self.faces[face]
        centre = [sum(self.points[v][axis] for v in old) / len(old) for axis in range(3)]
        new = [
            self.point(*(c + o + s * (p - c) for c, o, s, p in zip(centre, offset, scales, self.points[v])))
            for v in old
        ]
        self.faces[face] = new
        for i in range(len(old)):
            j = (i + 1) % len(old)
            self.face(old[i], old[j], new[j], new[i])
        return new

    def fan(self, face, offset):
        """Replaces a face by triangles around its centre, moved by `offset`; returns the centre."""
        old = self.faces[face]
        centre = [sum(self.points[v][axis] for v in old) / len(old) for axis in range(3)]
        tip = self.point(*(c + o for c, o in zip(centre, offset)))
        self.faces[face] = [old[0], old[1], tip]
        for i in range(1, len(old)):
            self.face(old[i], old[(i + 1) % len(old)], tip)
        return tip

    def mirror(self):
        """Adds the mirror image in the plane x = 0, which keeps its own points, of the mesh and its creases."""
        image = [v if abs(p[0]) < 1e-9 else self.point(-p[0], *p[1:]) for v, p in enumerate(self.points[:])]
        self.faces += [[image[v] for v in reversed(f)] for f in self.faces]
        creases = [(image[a], image[b], sharpness) for a, b, sharpness in self.tags]
        self.tags += [c for c, old in zip(creases, self.tags) if c != old]

    def triangulate(self):
        """Splits every quad along its shorter diagonal."""
        faces, self.faces = self.faces, []
        for f in faces:
            if len(f) == 3:
                self.faces.append(f)
                continue
            a, b, c, d = f
            if self.squared_distance(a, c) <= self.squared_distance(b, d):
                self.faces += [[a, b, c], [a, c, d]]
            else:
                self.faces += [[a, b, d], [b, c, d]]

    def squared_distance(self, a, b):
        # Rounded, so that the diagonal chosen for a symmetric quad is the same with every mathematics library.
        return round(sum((p - q) ** 2 for p, q in zip(self.points[a], self.points[b])), 9)

    def crease(self, path, sharpness, closed=False):
        """Tags the edges along a path of points."""
        ends = path[1:] + path[:1] if closed else path[1:]
        for a, b in zip(path, ends):
            self.tags.append((a, b, sharpness))

    def corner(self, vertex, sharpness):
        self.tags.append(f"corner 1/1/0 {vertex} {sharpness}")

    def tag(self, text):
        self.tags.append(text)

    def text(self):
        lines = [f"# {self.comment}"]
        lines += ["v " + " ".join(number(x) for x in p) for p in self.points]
        lines += ["f " + " ".join(str(v + 1) for v in f) for f in self.faces]
        lines += [f"t scheme 0/0/1 {self.scheme}"]
        lines += [f"t {tag}" if isinstance(tag, str) else "t crease 2/1/0 {} {} {}".format(*tag) for tag in self.tags]
        return "\n".join(lines) + "\n"


def number(x):
    """Six decimals at most: sin and cos of different mathematics libraries then give the same bytes."""
    text = f"{x:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def circle(radius, y):
    """A horizontal circle for Mesh.ring, counter-clockwise seen from above."""
    return lambda angle: (radius * cos(angle), y, -radius * sin(angle))
