#!/usr/bin/env bash
# Makes the pictures of the chapter "Gallery" anew, with a built program:
#
#     src/guide/gallery.sh target/release/impactlaw
set -euo pipefail
program="$(realpath "$1")"
root="$(cd "$(dirname "$0")/../.." && pwd)"
pictures="$root/src/guide/gallery"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$pictures"
cd "$scratch"
"$program" -q run "$root/cases/thesis-4-4.toml" --no-bed --out steel
for plot in force_displacement_V50 restitution von_mises_V50 plastic_strain_V50; do
    cp "steel/plots/$plot.svg" "$pictures/"
done
"$program" -q init scene --like mixture
"$program" -q bed mixture.toml --out mixture
cp mixture/bed/bed.png "$pictures/mixture.png"
ls "$pictures"
