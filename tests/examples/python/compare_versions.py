# %% [markdown]
# Compare two versions of my library, and let CI fail where the new one is worse.
#
# Version 2 rounds vertices to floats to save memory. Is that seen in its answers?

# %%
import contactcheck
import numpy as np


class Boxes:
    """Triangles touch where their boxes do: fast, and more than is true."""

    precision = np.float64
    declares = {"id": "mine", "levels": ["body", "triangle"], "questions": ["triangles"]}

    def prepare(self, bodies):
        self.faces = [body.faces for body in bodies]

    def update(self, frame):
        corners = [V.astype(self.precision)[F] for V, F in zip(frame.vertices, self.faces)]
        self.low, self.high = ([c.min(axis=1) for c in corners], [c.max(axis=1) for c in corners])

    def query(self, question):
        meet = np.ones((len(self.faces[0]), len(self.faces[1])), bool)
        for k in range(3):
            meet &= self.low[0][:, None, k] <= self.high[1][None, :, k]
            meet &= self.low[1][None, :, k] <= self.high[0][:, None, k]
        a, b = np.nonzero(meet)
        return {"triangles": np.column_stack([0 * a, 0 * a + 1, a, b])}


class Rounded(Boxes):
    precision = np.float32


# %% Two plates, one above the other, a billionth of their size apart or less.
V = np.array([[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
F = np.array([[0, 1, 2], [0, 2, 3]])
gaps = [1e-3, 1e-9, 0.0, -1e-9]
scene = contactcheck.Scene.from_frames(
    [([V] * len(gaps), F), ([V + [0.3, 0.3, gap] for gap in gaps], F)], id="plates")
before = contactcheck.run(scene, [Boxes()], timing=False)
after = contactcheck.run(scene, [Rounded()], timing=False)

# %% Where do the answers differ?
for name, results in (("before", before), ("after", after)):
    print(f"{name:7} spurious by frame: {results.per_frame('mine')['spurious'].tolist()}")

# %% And as a gate: the answers must be those of the version before.
verdict = contactcheck.gate(after, baseline=before)
print("passed" if verdict.passed else f"failed: {verdict.failures[0]['reason']}")
