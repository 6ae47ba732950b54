#!/usr/bin/env python3
"""GATv2 (Brody, Alon and Yahav 2022) on a graph of the runs of a study, as a baseline beside the equations of `discover`.

    python3 cases/discover/gatv2.py out/study-480/results.csv out/study-480/discover --where-severity 3.2

Needs numpy and jax (pip install numpy "jax[cpu]"). Reads groups, figures and scales from equations.toml, takes the same distinct
runs, leaves the same levels and materials out, and adds its rows to discover.csv. Runs that are left out are nodes of the graph
without a target: their figures are not seen. Each node is joined with its eight nearest in the logarithms of the groups.
"""
import argparse
import csv
import math
import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np

NEIGHBOURS, HEADS, WIDTH, EPOCHS, RATE = 8, 4, 16, 600, 5e-3


def rows_of(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def product(row, columns, exponents):
    return math.prod(float(row[name]) ** x for name, x in zip(columns, exponents))


def layer(p, x, edges):
    """One GATv2 layer: e_ij = a . leaky_relu(W_l x_i + W_r x_j), softmax over the neighbours j of i; heads side by side."""
    left = (x @ p["left"]).reshape(x.shape[0], HEADS, WIDTH)
    right = (x @ p["right"]).reshape(x.shape[0], HEADS, WIDTH)
    pair = jax.nn.leaky_relu(left[:, None] + right[edges], 0.2)  # node, neighbour, head, width
    weight = jax.nn.softmax((pair * p["a"]).sum(-1), axis=1)
    mixed = (weight[..., None] * right[edges]).sum(1)
    return jax.nn.elu(mixed.reshape(x.shape[0], -1) + x @ p["skip"])


def network(p, x, edges):
    return (layer(p["two"], layer(p["one"], x, edges), edges) @ p["out"])[:, 0] + p["bias"]


def start(key, inputs):
    def normal(key, *shape):
        return jax.random.normal(key, shape) / math.sqrt(shape[0])

    keys = jax.random.split(key, 9)
    wide = HEADS * WIDTH

    def one(keys, n):
        return {"left": normal(keys[0], n, wide), "right": normal(keys[1], n, wide), "skip": normal(keys[2], n, wide),
                "a": jax.random.normal(keys[3], (HEADS, WIDTH)) / math.sqrt(WIDTH)}

    return {"one": one(keys[:4], inputs), "two": one(keys[4:8], wide), "out": normal(keys[8], wide, 1), "bias": jnp.zeros(())}


@jax.jit
def train(p, x, edges, y, mask):
    """Adam with a falling rate on the nodes of the mask."""
    def loss(p):
        return (mask * (network(p, x, edges) - y) ** 2).sum() / mask.sum()

    def step(state, i):
        p, m, v = state
        g = jax.grad(loss)(p)
        m = jax.tree.map(lambda m, g: 0.9 * m + 0.1 * g, m, g)
        v = jax.tree.map(lambda v, g: 0.999 * v + 0.001 * g * g, v, g)
        rate = RATE * 0.5 * (1 + jnp.cos(math.pi * i / EPOCHS))
        new = jax.tree.map(lambda p, m, v: p - rate * (m / (1 - 0.9 ** (i + 1))) / (jnp.sqrt(v / (1 - 0.999 ** (i + 1))) + 1e-8), p, m, v)
        return (new, m, v), None

    zero = jax.tree.map(jnp.zeros_like, p)
    (p, _, _), _ = jax.lax.scan(step, (p, zero, zero), jnp.arange(EPOCHS))
    return network(p, x, edges)


def score(predicted, y, counts):
    p, t = np.repeat(predicted, counts), np.repeat(y, counts)
    error, relative = np.abs(p - t), np.sort(np.abs((p - t) / t))
    at = lambda share: relative[round((len(relative) - 1) * share)]
    return error.mean(), 1 - (error**2).sum() / ((t - t.mean()) ** 2).sum(), at(0.5), at(0.9)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("results", type=Path)
    arguments.add_argument("discover", type=Path, help="folder with equations.toml and discover.csv")
    arguments.add_argument("--where-severity", type=float, default=math.inf, help="largest rho V^2/Y, as in --where")
    arguments.add_argument("--folds", type=int, default=12, help="materials are left out in so many parts")
    given = arguments.parse_args()
    file = tomllib.loads((given.discover / "equations.toml").read_text())
    groups = file["group"]

    runs, materials = {}, {}
    for row in rows_of(given.results):
        if row["status"] != "ok":
            continue
        value = lambda name: float(row[name])
        severity = value("density_kg_m3") * value("velocity_m_s") ** 2 / value("yield_strength_Pa")
        star = value("young_modulus_Pa") / (1 - value("poisson_ratio") ** 2)
        # first yield: Johnson 1985 with a peak pressure of 1.6 Y, rho V_y^2/Y = 25.5 (Y/E*)^4
        limit = 1.56052**2 * 1.6**5 * (value("yield_strength_Pa") / star) ** 4
        if severity <= limit or severity > given.where_severity * (1 + 1e-10):
            continue
        key = tuple(f"{product(row, g['columns'], g['exponents']):.8e}" for g in groups)
        runs.setdefault(key, []).append(row)
        name = tuple(row[n] for n in ("density_kg_m3", "young_modulus_Pa", "yield_strength_Pa", "poisson_ratio", "radius_m"))
        materials.setdefault(name, set()).add(key)
    keys = list(runs)
    counts = np.array([len(runs[k]) for k in keys])
    cases = int(counts.sum())
    assert cases == file["provenance"]["cases"], f"{cases} cases here, {file['provenance']['cases']} in equations.toml"
    logs = np.log(np.array(keys, dtype=float))
    x = (logs - logs.mean(0)) / logs.std(0)
    distance = ((x[:, None] - x[None]) ** 2).sum(-1)
    edges = jnp.array(np.argsort(distance, axis=1, kind="stable")[:, : NEIGHBOURS + 1])  # itself among them
    slow = [j for j, g in enumerate(groups) if "velocity_m_s" not in g["columns"]]
    level_of = [tuple(k[j] for j in slow) for k in keys]
    levels = [np.array([l == level for l in level_of]) for level in sorted(set(level_of))]
    parts = [set() for _ in range(given.folds)]
    for i, name in enumerate(sorted(materials)):
        parts[i % given.folds] |= materials[name]
    parts = [np.array([k in part for k in keys]) for part in parts]

    table = given.discover / "discover.csv"
    head = [line for line in table.read_text().splitlines() if not line.startswith("#")][0].split(",")
    lines = [line for line in table.read_text().splitlines() if ",GATv2," not in line]
    for name in dict.fromkeys(e["figure"] for e in file["equation"]):
        scale = next(e for e in file["equation"] if e["figure"] == name)
        y = np.array([float(runs[k][0][name]) / product(runs[k][0], scale["scale_columns"], scale["scale_exponents"]) for k in keys])
        logarithm = bool(scale["scale_columns"])  # as the Gaussian process: what has a unit by its logarithm
        z = np.log(y) if logarithm else y
        shift, spread = z.mean(), z.std()

        def predict(mask):
            p = start(jax.random.PRNGKey(1), x.shape[1])
            out = train(p, jnp.array(x), edges, jnp.array(((z - shift) / spread) * mask), jnp.array(mask.astype(float)))
            out = np.array(out) * spread + shift
            return np.exp(out) if logarithm else out

        def left_out(splits):
            total, times = np.zeros(len(y)), np.zeros(len(y))
            for out in splits:
                total[out] += predict(~out)[out]
                times[out] += 1
            return total / times

        scores = [score(p, y, counts) for p in (predict(np.ones(len(y), bool)), left_out(levels), left_out(parts))]
        values = dict(zip(head, [name, "GATv2", "", "false", "", ""] + [f"{v:.6g}" for s in scores for v in s]))
        lines.append(",".join(values[h] for h in head))
        print(name, "MAE, R2, median, p90:", *("  ".join(f"{v:.4g}" for v in s) for s in scores), sep=" | ")
    table.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
