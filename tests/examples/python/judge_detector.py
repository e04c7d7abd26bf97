# %% [markdown]
# Judge a detector in the style of trimesh: bodies are in contact where a ray test says so.
#
# Such a detector asks whether a vertex of one mesh lies inside the other. It misses all contacts of
# edges alone. contactcheck says how many, and where.

# %%
import contactcheck
import numpy as np


class VertexInside:
    """Bodies touch where a vertex of one is inside the other, by a ray along x in doubles."""

    declares = {"id": "vertex-inside", "levels": ["body"], "questions": ["body"]}

    def prepare(self, bodies):
        self.faces = [body.faces for body in bodies]

    def update(self, frame):
        self.vertices = frame.vertices

    def query(self, question):
        touch = self.any_inside(0, 1) or self.any_inside(1, 0)
        return {"bodies": [(0, 1)] if touch else []}

    def any_inside(self, a, b):
        """Is a vertex of body a inside body b? Odd numbers of crossings are inside."""
        low, high = self.vertices[b].min(axis=0), self.vertices[b].max(axis=0)
        corners = self.vertices[b][self.faces[b]]
        for point in self.vertices[a]:
            if (point < low).any() or (point > high).any():
                continue
            y, z = corners[:, :, 1] - point[1], corners[:, :, 2] - point[2]
            area = y * np.roll(z, -1, axis=1) - z * np.roll(y, -1, axis=1)
            hit = (area > 0).all(axis=1) | (area < 0).all(axis=1)
            weights = np.roll(area[hit], -1, axis=1) / area[hit].sum(axis=1, keepdims=True)
            x = (weights * corners[hit][:, :, 0]).sum(axis=1)
            if np.count_nonzero(x > point[0]) % 2:
                return True
        return False


# %% Two crossed bars that pass through one another: no vertex is ever inside the other.
def bar(axis):
    sides = np.full(3, 0.2)
    sides[axis] = 2.0
    corners = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]) * sides / 2
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
             [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
    return corners, np.array(faces)


(left, F), (right, _) = bar(0), bar(1)
assert contactcheck.check_mesh(left, F) == {}
heights = np.linspace(0.5, -0.5, 21)
scene = contactcheck.Scene.from_frames(
    [([left] * len(heights), F), ([right + [0, 0, h] for h in heights], F)], id="crossed-bars")

# %%
results = contactcheck.run(scene, [VertexInside(), "ffd-lazy"], timing=False)
for row in results.rows():
    print(f"{row['detector']:14} contact in {row['body_truth']} frames, "
          f"missed in {row['body_missed']}, spurious in {row['body_spurious']}")
missed = np.flatnonzero(results.per_frame("vertex-inside")["missed"])
print("first missed at height", round(heights[missed[0]], 2))
