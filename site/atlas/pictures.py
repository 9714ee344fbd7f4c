"""Pictures: that of `verify draw`, and its places for pictures of steps."""

import re
from html import escape

# Colours of bodies: those of `verify draw`, which are apart for colour-blind eyes as well.
COLOURS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377"]
GREY = "#b8bcc4"


def places(picture):
    """Where `verify draw` has put the nodes."""
    found = re.findall(r'<g data-node="(\d+)" transform="translate\(([-0-9.]+) ([-0-9.]+)\)">', picture)
    return {int(v): (float(x), float(y)) for v, x, y in found}


def inline(picture, words):
    """The picture inside a page: without its own background and legend, read out as `words`."""
    where = places(picture)
    xs, ys = zip(*where.values())
    shift = re.search(r'<g transform="translate\(([-0-9.]+) ([-0-9.]+)\)">\n<path', picture)
    dx, dy = (float(x) for x in shift.groups()) if shift else (0, 0)
    margin = 26
    box = (min(xs) + dx - margin, min(ys) + dy - margin, max(xs) - min(xs) + 2 * margin, max(ys) - min(ys) + 2 * margin)
    body = re.sub(r"^<svg[^>]*>\n<title>.*?</title>\n<rect[^>]*/>\n", "", picture, flags=re.S)
    body = body.replace("</svg>", "").strip()
    # The legend below is said by the page in words.
    body = re.sub(r'(?s)(</g>)\n<g transform="translate\([-0-9. ]+\)"><circle.*$', r"\1", body)
    view = " ".join(f"{x:.1f}" for x in box)
    return f'<svg class="graph" role="img" aria-label="{escape(words)}" viewBox="{view}" xmlns="http://www.w3.org/2000/svg">\n{body}\n</svg>'


def step(where, pairs, colour_of, ring=(), words=""):
    """A small picture: pairs in the colour of their body, loose ones grey; the nodes of `ring` stand out."""
    xs, ys = zip(*where.values())
    width, height = max(xs) - min(xs) or 1, max(ys) - min(ys) or 1
    scale = 170 / max(width, height)
    at = {v: (round((x - min(xs)) * scale + 14, 1), round((y - min(ys)) * scale + 14, 1)) for v, (x, y) in where.items()}
    lines, circles = [], []
    for i, j in pairs:
        colour = colour_of.get((i, j), GREY)
        lines.append(f'<line x1="{at[i][0]}" y1="{at[i][1]}" x2="{at[j][0]}" y2="{at[j][1]}" stroke="{colour}" stroke-width="{2 if colour == GREY else 4}"/>')
    inside = {v: colour_of[pair] for pair in pairs if pair in colour_of for v in pair}
    for v, (x, y) in at.items():
        extra = ' stroke="#222" stroke-width="2"' if v in ring else ' stroke="#fff"'
        circles.append(f'<circle cx="{x}" cy="{y}" r="6" fill="{inside.get(v, GREY)}"{extra}/><text x="{x}" y="{y}" class="number">{v}</text>')
    size = f"{width * scale + 28:.0f} {height * scale + 28:.0f}"
    return f'<svg class="step" role="img" aria-label="{escape(words)}" viewBox="0 0 {size}">{"".join(lines + circles)}</svg>'
