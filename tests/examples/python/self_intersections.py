# %% [markdown]
# Which of my frames self-intersect?
#
# A strip is rolled up, tighter in every frame, until its end runs into its beginning.

# %%
import contactcheck
import numpy as np

n = 60
s, y = np.linspace(0, 1, n + 1), (0.0, 0.2)
c = 2 * np.arange(n)
F = np.vstack([np.column_stack([c, c + 1, c + 3]), np.column_stack([c, c + 3, c + 2])])
frames = []
for angle in np.linspace(0.5, 7.5, 29):
    x, z = np.sin(angle * s) / angle, (1 - np.cos(angle * s)) / angle
    frames.append(np.array([[x[i], b, z[i]] for i in range(n + 1) for b in y]))

# %% Pairs that share a vertex or an edge count only where they meet in more than that.
for f, V in enumerate(frames):
    pairs, shared = contactcheck.self_contacts(V, F)
    if len(pairs):
        print(f"frame {f}: {len(pairs)} pairs, first triangles {pairs[0].tolist()}, "
              f"{np.count_nonzero(shared)} of them neighbours")
        break
print("frames without self-contact:", f)

# %% The same by a detector that keeps its tree from frame to frame, as fast as can be.
detector = contactcheck.Detector("ffd-lazy")
detector.prepare([(frames[0], F)], ["self"])
counts = []
for V in frames:
    detector.update([V])
    counts.append(len(detector.query("self")["triangles"]))
print("pairs in the last five frames:", counts[-5:])
assert np.flatnonzero(counts)[0] == f
