"""Triangle meshes, and the shapes that scenes are put together from.

Metres, +y up, counter-clockwise from outside. A mesh without indices in the file is made by
`Mesh.unindexed`; every other one shares its vertices.
"""

import math


class Mesh:
    """Vertices in lists of equal length, and triangles as indices into them."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        length = math.sqrt(sum(n * n for n in normal))
        self.positions.append(tuple(position))
        self.normals.append(tuple(n / length for n in normal))
        self.uvs.append(tuple(uv))
        return len(self.positions) - 1

    def quad(self, a, b, c, d):
        self.indices += [a, b, c, a, c, d]

    def add(self, other):
        first = len(self.positions)
        self.positions += other.positions
        self.normals += other.normals
        self.uvs += other.uvs
        self.indices += [first + i for i in other.indices]
        return self

    def moved(self, x, y, z):
        mesh = self.copy()
        mesh.positions = [(px + x, py + y, pz + z) for px, py, pz in self.positions]
        return mesh

    def mapped(self, turn):
        """`turn` is a rotation of a 3-tuple: applied to positions and normals."""
        mesh = self.copy()
        mesh.positions = [turn(p) for p in self.positions]
        mesh.normals = [turn(n) for n in self.normals]
        return mesh

    def copy(self):
        mesh = Mesh()
        return mesh.add(self)

    def unindexed(self):
        """The same triangles, each with three vertices of its own."""
        mesh = Mesh()
        for i in self.indices:
            mesh.vertex(self.positions[i], self.normals[i], self.uvs[i])
        return mesh

    def check(self):
        """Every triangle with an area faces the side its vertex normals are on."""
        for t in range(0, len(self.indices), 3):
            a, b, c = (self.positions[i] for i in self.indices[t:t + 3])
            u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
            face = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            normal = [sum(self.normals[i][k] for i in self.indices[t:t + 3]) for k in range(3)]
            assert sum(f * n for f, n in zip(face, normal)) >= -1e-9, f"triangle {t // 3} is inside out"


def turn_y(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (c * p[0] + s * p[2], p[1], c * p[2] - s * p[0])


def turn_x(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (p[0], c * p[1] - s * p[2], c * p[2] + s * p[1])


def turn_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2])


def quaternion(pitch, yaw):
    """glTF's (x, y, z, w) of a turn by `pitch` about x, then by `yaw` about y, in degrees."""
    half_x, half_y = math.radians(pitch) / 2, math.radians(yaw) / 2
    return (math.sin(half_x) * math.cos(half_y), math.cos(half_x) * math.sin(half_y),
            -math.sin(half_x) * math.sin(half_y), math.cos(half_x) * math.cos(half_y))


def surface(point, columns, rows, uv_size=(1.0, 1.0)):
    """The surface point(u, v) over [0, 1]^2, normals by central differences.

    It faces the side from which u runs to the right where v runs up.
    """
    mesh = Mesh()
    step = 1e-4
    for row in range(rows + 1):
        for column in range(columns + 1):
            u, v = column / columns, row / rows
            along = [b - a for a, b in zip(point(u - step, v), point(u + step, v))]
            up = [b - a for a, b in zip(point(u, v - step), point(u, v + step))]
            normal = (along[1] * up[2] - along[2] * up[1], along[2] * up[0] - along[0] * up[2],
                      along[0] * up[1] - along[1] * up[0])
            mesh.vertex(point(u, v), normal, (u * uv_size[0], (1.0 - v) * uv_size[1]))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            mesh.quad(a, a + 1, a + columns + 2, a + columns + 1)
    return mesh


def rectangle(origin, along, up, uv_size=(1.0, 1.0)):
    """A parallelogram of two triangles, facing along x up."""
    def point(u, v):
        return tuple(o + u * a + v * b for o, a, b in zip(origin, along, up))
    return surface(point, 1, 1, uv_size)


def box(width, height, depth):
    """Centred on the origin."""
    x, y, z = width / 2, height / 2, depth / 2
    mesh = rectangle((-x, -y, z), (width, 0, 0), (0, height, 0))
    mesh.add(rectangle((x, -y, -z), (-width, 0, 0), (0, height, 0)))
    mesh.add(rectangle((x, -y, z), (0, 0, -depth), (0, height, 0)))
    mesh.add(rectangle((-x, -y, -z), (0, 0, depth), (0, height, 0)))
    mesh.add(rectangle((-x, y, z), (width, 0, 0), (0, 0, -depth)))
    return mesh.add(rectangle((-x, -y, -z), (width, 0, 0), (0, 0, depth)))


def sphere(radius, columns, rows):
    """Poles on the y axis; they are fans without triangles of no area."""
    def unit(u, v):
        ring = math.sin(math.pi * v)
        return ring * math.sin(2 * math.pi * u), -math.cos(math.pi * v), ring * math.cos(2 * math.pi * u)
    mesh = Mesh()
    for row in range(rows + 1):
        for column in range(columns + 1):
            n = unit(column / columns, row / rows)
            mesh.vertex([radius * c for c in n], n, (column / columns, 1 - row / rows))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            if row > 0:
                mesh.indices += [a, a + 1, a + columns + 2]
            if row < rows - 1:
                mesh.indices += [a, a + columns + 2, a + columns + 1]
    return mesh


def revolved(profile, columns, flute=None):
    """Pieces of (radius, height) lines, bottom to top, turned about the y axis.

    Inside a piece the surface is smooth, between pieces there is an edge. flute(angle) scales the
    radius.
    """
    mesh = Mesh()
    for piece in profile:
        def point(u, v, piece=piece):
            place = min(max(v, 0.0), 1.0) * (len(piece) - 1)
            i = min(int(place), len(piece) - 2)
            # Outside [0, 1] the line goes on, so that the differences at its ends have a direction.
            t = v * (len(piece) - 1) - i
            radius = piece[i][0] + t * (piece[i + 1][0] - piece[i][0])
            y = piece[i][1] + t * (piece[i + 1][1] - piece[i][1])
            angle = 2 * math.pi * u
            radius *= flute(angle) if flute else 1.0
            return radius * math.sin(angle), y, radius * math.cos(angle)
        mesh.add(surface(point, columns, len(piece) - 1))
    return mesh


def torus(major, minor, columns, rows):
    """Around the y axis."""
    def point(u, v):
        ring = major - minor * math.cos(2 * math.pi * v)
        angle = 2 * math.pi * u
        return ring * math.sin(angle), -minor * math.sin(2 * math.pi * v), ring * math.cos(angle)
    return surface(point, columns, rows)


def arch_band(radius, thickness, depth, columns):
    """A half ring in the plane of x and y, from angle 0 to pi, its inner side at `radius`.

    Front, back, inner and outer side; depth along z, centred.
    """
    outer, z = radius + thickness, depth / 2
    def ring(angle, r, at):
        return r * math.cos(angle), r * math.sin(angle), at
    sides = (
        lambda u, v: ring(math.pi * (1 - u), radius + v * thickness, z),
        lambda u, v: ring(math.pi * u, radius + v * thickness, -z),
        lambda u, v: ring(math.pi * u, radius, z - v * depth),
        lambda u, v: ring(math.pi * (1 - u), outer, z - v * depth))
    lengths = (math.pi * radius, math.pi * radius, math.pi * radius, math.pi * outer)
    widths = (thickness, thickness, depth, depth)
    mesh = Mesh()
    for side, length, width in zip(sides, lengths, widths):
        mesh.add(surface(side, columns, 1, (length, width)))
    return mesh


def spandrel(half_width, radius, height, depth, columns):
    """The wall over a round arch: x in [-half_width, half_width], y from 0 (the arch's spring) to
    height. Front, back and the inner side of the arch; depth along z, centred."""
    z = depth / 2
    def rim(u):
        # Beyond the arch's feet the rim is the horizontal line y = 0.
        feet = (half_width - radius) / (2 * half_width)
        if u <= feet:
            return -half_width + u * 2 * half_width, 0.0
        if u >= 1 - feet:
            return half_width - (1 - u) * 2 * half_width, 0.0
        angle = math.pi * (1 - (u - feet) / (1 - 2 * feet))
        return radius * math.cos(angle), radius * math.sin(angle)
    feet = (half_width - radius) / (2 * half_width)
    stops = [0.0] + [feet + (1 - 2 * feet) * i / columns for i in range(columns + 1)] + [1.0]
    mesh = Mesh()
    for side in (1, -1):
        for u0, u1 in zip(stops, stops[1:]):
            (x0, y0), (x1, y1) = rim(u0), rim(u1)
            corners = [(x0, y0), (x1, y1), (x1, height), (x0, height)]
            ids = [mesh.vertex((x, y, side * z), (0, 0, side), (side * x, -y)) for x, y in corners]
            mesh.quad(*(ids if side > 0 else reversed(ids)))
    def inner(u, v):
        angle = math.pi * u
        return radius * math.cos(angle), radius * math.sin(angle), z - v * depth
    return mesh.add(surface(inner, columns, 1, (math.pi * radius, depth)))
