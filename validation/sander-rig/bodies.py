"""Compliance of the bodies of the friction rig by finite elements; writes compliance.csv (see README.md).

Rod and brackets are plates of the width of their bearing: quadratic triangles in the plane, Legendre
polynomials along the axis, free ends. The stepped shaft is a body of revolution: biquadratic rectangles in the
half plane, Fourier's orders around. Pressure on a bearing surface is cos or sin(n phi) times P_m(2 z/width),
phi from the load; answered is by how much the gap opens, in the same functions. Translations of a body as a
whole do not count.

    python3 validation/sander-rig/bodies.py          checks against closed forms, then the file
    python3 validation/sander-rig/bodies.py file     only the file

Needs numpy and scipy.
"""

import pathlib
import sys

import numpy as np
from numpy.polynomial import legendre
from scipy.sparse import bmat, coo_matrix, csc_matrix, kron
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree

NU = 0.3
ORDERS = 24
LEVELS = 9  # of lattices of points, each 1.45 as wide
SMALLEST = 2e-4  # of the largest coefficient: what is less is not written


# Sizes of the source, m: x from the bore's centre against the load on it, y across.
class Rod:
    """Two states of the source's file: lengths to the small end, of shank and lugs."""

    young = 70e9
    radius, width = 47.8e-3 / 2, 17.2e-3
    small_radius, beyond, outer = 25e-3, 50e-3, 70e-3

    def __init__(self, length, shank, lugs, lug_height):
        self.length, self.shank, self.lugs, self.lug_height = length, shank, lugs, lug_height

    def inside(self, x, y):
        eye = np.hypot(x, y) < self.outer
        shank = (np.abs(y) < self.shank / 2) & (x > 0) & (x < self.length + self.beyond)
        lugs = (np.abs(x) < self.lug_height / 2) & (np.abs(y) < self.lugs / 2)
        holes = (np.hypot(x, y) < self.radius) | (np.hypot(x - self.length, y) < self.small_radius)
        return (eye | shank | lugs) & ~holes

    def outline(self):
        half, lug = self.shank / 2, self.lug_height / 2
        top = self.length + self.beyond
        root = np.sqrt(self.outer**2 - half**2)
        foot = np.sqrt(self.outer**2 - lug**2)
        corners = [(top, 0.0), (top, half), (root, half)]
        corners += arc(self.outer, np.arctan2(half, root), np.arctan2(foot, lug))
        corners += [(lug, foot), (lug, self.lugs / 2), (-lug, self.lugs / 2), (-lug, foot)]
        corners += arc(self.outer, np.arctan2(foot, -lug), np.pi)
        return [corners + [(-self.outer, 0.0)]], [(self.length, self.small_radius)]


class Bracket:
    """Clamped at its foot; x towards the foot."""

    young = 210e9
    radius, width = 54e-3 / 2, 25e-3

    def __init__(self, top, foot, body, base, base_height):
        self.top, self.foot, self.body, self.base, self.base_height = top, foot, body, base, base_height

    def corners(self):
        return [
            (-self.top - 10e-3, 0.0),
            (-self.top - 10e-3, 25e-3),
            (-self.top, 35e-3),
            (-self.top, self.body / 2),
            (self.foot - self.base_height, self.body / 2),
            (self.foot - self.base_height, self.base / 2),
            (self.foot, self.base / 2),
            (self.foot, 10e-3),
            (self.foot - 20e-3, 10e-3),
            (self.foot - 20e-3, 0.0),
        ]

    def inside(self, x, y):
        return within(self.corners(), x, np.abs(y)) & (np.hypot(x, y) > self.radius)

    def outline(self):
        return [self.corners()], []


RODS = [Rod(182e-3, 90e-3, 162e-3, 57e-3), Rod(150e-3, 100e-3, 150e-3, 70e-3)]
BRACKETS = [
    Bracket(54e-3, 132e-3, 150e-3, 246e-3, 57e-3),
    Bracket(60e-3, 100e-3, 150e-3, 200e-3, 50e-3),
]
SHAFT_RADII, SHAFT_GAP = (Rod.radius, Bracket.radius), 2e-3


def arc(radius, start, end, parts=24):
    return [(radius * np.cos(t), radius * np.sin(t)) for t in np.linspace(start, end, parts)]


def within(corners, x, y):
    """Crossings of a ray along +x; the figure is closed along y = 0."""
    odd = np.zeros(np.shape(x), bool)
    for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
        if y0 != y1:
            crosses = (y0 > y) != (y1 > y)
            odd ^= crosses & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return odd


def along(start, end, size):
    """Points of a line as far from each other as the size there says."""
    t = np.linspace(0, 1, 400)
    x, y = (start[k] + (end[k] - start[k]) * t for k in (0, 1))
    count = np.concatenate([[0.0], np.cumsum(np.diff(t) * np.hypot(x[-1] - x[0], y[-1] - y[0]) / size((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2))])
    at = np.interp(np.linspace(0, count[-1], max(1, int(np.ceil(count[-1]))) + 1), count, t)
    return [(start[0] + (end[0] - start[0]) * s, start[1] + (end[1] - start[1]) * s) for s in at]


def triangles(body, around=72):
    """Half a section, y >= 0: corners and triangles of points that stand wider away from the bore."""
    step = np.pi * body.radius / around
    size = lambda x, y: step * (1.0 + 0.45 * (np.hypot(x, y) - body.radius) / step * 0.35)
    points = []
    radius = body.radius
    while body.inside(np.array(radius * 1.0001), np.array(1e-9)) or radius < body.radius * 1.2:
        if radius > body.radius * 1.25:
            break
        many = max(8, int(round(np.pi * radius / size(radius, 0.0))))
        many = around if radius == body.radius else many
        points += arc(radius, 0.0, np.pi, many + 1)
        radius += size(radius, 0.0)
    rings = radius - 0.5 * size(radius, 0.0)
    outlines, holes = body.outline()
    lines = list(outlines)
    for centre, small in holes:
        lines.append([(centre + x, y) for x, y in arc(small, 0.0, np.pi, 33)])
    edge = []
    for line in lines:
        for (x0, y0), (x1, y1) in zip(line, line[1:]):
            edge += along((x0, y0), (x1, y1), size)
    # the line of symmetry, between the rings, the holes and the outline
    xs = np.array([p[0] for p in edge])
    ends = sorted([x for x, y in edge if abs(y) < 1e-12] + [rings, -rings])
    for x0, x1 in zip(ends, ends[1:]):
        if body.inside(np.array((x0 + x1) / 2), np.array(1e-9)) and x1 - x0 > 1e-9:
            edge += along((x0, 0.0), (x1, 0.0), size)
    edge = [p for p in edge if np.hypot(*p) > body.radius * 1.2]
    points = np.array(points + edge)
    # from the finest lattice on, what keeps its distance from what is there
    inner = []
    for level in range(LEVELS):
        h = step * 1.6 * 1.45**level
        x, y = np.meshgrid(np.arange(xs.min(), xs.max(), h), np.arange(0.3 * h, max(p[1] for p in edge), 0.866 * h))
        x = x + 0.5 * h * (np.arange(x.shape[0]) % 2)[:, None]
        x, y = x.ravel(), y.ravel()
        wanted = size(x, y)
        keep = body.inside(x, y) & (np.hypot(x, y) > rings) & (wanted > h * 0.83)
        keep &= (wanted <= h * 1.205) | (level == LEVELS - 1)
        inner.append(np.column_stack([x, y])[keep])
    for group in inner:
        tree = cKDTree(points)
        far = tree.query(group)[0] > 0.62 * size(group[:, 0], group[:, 1]) if len(group) else []
        points = np.vstack([points, group[far]])
    points = points[np.unique(np.round(points, 9), axis=0, return_index=True)[1]]
    shape = Delaunay(points).simplices
    middle = points[shape].mean(axis=1)
    shape = shape[body.inside(middle[:, 0], middle[:, 1]) & (middle[:, 1] > 0)]
    a, b, c = (points[shape[:, k]] for k in range(3))
    twice = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    shape = shape[np.abs(twice) > 1e-12]
    flip = twice[np.abs(twice) > 1e-12] < 0
    shape[flip] = shape[flip][:, [0, 2, 1]]
    return points, shape


def quadratic(points, shape, circles):
    """Six nodes per triangle; middles of edges on a circle lie on it."""
    edges, new, six = {}, [], []
    for t in shape:
        row = list(t)
        for i, j in ((0, 1), (1, 2), (2, 0)):
            key = tuple(sorted((t[i], t[j])))
            if key not in edges:
                edges[key] = len(points) + len(new)
                middle = (points[t[i]] + points[t[j]]) / 2
                for cx, r in circles:
                    away = [abs(np.hypot(points[k][0] - cx, points[k][1]) - r) for k in key]
                    if max(away) < 1e-9:
                        d = middle - [cx, 0.0]
                        middle = np.array([cx, 0.0]) + d * r / np.hypot(*d)
                new.append(middle)
            row.append(edges[key])
        six.append(row)
    return np.vstack([points, new]), np.array(six)


def triangle_functions(a, b):
    c = 1 - a - b
    value = np.array([c * (2 * c - 1), a * (2 * a - 1), b * (2 * b - 1), 4 * c * a, 4 * a * b, 4 * b * c])
    by_a = np.array([1 - 4 * c, 4 * a - 1, 0 * a, 4 * (c - a), 4 * b, -4 * b])
    by_b = np.array([1 - 4 * c, 0 * a, 4 * b - 1, -4 * a, 4 * a, 4 * (c - b)])
    return value, by_a, by_b


TRIANGLE_RULE = [
    (0.445948490915965, 0.445948490915965, 0.111690794839005),
    (0.108103018168070, 0.445948490915965, 0.111690794839005),
    (0.445948490915965, 0.108103018168070, 0.111690794839005),
    (0.091576213509771, 0.091576213509771, 0.054975871827661),
    (0.816847572980459, 0.091576213509771, 0.054975871827661),
    (0.091576213509771, 0.816847572980459, 0.054975871827661),
]


def plane_matrices(nodes, six):
    """Integrals of products of the functions and their slopes over the section."""
    names = ["xx", "xy", "yy", "x0", "y0", "00"]
    sums = {name: np.zeros((len(six), 6, 6)) for name in names}
    x, y = nodes[six, 0], nodes[six, 1]
    for a, b, weight in TRIANGLE_RULE:
        value, by_a, by_b = triangle_functions(a, b)
        j = [[x @ by_a, y @ by_a], [x @ by_b, y @ by_b]]
        det = j[0][0] * j[1][1] - j[0][1] * j[1][0]
        assert det.min() > 0, "a triangle is turned over"
        dx = (np.outer(j[1][1], by_a) - np.outer(j[0][1], by_b)) / det[:, None]
        dy = (np.outer(j[0][0], by_b) - np.outer(j[1][0], by_a)) / det[:, None]
        one = np.tile(value, (len(six), 1))
        of = {"x": dx, "y": dy, "0": one}
        for name in names:
            sums[name] += np.einsum("e,ei,ej->eij", weight * det, of[name[0]], of[name[1]])
    rows = np.repeat(six, 6, axis=1).ravel()
    columns = np.tile(six, (1, 6)).ravel()
    shape = (len(nodes), len(nodes))
    return {n: coo_matrix((v.ravel(), (rows, columns)), shape).tocsr() for n, v in sums.items()}


def axial_matrices(rows, columns, width):
    """Integrals along the axis of P_k P_l, P_k' P_l and P_k' P_l' of the given degrees."""
    z, weight = legendre.leggauss(24)
    p = lambda k: legendre.legval(z, np.eye(24)[k])
    d = lambda k: legendre.legval(z, legendre.legder(np.eye(24)[k])) * 2 / width
    of = lambda f, g: np.array([[weight @ (f(k) * g(l)) for l in columns] for k in rows]) * width / 2
    return of(p, p), of(d, p), of(p, d), of(d, d)


def plate_compliance(body, sine, odd, degrees, clamped, orders=ORDERS, mesh=None):
    """Compliance of the bore, rows and columns (n, m); balanced by the small end or clamped at the foot."""
    points, shape = mesh or triangles(body)
    holes = body.outline()[1]
    nodes, six = quadratic(points, shape, [(0.0, body.radius)] + holes)
    s = plane_matrices(nodes, six)
    lame, mu = body.young * NU / ((1 + NU) * (1 - 2 * NU)), body.young / (2 * (1 + NU))
    ku = [k for k in range(degrees) if k % 2 == odd]
    kw = [k + 1 if not odd else k - 1 for k in ku]
    if odd:
        kw = [k for k in range(0, degrees, 2)]
    uu, _, _, ug = axial_matrices(ku, ku, body.width)
    ww, _, _, wg = axial_matrices(kw, kw, body.width)
    _, dw, wd, _ = axial_matrices(ku, kw, body.width)
    both = lame + 2 * mu
    xx = kron(both * s["xx"] + mu * s["yy"], uu) + kron(mu * s["00"], ug)
    yy = kron(both * s["yy"] + mu * s["xx"], uu) + kron(mu * s["00"], ug)
    zz = kron(mu * (s["xx"] + s["yy"]), ww) + kron(both * s["00"], wg)
    xy = kron(lame * s["xy"] + mu * s["xy"].T, uu)
    xz = kron(lame * s["x0"], wd) + kron(mu * s["x0"].T, dw)
    yz = kron(lame * s["y0"], wd) + kron(mu * s["y0"].T, dw)
    stiffness = bmat([[xx, xy, xz], [xy.T, yy, yz], [xz.T, yz.T, zz]]).tocsc()
    many, nu, nw = len(nodes), len(ku), len(kw)
    fixed = np.zeros(stiffness.shape[0], bool)
    ux = lambda i: i * nu
    uy = lambda i: many * nu + i * nu
    uz = lambda i: 2 * many * nu + i * nw
    for i in np.flatnonzero(np.abs(nodes[:, 1]) < 1e-9):
        if sine:
            fixed[ux(i) : ux(i) + nu] = True
            fixed[uz(i) : uz(i) + nw] = True
        else:
            fixed[uy(i) : uy(i) + nu] = True
    if clamped:
        for i in np.flatnonzero(np.abs(nodes[:, 0] - body.foot) < 1e-9):
            fixed[ux(i) : ux(i) + nu] = True
            fixed[uy(i) : uy(i) + nu] = True
            fixed[uz(i) : uz(i) + nw] = True
    elif not odd:
        axis = np.flatnonzero(np.abs(nodes[:, 1]) < 1e-9)
        axis = axis[np.argsort(nodes[axis, 0])]
        if sine:
            fixed[uy(axis[0])] = fixed[uy(axis[-1])] = True
        else:
            fixed[ux(axis[0])] = True
    # loads of the bore: edges whose three nodes lie on it
    on = np.abs(np.hypot(nodes[:, 0], nodes[:, 1]) - body.radius) < 1e-9
    edges = [(t[i], t[3 + i], t[j]) for t in six for i, j in ((0, 1), (1, 2), (2, 0)) if on[t[i]] and on[t[3 + i]] and on[t[j]]]
    assert len(edges) > 20
    ns = [n for n in range(1 if sine else 0, orders + 1)]
    g, gw = legendre.leggauss(6)
    line = np.zeros((2 * many, len(ns)))
    total = 0.0
    for e in edges:
        x, y = nodes[list(e), 0], nodes[list(e), 1]
        for q, weight in zip(g, gw):
            f = np.array([q * (q - 1) / 2, 1 - q * q, q * (q + 1) / 2])
            d = np.array([q - 0.5, -2 * q, q + 0.5])
            length = weight * np.hypot(d @ x, d @ y)
            total += length
            angle = np.arctan2(f @ y, f @ x)
            wave = np.array([np.sin(n * angle) if sine else np.cos(n * angle) for n in ns])
            for k, i in enumerate(e):
                line[i] += length * f[k] * np.cos(angle) * wave
                line[many + i] += length * f[k] * np.sin(angle) * wave
    assert abs(total / (np.pi * body.radius) - 1) < 1e-4, total
    load = np.zeros((stiffness.shape[0], len(ns) * nu))
    for c in range(len(ns)):
        for k in range(nu):
            load[np.arange(2 * many) * nu + k, c * nu + k] = line[:, c] * uu[k, k]
    taken = load.copy()
    if not clamped and not sine and not odd and holes:
        centre, small = holes[0]
        rim = np.flatnonzero(np.abs(np.hypot(nodes[:, 0] - centre, nodes[:, 1]) - small) < 1e-9)
        force = load[np.arange(many) * nu].sum(axis=0)
        share = np.where(np.abs(nodes[rim, 1]) < 1e-9, 0.5, 1.0)
        for i, part in zip(rim, share / share.sum()):
            taken[ux(i)] -= part * force
    free = np.flatnonzero(~fixed)
    solver = splu(csc_matrix(stiffness[free][:, free]), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    give = np.zeros_like(load)
    give[free] = solver.solve(taken[free])
    answer = load.T @ give  # half the bore
    labels = [(n, k) for n in ns for k in ku]
    norm = np.array([np.pi * body.radius / (1 if n == 0 else 2) * body.width / (2 * k + 1) for n, k in labels])
    return labels, answer / norm[:, None]


def revolution_compliance(order, young, lines_r, lines_z, steps, loads, degrees):
    """Compliance of surfaces of a stepped body of revolution, symmetric about z = 0.

    lines: the grid; steps: (z, radius) from z on; loads: (radius, start, width, parity) of each surface.
    Rows and columns (surface, m). Order 1 is balanced by the other surface, evenly along it."""
    gauss, weights = legendre.leggauss(4)
    r2 = np.sort(np.concatenate([lines_r, (lines_r[1:] + lines_r[:-1]) / 2]))
    z2 = np.sort(np.concatenate([lines_z, (lines_z[1:] + lines_z[:-1]) / 2]))
    index = lambda i, j: j * len(r2) + i
    lame, mu = young * NU / ((1 + NU) * (1 - 2 * NU)), young / (2 * (1 + NU))
    material = np.diag([2 * mu] * 3 + [mu] * 3)
    material[:3, :3] += lame
    quad = lambda q: (np.array([q * (q - 1) / 2, 1 - q * q, q * (q + 1) / 2]), np.array([q - 0.5, -2 * q, q + 0.5]))
    radius_at = lambda z: [r for start, r in steps if start <= z][-1]
    rows, columns, values = [], [], []
    used = np.zeros(len(r2) * len(z2), bool)
    n = order
    for j in range(len(lines_z) - 1):
        for i in range(len(lines_r) - 1):
            if lines_r[i + 1] > radius_at((lines_z[j] + lines_z[j + 1]) / 2) + 1e-9:
                continue
            a, b = (lines_r[i + 1] - lines_r[i]) / 2, (lines_z[j + 1] - lines_z[j]) / 2
            cell = np.zeros((27, 27))
            for q, wq in zip(gauss, weights):
                fr, dr = quad(q)
                r = lines_r[i] + a * (1 + q)
                for p, wp in zip(gauss, weights):
                    fz, dz = quad(p)
                    f = np.outer(fz, fr).ravel()
                    by_r = np.outer(fz, dr).ravel() / a
                    by_z = np.outer(dz, fr).ravel() / b
                    strain = np.zeros((6, 27))
                    strain[0, 0::3] = by_r
                    strain[1, 0::3], strain[1, 1::3] = f / r, n * f / r
                    strain[2, 2::3] = by_z
                    strain[3, 0::3], strain[3, 1::3] = -n * f / r, by_r - f / r
                    strain[4, 1::3], strain[4, 2::3] = by_z, -n * f / r
                    strain[5, 0::3], strain[5, 2::3] = by_z, by_r
                    cell += wq * wp * a * b * r * strain.T @ material @ strain
            nodes = [index(2 * i + c, 2 * j + d) for d in range(3) for c in range(3)]
            used[nodes] = True
            dofs = (3 * np.array(nodes)[:, None] + np.arange(3)).ravel()
            rows.append(np.repeat(dofs, 27))
            columns.append(np.tile(dofs, 27))
            values.append(cell.ravel())
    size = 3 * len(used)
    stiffness = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (size, size)).tocsc()
    fixed = np.repeat(~used, 3)
    for i in range(len(r2)):
        fixed[3 * index(i, 0) + 2] = True
    for j in range(len(z2)):
        dof = 3 * index(0, j)
        fixed[dof + 2] |= n > 0
        if n != 1:
            fixed[dof] = fixed[dof + 1] = True
    if n == 1:
        fixed[3 * index(0, 0)] = True
    if n == 0:
        fixed[1::3] = True
    load, labels, norm = [], [], []
    for surface, (radius, start, width, even) in enumerate(loads):
        at = int(np.argmin(np.abs(r2 - radius)))
        first = start if not even else start - width / 2
        for m in range(0, degrees, 2 if even else 1):
            column = np.zeros(size)
            for j in range(len(lines_z) - 1):
                z0, z1 = lines_z[j], lines_z[j + 1]
                if z0 < start - 1e-9 or z1 > first + width + 1e-9:
                    continue
                for q, wq in zip(gauss, weights):
                    f, _ = quad(q)
                    z = z0 + (z1 - z0) * (1 + q) / 2
                    wave = legendre.legval(2 * (z - first) / width - 1, np.eye(24)[m])
                    for d in range(3):
                        column[3 * index(at, 2 * j + d)] += wq * (z1 - z0) / 2 * f[d] * wave * radius
            load.append(column)
            labels.append((surface, m))
            norm.append(radius * width / (2 * m + 1) / (2 if even else 1))
    load = np.array(load).T
    taken = load.copy()
    if n == 1:
        # the integral of cos^2 around is that of the other's, so sums of the columns are the forces
        force = load[0::3].sum(axis=0)
        even = [labels.index((k, 0)) for k in range(len(loads))]
        for c, (surface, m) in enumerate(labels):
            if m == 0 or abs(force[c]) > 1e-12 * abs(force[even[surface]]):
                other = even[1 - surface]
                taken[:, c] -= load[:, other] * force[c] / force[other]
    free = np.flatnonzero(~fixed)
    solver = splu(csc_matrix(stiffness[free][:, free]))
    give = np.zeros_like(load)
    give[free] = solver.solve(taken[free])
    return labels, (load.T @ give) / np.array(norm)[:, None]


def graded(points):
    """Grid lines through (position, cell size at it) pairs."""
    lines = []
    for (x0, h0), (x1, h1) in zip(points, points[1:]):
        many = max(1, int(np.ceil((x1 - x0) / np.sqrt(h0 * h1))))
        t = np.linspace(0, 1, many + 1)
        q = (h1 / h0) ** 0.8
        s = t if abs(q - 1) < 1e-9 else (q**t - 1) / (q - 1)
        lines += list(x0 + (x1 - x0) * s)[:-1]
    return np.array(lines + [points[-1][0]])


def shaft(order, degrees=8):
    half, gap, width = Rod.width / 2, SHAFT_GAP, Bracket.width
    r0, r1 = SHAFT_RADII
    fine = 0.45e-3
    r = graded([(0.0, 3e-3), (r0, fine), (r1, fine)])
    z = graded([(0.0, 1e-3), (half, fine), (half + gap, fine), (half + gap + width / 2, 1.2e-3), (half + gap + width, fine)])
    steps = [(0.0, r0), (half + gap, r1)]
    loads = [(r0, 0.0, Rod.width, True), (r1, half + gap, width, False)]
    return revolution_compliance(order, 210e9, r, z, steps, loads, degrees)


class Ring:
    young = 200e9
    width = 10e-3

    def __init__(self, inner, outer):
        self.radius, self.outer = inner, outer

    def inside(self, x, y):
        return (np.hypot(x, y) > self.radius) & (np.hypot(x, y) < self.outer)

    def outline(self):
        return [arc(self.outer, 0.0, np.pi, 200)], []


def check():
    """Against Lame and Michell."""
    ring = Ring(100e-3, 149.5e-3)
    _, c = plate_compliance(ring, False, 0, 3, False, orders=6)
    got = 1e6 * c[0, 0] * 50e6
    print(f"ring of Lame, plane stress: {got:.3f} um of 72.985")
    assert abs(got / 72.985 - 1) < 1e-3
    # a hole in a plate: the outside is far away; thin, then thick
    for width, kappa in ((1e-4, (3 - NU) / (1 + NU)), (10.0, 3 - 4 * NU)):
        plate = Ring(10e-3, 400e-3)
        plate.width = width
        labels, c = plate_compliance(plate, False, 0, 1, False, orders=24)
        _, s = plate_compliance(plate, True, 0, 1, False, orders=24)
        mu, r = plate.young / (2 * (1 + NU)), plate.radius
        for n in (0, 2, 3, 10, 24):
            exact = r / (2 * mu) if n == 0 else r / (4 * mu) / (n - 1) * (kappa + (n - 1) / (n + 1))
            k = labels.index((n, 0))
            other = s[k - 1, k - 1] / exact if n else 1.0
            print(f"hole of width {width} m, order {n}: {c[k, k] / exact:.5f} {other:.5f} of Michell's")
            assert abs(c[k, k] / exact - 1) < 0.02 and abs(other - 1) < 0.02
    # short waves see a half-plane, more so the farther the ends
    labels, c = shaft(24)
    k = labels.index((1, 0))
    exact = 2 * (1 - NU**2) / 210e9 * SHAFT_RADII[1] / 24
    print(f"shaft, order 24: {c[k, k] / exact:.4f} of a half-plane's")
    assert 0.95 < c[k, k] / exact < 1.15
    # the slope of the shaft in the supports, against a beam of its two diameters with shear left out
    labels, c = shaft(1)
    force = 4e3
    pressure = force / (np.pi * SHAFT_RADII[1] * Bracket.width)
    slope = 2 * c[labels.index((1, 1)), labels.index((1, 0))] * pressure / Bracket.width
    print(f"shaft: slope in the supports {slope:.2e} under 8 kN in the test bearing")
    for name, body, clamped in bodies():
        finer = triangles(body, 108)
        one, two = (plate_compliance(body, False, 0, 4, clamped, mesh=m)[1] for m in (None, finer))
        print(f"{name}: finer triangles change the compliance by {np.abs(two - one).max() / np.abs(one).max():.1e}")


def bodies():
    return [
        ("rod", RODS[0], False),
        ("bracket", BRACKETS[0], True),
        ("other-rod", RODS[1], False),
        ("other-bracket", BRACKETS[1], True),
    ]


def write(path):
    """One line per coefficient; the larger of the two labels first, for the matrices are those of energies."""
    lines = [
        "# source: calculated by bodies.py from the sizes and materials of the rig's file (see README.md)",
        "body,wave,order,degree,order_of_pressure,degree_of_pressure,opening_per_pressure[m/Pa]",
    ]

    def add(name, wave, labels, c):
        largest = np.abs(c).max()
        for i, (n, k) in enumerate(labels):
            for j, (o, l) in enumerate(labels):
                if (n, k) != (1, 0) and abs(c[i, j]) > SMALLEST * largest:
                    lines.append(f"{name},{wave},{n},{k},{o},{l},{c[i, j]:.4e}")

    for name, body, clamped in bodies():
        for sine, wave in ((False, "cos"), (True, "sin")):
            for odd in (0, 1) if clamped else (0,):
                labels, c = plate_compliance(body, sine, odd, 8, clamped)
                if sine and not clamped:
                    c[:, labels.index((1, 0))] = 0.0
                add(name, wave, labels, c)
    for n in range(ORDERS + 1):
        labels, c = shaft(n)
        for surface, name in enumerate(("shaft-in-rod", "shaft-in-bracket")):
            own = [i for i, (s, _) in enumerate(labels) if s == surface]
            add(name, "both", [(n, labels[i][1]) for i in own], c[np.ix_(own, own)])
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
    print(f"{len(lines)} lines")


if __name__ == "__main__":
    if "file" not in sys.argv:
        check()
    write(pathlib.Path(__file__).with_name("compliance.csv"))
