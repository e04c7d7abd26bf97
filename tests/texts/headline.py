"""The front page's picture, out of fixtures/published/default.json: three bars a detector."""

import html

from tables import HEADLINE, count, headline_name, mean_ms, summed, three_digits

WIDTH, ROW, TOP = 860, 30, 64
NAMES = 250  # width of the column of names
PANEL, BAR = 200, 110  # a panel, and the longest bar in it; the rest is for its number
STYLE = """
  text { font: 13px -apple-system, "Segoe UI", Helvetica, Arial, sans-serif; fill: #1f2328; }
  .title { font-weight: 600; }
  .small { font-size: 11px; fill: #59636e; }
  .wrong { fill: #c2410c; }
  .time { fill: #2563a8; }
  .coarse { fill-opacity: 0.45; }
  line { stroke: #8b949e; stroke-width: 1; }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3; }
    .small { fill: #9198a1; }
    .wrong { fill: #f0883e; }
    .time { fill: #58a6ff; }
  }
"""


def headline_svg(files):
    """Bars of one panel have one linear scale, from 0 to the panel's largest value."""
    file = files["default"]
    true = sum(scene["true_bodies"] for scene in file.rows("scenes"))
    panels = [("Missed pairs of bodies", f"of {count(true)} in {len(file.scenes())} scenes", "wrong",
               count, lambda detector: summed(file, detector, "missed_bodies")),
              ("Spurious pairs of bodies", "reported, but apart", "wrong", count,
               lambda detector: summed(file, detector, "spurious_bodies")),
              ("Time", "ms a frame, mean", "time", three_digits,
               lambda detector: mean_ms(file, detector))]
    names = [headline_name(file, detector) for detector in HEADLINE]
    height = TOP + ROW * len(HEADLINE) + 40
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
           f'width="{WIDTH}" height="{height}" role="img" aria-labelledby="title">',
           f'<title id="title">Missed and spurious pairs of bodies and time of {len(HEADLINE)} '
           'detectors</title>', f"<style>{STYLE}</style>"]

    def text(x, y, words, kind="", end=False):
        out.append(f'<text x="{x}" y="{y}"' + (f' class="{kind}"' if kind else "") +
                   (' text-anchor="end"' if end else "") + f">{html.escape(words)}</text>")

    for k, (title, unit, kind, write, value) in enumerate(panels):
        left = NAMES + k * PANEL
        text(left, 20, title, "title")
        text(left, 38, unit, "small")
        values = [value(detector) for detector in HEADLINE]
        for i, number in enumerate(values):
            y = TOP + i * ROW
            width = BAR * number / (max(values) or 1)
            out.append(f'<rect x="{left}" y="{y}" width="{width:.1f}" height="{ROW - 12}" '
                       f'class="{kind}{" coarse" if names[i][1] else ""}"/>')
            text(f"{left + width + 6:.1f}", y + 14, write(number))
        out.append(f'<line x1="{left}" y1="{TOP - 8}" x2="{left}" '
                   f'y2="{TOP + ROW * len(HEADLINE) - 4}"/>')
    for i, (name, coarse) in enumerate(names):
        text(NAMES - 12, TOP + i * ROW + 14, name + (f" ({coarse})" if coarse else ""), end=True)
    text(NAMES, height - 14, "Pale: reports cells, bodies or vertices near a surface, not triangles",
         "small")
    return "\n".join([*out, "</svg>", ""])
