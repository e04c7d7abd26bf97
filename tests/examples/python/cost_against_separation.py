# %% [markdown]
# Draw cost against separation: what does a detector cost as two links of a chain come near one another?
#
# Writes cost.svg into the working directory.

# %%
import pathlib
import time

import contactcheck
import numpy as np


def ring(major, minor, n, m):
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    r = major + minor * np.cos(v)
    V = np.stack([r * np.cos(u), r * np.sin(u), minor * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    return V, np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


V, F = ring(0.4, 0.1, 96, 48)
other = V[:, [0, 2, 1]]  # upright
separations = np.geomspace(0.2, 1e-4, 12)
names = ["ffd-lazy", "fcl-aabb", "embree"]

# %% Five times each, and the least counts: a machine can only be slower than it is.
costs = {}
for name in names:
    detector = contactcheck.Detector(name)
    detector.prepare([(V, F), (other, F)], ["triangles"])
    costs[name] = []
    for gap in separations:
        moved = other + [0.6 - gap, 0, 0]  # the tubes are so far apart, inside the first ring
        times = []
        for _ in range(5):
            start = time.perf_counter()
            detector.update([V, moved])
            detector.query("triangles")
            times.append(time.perf_counter() - start)
        costs[name].append(1000 * min(times))
    print(f"{name:9}", " ".join(f"{cost:.2f}" for cost in costs[name]), "ms")

# %% A picture without a library to draw it: both axes are logarithmic.
width, height, margin = 660, 400, 70
low, high = min(map(min, costs.values())), max(map(max, costs.values()))
at_x = lambda gap: margin + (width - 2 * margin) * np.log(gap / 1e-4) / np.log(2000)
at_y = lambda ms: height - margin - (height - 2 * margin) * np.log(ms / low) / np.log(high / low)
parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
         f'font-size="13"><rect width="100%" height="100%" fill="white"/>']
for gap in (1e-4, 1e-3, 1e-2, 1e-1):
    parts.append(f'<text x="{at_x(gap):.0f}" y="{height - margin + 20}" text-anchor="middle">{gap:g} m</text>')
for ms in (low, high):
    parts.append(f'<text x="{margin - 8}" y="{at_y(ms):.0f}" text-anchor="end">{ms:.2g} ms</text>')
for name, colour in zip(names, ("#0072b2", "#d55e00", "#009e73")):
    points = " ".join(f"{at_x(gap):.1f},{at_y(ms):.1f}" for gap, ms in zip(separations, costs[name]))
    parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
    parts.append(f'<text x="{width - margin + 4}" y="{at_y(costs[name][0]) + 4:.0f}" fill="{colour}">{name}</text>')
pathlib.Path("cost.svg").write_text("".join(parts) + "</svg>\n", encoding="utf-8")
print("cost.svg")
