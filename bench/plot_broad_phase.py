#!/usr/bin/env python3
"""Draws docs/figures/broad_phase.svg from the JSON of bench_broad_phase: time per body against n, one panel a scene.

usage: plot_broad_phase.py RUN.json ... broad_phase.svg      (a later run replaces the points of an earlier one)
"""

import json
import math
import sys

PANEL_W, PANEL_H, LEFT, TOP, GAP_X, GAP_Y = 380, 250, 64, 84, 70, 74
X_DECADES, Y_DECADES = (2, 6), (1, 5)  # bodies; nanoseconds per body
COLOURS = {  # Okabe and Ito's palette; all of them are seen on white and on black
    "brute force": "#999999", "sweep and prune": "#cc79a7", "uniform grid": "#d55e00", "octree": "#009e73",
    "kd-tree": "#0072b2", "BSP tree": "#56b4e9", "Bullet DBVT": "#b8860b"}
STYLE = """<style>text{font:13px sans-serif;fill:#24292f}.t{font-weight:bold}.a{stroke:#24292f;fill:none}
.g{stroke:#888;stroke-opacity:.3}@media (prefers-color-scheme:dark){text{fill:#e6edf3}.a{stroke:#e6edf3}.b{fill:#0d1117}}</style>"""


def read(paths):
    """{scene: {method: [(n, ns per body)]}}; medians where a run was repeated."""
    curves = {}
    for run in [run for path in paths for run in json.load(open(path))["benchmarks"]]:
        if run.get("error_occurred") or run.get("aggregate_name", "median") != "median" or "s_per_body" not in run:
            continue
        scene, method, n = run["run_name"].split("/")[:3]
        if method in COLOURS:
            curves.setdefault(scene, {}).setdefault(method, {})[int(n)] = run["s_per_body"] * 1e9
    return {s: {m: sorted(points.items()) for m, points in c.items()} for s, c in curves.items() if "coherent" not in s}


def panel(x0, y0, title, curves):
    def x(n):
        return x0 + PANEL_W * (math.log10(n) - X_DECADES[0]) / (X_DECADES[1] - X_DECADES[0])

    def y(ns):
        return y0 + PANEL_H * (1 - (math.log10(ns) - Y_DECADES[0]) / (Y_DECADES[1] - Y_DECADES[0]))

    out = [f'<text class="t" x="{x0}" y="{y0 - 9}">{title}</text>']
    for d in range(X_DECADES[0], X_DECADES[1] + 1):
        out.append(f'<path class="g" d="M{x(10**d):.0f} {y0}v{PANEL_H}"/><text x="{x(10**d):.0f}" y="{y0 + PANEL_H + 18}" '
                   f'text-anchor="middle">10<tspan dy="-5" font-size="9">{d}</tspan></text>')
    for d in range(Y_DECADES[0], Y_DECADES[1] + 1):
        out.append(f'<path class="g" d="M{x0} {y(10**d):.0f}h{PANEL_W}"/><text x="{x0 - 8}" y="{y(10**d) + 4:.0f}" '
                   f'text-anchor="end">10<tspan dy="-5" font-size="9">{d}</tspan></text>')
    out.append(f'<rect class="a" x="{x0}" y="{y0}" width="{PANEL_W}" height="{PANEL_H}"/>')
    for method, colour in COLOURS.items():
        points = [(x(n), y(min(max(ns, 10**Y_DECADES[0]), 10**Y_DECADES[1]))) for n, ns in curves.get(method, [])]
        dash = ' stroke-dasharray="6 4"' if method.startswith("Bullet") else ""
        path = " ".join(f"{px:.1f},{py:.1f}" for px, py in points)
        out.append(f'<polyline fill="none" stroke="{colour}" stroke-width="2"{dash} points="{path}"/>')
        out += [f'<circle fill="{colour}" cx="{px:.1f}" cy="{py:.1f}" r="2.6"/>' for px, py in points]
    return out


def main(sources, target):
    scenes = read(sources)
    width, height = LEFT + 2 * PANEL_W + GAP_X + 20, TOP + 2 * PANEL_H + GAP_Y + 54
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">',
           STYLE, f'<rect class="b" width="{width}" height="{height}" fill="#fff"/>']
    left = LEFT
    for method, colour in COLOURS.items():
        dash = ' stroke-dasharray="6 4"' if method.startswith("Bullet") else ""
        out.append(f'<path stroke="{colour}" stroke-width="3"{dash} d="M{left} 22h18"/>'
                   f'<text x="{left + 23}" y="26">{method}</text>')
        left += 52 + 7.2 * len(method)
    for k, (scene, curves) in enumerate(scenes.items()):
        out += panel(LEFT + (k % 2) * (PANEL_W + GAP_X), TOP + (k // 2) * (PANEL_H + GAP_Y), scene, curves)
    middle = LEFT + PANEL_W + GAP_X / 2
    out.append(f'<text x="{middle}" y="{height - 12}" text-anchor="middle">number of bodies n</text>')
    out.append(f'<text x="{LEFT - 44}" y="{TOP - 30}">time per body [ns], one call from scratch, one thread</text></svg>')
    open(target, "w").write("\n".join(out) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1:-1], sys.argv[-1])
