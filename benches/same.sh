#!/usr/bin/env bash
# Results of two builds, byte by byte: shipped cases, scenes and exports, times apart.
#
#     benches/same.sh OLD NEW [FOLDER]     # OLD, NEW: programs; FOLDER: where their results go, kept for a second look
#
# Runs what is not there yet, so that OLD is run once for many NEW (name its folder by hand: FOLDER/old). Exit code 1
# where a file differs or is missing. SCENES="bed-peen" and CASES="" choose less.
set -uo pipefail
root="$(cd "$(dirname "$0")/.." && pwd)"
old="$(realpath "$1")" new="$(realpath "$2")"
folder="$(mkdir -p "${3:-same}" && cd "${3:-same}" && pwd)"
read -ra cases <<<"${CASES-thesis-4-4 solder-ball}"
read -ra scenes <<<"${SCENES-bed-oedometer bed-peen bed-repose bed-drum bed-impact bed-hopper}"

# All that one program writes, below the present folder; the same words on each command line.
results() { # program
    ln -sfn "$root/cases" cases
    ln -sfn "$root/models" models
    local name target
    for name in "${cases[@]}"; do "$1" -q run "cases/$name.toml" --out "$name" || echo "$name: exit $?" >>failed; done
    for name in "${scenes[@]}"; do "$1" -q bed "cases/$name.toml" --out "$name" || echo "$name: exit $?" >>failed; done
    for name in models/*.toml; do
        for target in c liggghts lammps table native deme mercurydpm; do
            "$1" -q export "$name" --to "$target" --out "export/$(basename "$name" .toml)/$target" || echo "$name $target: exit $?" >>failed
        done
    done
}

# Content of a file without what no two runs share: seconds and speeds.
without_times() { # file
    sed -E -e 's/"(wall_s|particle_steps_per_s)": [^,]*//' -e 's/[0-9.e+-]+ (s|seconds|particle-steps\/s)\b//g' "$1"
}

for side in old new; do
    [ -f "$folder/$side/done" ] && continue
    rm -rf "${folder:?}/$side"
    mkdir -p "$folder/$side"
    (cd "$folder/$side" && results "${!side}" >log 2>&1 && touch done)
done

different=0
while read -r file; do
    case "$file" in ./done | ./log) continue ;; esac
    if ! cmp -s "$folder/old/$file" "$folder/new/$file" &&
        ! cmp -s <(without_times "$folder/old/$file" 2>/dev/null) <(without_times "$folder/new/$file" 2>/dev/null); then
        echo "differs: $file"
        different=1
    fi
done < <(cd "$folder" && { (cd old && find . -type f) && (cd new && find . -type f); } | sort -u)
[ "$different" = 0 ] && echo "same bytes: $(find "$folder/old" -type f | wc -l) files"
exit "$different"
