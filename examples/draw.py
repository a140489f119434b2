#!/usr/bin/env python3
"""Draws a motion as one picture, later poses darker: an SVG on standard output.

    spacetime-optimizer solve throw.problem.json --samples 20 > throw.motion.json
    python3 examples/draw.py throw.motion.json 0,arm.upper,arm.fore,arm.palm ball.slideY > throw.svg

Each argument after the motion is a chain of sampled points joined by lines (0 is the origin), or a single point, whose
path is drawn.  x points right, y up.  Standard library only.
"""
import json
import sys

COLOURS = ["#1f5f8b", "#c8553d", "#5b8c5a", "#7a5c99"]
WIDTH, MARGIN = 720, 24


def point(samples, name, k):
    return (0.0, 0.0) if name == "0" else tuple(samples["values"][name][k][:2])


def main(path, *chains):
    with open(path, encoding="utf-8") as file:
        motion = json.load(file)
    samples = motion.get("samples")
    if not samples:
        sys.exit("the motion has no samples: solve with --samples 20")
    unknown = [n for c in chains for n in c.split(",") if n != "0" and n not in samples["values"]]
    if unknown or not chains:
        sys.exit(f"no such point: {', '.join(unknown) or '(none given)'}; there are {', '.join(samples['values'])}")

    frames = range(len(samples["times"]))
    points = [point(samples, n, k) for c in chains for n in c.split(",") for k in frames]
    low = [min(p[i] for p in points) for i in (0, 1)]
    high = [max(p[i] for p in points) for i in (0, 1)]
    scale = (WIDTH - 2 * MARGIN) / max(high[0] - low[0], (high[1] - low[1]) * 1.2, 1e-9)
    height = 2 * MARGIN + scale * (high[1] - low[1])

    def place(p):
        return f"{MARGIN + scale * (p[0] - low[0]):.1f},{height - MARGIN - scale * (p[1] - low[1]):.1f}"

    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:.0f}" width="{WIDTH}">')
    print('<rect width="100%" height="100%" fill="#fbfaf7"/>')
    for chain, colour in zip(chains, COLOURS * len(chains)):
        names = chain.split(",")
        style = f'fill="none" stroke="{colour}" stroke-linecap="round" stroke-linejoin="round"'
        tip = " ".join(place(point(samples, names[-1], k)) for k in frames)
        print(f'<polyline points="{tip}" {style} stroke-width="1.2" stroke-dasharray="1 4"/>')
        for k in frames:
            opacity = 0.12 + 0.75 * (k / max(frames[-1], 1)) ** 1.5
            corners = [place(point(samples, n, k)) for n in names]
            if len(corners) > 1:
                print(f'<polyline points="{" ".join(corners)}" {style} stroke-width="2.5" opacity="{opacity:.2f}"/>')
            else:
                x, y = corners[0].split(",")
                print(f'<circle cx="{x}" cy="{y}" r="4" fill="{colour}" opacity="{opacity:.2f}"/>')
    print("</svg>")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
