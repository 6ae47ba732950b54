#!/usr/bin/env python3
"""Runs a case in CalculiX and here and compares the two.

    benches/independent/run.py CASE --velocity V [--flattening X] [--cells 6,9,13]
        [--law LAW] [--reference CSV] [--out DIR]

Writes DIR/independent.csv and prints it as a table. Needs `ccx` in PATH (Debian: calculix-ccx) and the program, built with
`cargo build --release` or named by $IMPACTLAW. Decks are kept in DIR with what CalculiX wrote; what is there is not run again.
"""

import argparse
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# wedge of an axisymmetric model in CalculiX: two degrees
SECTOR = 180.0


def program():
    named = os.environ.get("IMPACTLAW")
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return named or str(target / "release" / "impactlaw")


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


class Deck:
    """What a deck says of itself and what CalculiX made of it, SI units."""

    def __init__(self, path):
        head = " ".join(line[3:].strip() for line in open(path) if line.startswith("** "))
        units = re.search(r"Units: (\w+), (\w+), s", head).groups()
        self.length = {"m": 1.0, "mm": 1e-3, "um": 1e-6}[units[0]]
        self.force_unit = {"N": 1.0, "uN": 1e-6}[units[1]]
        self.radius = float(re.search(r"R = (\S+) m", head).group(1))
        self.density = float(re.search(r"rho = (\S+) kg", head).group(1))
        self.elements = int(re.search(r"Mesh: (\d+) elements", head).group(1))
        self.mass = 4.0 / 3.0 * 3.141592653589793 * self.radius**3 * self.density
        self.axis = self.axis_nodes(path)
        self.read(path.with_suffix(".dat"))

    def axis_nodes(self, path):
        """Heights of nodes over the plane; only those of AXIS are printed."""
        heights, inside = {}, False
        for line in open(path):
            if line.startswith("*"):
                inside = line.startswith("*NODE, NSET=SPHERE")
            elif inside:
                node, _, z = line.split(",")
                heights[int(node)] = float(z) * self.length
        return heights

    def read(self, path):
        times, forces, means, centres = [], [], [], []
        block, axis = None, []
        for line in [*open(path), " total force for set PLANE and time 0"]:
            if "and time" in line:
                if block == "AXIS":
                    centres.append(self.at_centre(axis))
                block = re.search(r"set (\w+) and time", line).group(1)
                axis = []
                if block == "PLANE":
                    times.append(float(line.split()[-1]))
                continue
            words = line.split()
            if not words:
                continue
            if block == "PLANE":
                forces.append(float(words[1]) * SECTOR * self.force_unit)
            elif block == "CENTRE":
                means.append(-float(words[2]) * self.length)
            elif block == "AXIS":
                axis.append((self.axis[int(words[0])], -float(words[2]) * self.length))
        self.times, self.forces, self.centres = times[: len(forces)], forces, centres
        self.means = means

    def at_centre(self, axis):
        """Displacement of the material at the height R, between the two nodes beside it."""
        axis.sort()
        for (a, u), (b, v) in zip(axis, axis[1:]):
            if a <= self.radius <= b:
                return u + (v - u) * (self.radius - a) / (b - a)
        raise ValueError("no node on either side of the centre")


def interpolated(x, xs, ys):
    for (a, u), (b, v) in zip(zip(xs, ys), zip(xs[1:], ys[1:])):
        if min(a, b) <= x <= max(a, b) and a != b:
            return u + (v - u) * (x - a) / (b - a)
    return None


def over_a_ring(x, most, cells, displacements, forces):
    """F(x) of a loading branch to `most` without the steps with which ring after ring of elements comes into contact: the power law
    through the displacements over which the contact grows by two elements, on both sides of `x` where there are such."""
    across = max(cells * math.sqrt(x / most), 4.0)
    low, high = x * (1.0 - 1.0 / across) ** 2, x * (1.0 + 1.0 / across) ** 2
    if high > most:
        low, high = most * (1.0 - 2.0 / across) ** 2, most * (1.0 - 1e-9)
    among = ((d, interpolated(d, displacements, forces)) for d in (low * (high / low) ** (k / 20) for k in range(21)))
    points = [(math.log(d), math.log(f)) for d, f in among if f]
    if len(points) < 15:
        return None  # the curve ends before
    means = [sum(column) / len(points) for column in zip(*points)]
    slope = sum((u - means[0]) * (v - means[1]) for u, v in points) / sum((u - means[0]) ** 2 for u, _ in points)
    return math.exp(means[1] + slope * (math.log(x) - means[0]))


def lost(displacements, forces):
    """Displacement at which the force of an unloading branch is gone: it goes with the power 3/2 of what is left."""
    most = max(forces)
    for k, force in enumerate(forces):
        if k > forces.index(most) and force < 0.02 * most:
            (a, b), (f, g) = displacements[k - 1 : k + 1], forces[k - 1 : k + 1]
            f, g = f ** (2 / 3), max(g, 0.0) ** (2 / 3)
            return b if g == 0.0 and f == 0.0 else b + (b - a) * g / (f - g) if g > 0.0 else b
    return None


def branches(displacements, forces):
    top = max(range(len(displacements)), key=lambda k: displacements[k])
    load = ([0.0, *displacements[: top + 1]], [0.0, *forces[: top + 1]])
    return load, (displacements[top:], forces[top:])


def calculix(deck):
    if not deck.with_suffix(".done").exists():
        threads = os.environ.get("OMP_NUM_THREADS", "1")
        run(["ccx", "-i", deck.stem], cwd=deck.parent, env={**os.environ, "OMP_NUM_THREADS": threads})
        deck.with_suffix(".done").write_text("")
    return Deck(deck)


def ours(case, velocity, out):
    """Summary and curve of an impact of ours."""
    folder = out / f"impactlaw_V{velocity}"
    if not list(folder.glob("*/summary.json")):
        run([program(), "impact", case, "--velocity", f"{velocity} m/s", "--out", folder])
    (summary,) = folder.glob("*/summary.json")
    lines = [line for line in open(summary.parent / "curve.csv") if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    column = lambda name: [float(row[name]) for row in rows]
    names = ["time_s", "displacement_m", "centre_displacement_m", "force_N"]
    return json.load(open(summary)), [column(name) for name in names]


def at_rest(law, radius, most):
    """Loading curve of a law up to a displacement, and what is left of that, over it."""
    steps = range(201)

    def forces(displacements, *more):
        texts = [f"{d!r} m" for d in displacements]
        said = run([program(), "-q", "law", "eval", law, "--body", f"{radius!r} m", "--displacements", *texts, *more])
        return [float(row["force_N"]) for row in csv.DictReader(said.splitlines())]

    load = [most * k / 200 for k in steps]
    back = [most * (1 - 0.3 * k / 200) for k in steps]
    branch = forces(back, "--max-displacement", f"{most!r} m")
    return (load, [0.0, *forces(load[1:])]), lost(back, branch) / most


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path)
    parser.add_argument("--flattening", type=float, default=0.1, help="over R")
    parser.add_argument("--velocity", type=float, required=True, help="of our impact, m/s: as fast as reaches the flattening")
    parser.add_argument("--cells", default="6,9,13", help="elements of a contact radius")
    parser.add_argument("--law", type=Path, help="law file of the case: its force at rest, without inertia")
    parser.add_argument("--reference", type=Path, help="slow F(delta) of the centre: displacement over R, force in N and, where it is let go, load or unload")
    parser.add_argument("--out", type=Path, default=Path("out/independent"))
    args = parser.parse_args()
    if not shutil.which("ccx"):
        sys.exit("ccx is not in PATH: apt-get install calculix-ccx")
    rows = []

    def say(deck, cells, what, value, other, beside):
        off = 100.0 * (value / other - 1.0) if value and other else ""
        rows.append([cells, deck.elements, what, value, other, off, beside])

    summary, (_, delta, centre, force) = ours(args.case, args.velocity, args.out)
    last = max(k for k, f in enumerate(force) if f > 0.0)
    radius = summary["particle"]["radius_m"]
    # an impact that goes on is let go elsewhere: another residual
    there = abs(summary["max_displacement_m"] / (args.flattening * radius) - 1.0) < 0.02
    compared = [(f"impact here at {args.velocity:g} m/s", name, branches(own, force)[0], residual / most if there else None)
                for name, own, residual, most in (
                    ("centre of mass", delta, summary["residual_displacement_m"], summary["max_displacement_m"]),
                    ("centre", centre, centre[last], max(centre)))]
    if args.law:
        compared.append(("law at rest", "centre of mass", *at_rest(args.law, radius, args.flattening * radius)))
    if args.reference:
        # lines before the names of the columns are remarks; without a phase all is loading
        table = [line.strip().split(",") for line in open(args.reference)]
        table = [row for row in table if row[0].replace(".", "", 1).isdigit()]
        pick = lambda phase: [[float(r[k]) * unit for r in table if ([*r, "load"][2]).strip() == phase] for k, unit in ((0, radius), (1, 1.0))]
        unload = pick("unload")
        for name in ("centre of mass", "centre"):
            compared.append((args.reference.name, name, pick("load"), lost(*unload) / unload[0][0] if unload[0] else None))
    for cells in args.cells.split(","):
        folder = args.out / f"cells_{cells}"
        run([program(), "export", args.case, "--to", "calculix", "--flattening", args.flattening, "--cells", cells, "--out", folder])
        (written,) = (folder / "calculix").glob("*.inp")
        deck = calculix(written)
        own = {"centre of mass": deck.means, "centre": deck.centres}
        for beside, name, other, residual in compared:
            load, back = branches(own[name], deck.forces)
            most = max(own[name])
            for share in (0.1, 0.2, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0):
                x = share * args.flattening * deck.radius
                what = f"F at {name}/R {share * args.flattening:g}"
                say(deck, cells, f"{what}, N", interpolated(x * (1 - 1e-9), *load), interpolated(x, *other), beside)
                say(deck, cells, f"{what} over a ring, N", *(over_a_ring(x, most, float(cells), *curve) for curve in (load, other)), beside)
            if residual is None:
                continue
            say(deck, cells, f"residual of {name} over its largest", lost(*back) / max(own[name]), residual, beside)
    header = ["cells", "elements", "quantity", "calculix", "other", "difference_percent", "other_is"]
    args.out.mkdir(parents=True, exist_ok=True)
    with open(args.out / "independent.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)
    number = lambda x: f"{x:.5g}" if isinstance(x, float) else str(x)
    for row in [header, *rows]:
        print("  ".join(number(x).ljust(w) for x, w in zip(row, (6, 9, 44, 12, 12, 19, 10))))


if __name__ == "__main__":
    main()
