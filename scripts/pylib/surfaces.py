"""Closed triangle meshes from parametric surfaces, and binary STL."""

import numpy as np


class Mesh:
    """Vertices [m] and triangles, counter-clockwise seen from outside."""

    def __init__(self, vertices, triangles):
        self.vertices = np.asarray(vertices, dtype=float)
        self.triangles = np.asarray(triangles, dtype=int)
        if self.volume() < 0:
            self.triangles = self.triangles[:, ::-1]

    def corners(self):
        return self.vertices[self.triangles]

    def volume(self):
        a, b, c = np.moveaxis(self.vertices[self.triangles], 1, 0)
        return np.einsum('ij,ij->', a, np.cross(b, c)) / 6


def tube(rings, cap=None):
    """Closes a stack of rings (M, K, 3) into a surface.

    `cap` lists the triangles, as indices into one ring, that close both ends; None is a fan around
    the ring's centroid.
    """
    count, size = rings.shape[:2]
    vertices = rings.reshape(-1, 3)
    i, k = np.meshgrid(np.arange(count - 1), np.arange(size), indexing='ij')
    a = (i * size + k).ravel()
    b = (i * size + (k + 1) % size).ravel()
    side = np.concatenate([np.stack([a, b, b + size], 1), np.stack([a, b + size, a + size], 1)])
    if cap is None:
        k = np.arange(size)
        first = np.full(size, len(vertices))
        cap_first = np.stack([(k + 1) % size, k, first], 1)
        last_ring = (count - 1) * size
        cap_last = np.stack([last_ring + k, last_ring + (k + 1) % size, first + 1], 1)
        vertices = np.concatenate([vertices, rings[:1].mean(1), rings[-1:].mean(1)])
    else:
        cap_first = np.asarray(cap)[:, ::-1]
        cap_last = np.asarray(cap) + (count - 1) * size
    return Mesh(vertices, np.concatenate([side, cap_first, cap_last]))


def revolve(profile, segments, displace=None):
    """A body of revolution about y. `profile` (K, 2) holds (radius, y); a radius of 0 at both ends
    makes a ball, an open loop without poles a ring. `displace(radius, y, angle)` may move its
    points along y."""
    profile = np.asarray(profile, dtype=float)
    angle = np.arange(segments) * 2 * np.pi / segments
    radius, y = (np.broadcast_to(v[:, None], (len(v), segments)) for v in profile.T)
    if displace is not None:
        y = y + displace(radius, y, angle[None, :])
    points = np.stack([radius * np.sin(angle), y, radius * np.cos(angle)], -1)
    if profile[0, 0] == 0 and profile[-1, 0] == 0:
        mesh = tube(points[1:-1])
        mesh.vertices[-2:] = points[0, 0], points[-1, 0]
        return mesh
    grid = np.arange(len(profile) * segments).reshape(len(profile), segments)
    a, b = grid, np.roll(grid, -1, 1)
    c, d = np.roll(b, -1, 0), np.roll(a, -1, 0)
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3),
                                np.stack([a, c, d], -1).reshape(-1, 3)])
    return Mesh(points.reshape(-1, 3), triangles)


def defects(mesh):
    """What keeps a mesh from being closed and outward after rounding to STL's floats, as text; ''
    if nothing."""
    corners = mesh.corners().astype('<f4')
    _, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    found = []
    if np.any(directed[:, 0] == directed[:, 1]):
        found.append('a triangle with two equal corners')
    keys, counts = np.unique(directed, axis=0, return_counts=True)
    if counts.max() > 1:
        found.append(f'{int((counts > 1).sum())} edges used twice in one direction')
    edges = set(map(tuple, keys))
    loose = sum((b, a) not in edges for a, b in edges)
    if loose:
        found.append(f'{loose} edges without a partner')
    a, b, c = np.moveaxis(corners.astype(float), 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    if area.min() < 1e-10:
        found.append(f'{int((area < 1e-10).sum())} triangles without area')
    if mesh.volume() <= 0:
        found.append('it is inside out')
    return ', '.join(found)


def stl_bytes(mesh):
    """Binary STL; the header says nothing, so that equal meshes are equal files."""
    corners = mesh.corners()
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    record = np.zeros(len(corners), dtype=[('normal', '<f4', 3), ('corners', '<f4', (3, 3)),
                                           ('spare', '<u2')])
    record['normal'], record['corners'] = normal, corners
    return b'cosserat_cable'.ljust(80) + len(corners).to_bytes(4, 'little') + record.tobytes()
