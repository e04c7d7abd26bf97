# %% [markdown]
# Find the first bad frame of a sequence: a simulated sheet sinks into a ball.
#
# `frames` stands for what your simulator has written: (n, 3) arrays, one per frame.

# %%
import contactcheck
import numpy as np


def sheet(n):
    x = np.linspace(-1, 1, n + 1)
    V = np.array([[a, b, 0.0] for b in x for a in x])
    c = np.array([i + (n + 1) * j for j in range(n) for i in range(n)])
    return V, np.vstack([np.column_stack([c, c + 1, c + n + 2]), np.column_stack([c, c + n + 2, c + n + 1])])


def ball(n):
    """An octahedron, refined n times, on the unit sphere."""
    V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    F = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    for _ in range(n):
        edges = np.sort(np.vstack([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
        pairs, which = np.unique(edges, axis=0, return_inverse=True)
        a, b, c = (which.reshape(3, -1) + len(V))
        V = np.vstack([V, V[pairs].mean(axis=1)])
        i, j, k = F.T
        F = np.vstack([np.column_stack(t) for t in ((i, a, c), (a, j, b), (c, b, k), (a, b, c))])
    return V / np.linalg.norm(V, axis=1, keepdims=True), F


V, F = sheet(24)
ball_V, ball_F = ball(4)
frames = []
for height in np.linspace(1.6, 0.8, 33):
    # It ought to come to rest on the ball, and does so a little too late.
    rest = np.sqrt(np.maximum(0, 1.0 - (V[:, :2] ** 2).sum(axis=1)))
    frames.append(np.column_stack([V[:, :2], np.maximum(height, np.minimum(rest, height + 0.05))]))

# %% Bisect where frames only get worse; else look at every one.
bad = [f for f, vertices in enumerate(frames) if len(contactcheck.contacts(vertices, F, ball_V, ball_F))]
print("first frame in contact:", bad[0], "of", len(frames))

# %% How close was the one before, and what is wrong in this one?
lower, upper, points = contactcheck.distance(frames[bad[0] - 1], F, ball_V, ball_F)
print(f"the frame before: {upper:.4f} m apart, at {points[0].round(2).tolist()}")
pairs = contactcheck.contacts(frames[bad[0]], F, ball_V, ball_F)
inside = contactcheck.inside(frames[bad[0]], ball_V, ball_F).winding != 0
print(f"{len(pairs)} pairs of triangles, {np.count_nonzero(inside)} vertices of the sheet inside the ball")
