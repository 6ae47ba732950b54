#!/bin/sh
# Builds the law `@NAME@` as a shared library for a LIGGGHTS that is already installed; nothing of LIGGGHTS is built.
#
#     sh build.sh LIGGGHTS_SRC [COMPILER]        LIGGGHTS_SRC: folder `src` of the source the program was built from
#     LD_PRELOAD=./liblaw_liggghts.so liggghts -in in.script
#
# Debian: program `apt install liggghts libopenmpi-dev openmpi-bin g++`, source `apt-get source --download-only liggghts`.
# The compiler must be the MPI wrapper of the MPI the program uses (Debian: OpenMPI's mpicxx).
# Licence: LIGGGHTS is under the GPL (version 2 or later), so a library built with its headers may only be passed on under it.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
src=$(cd "${1:?usage: build.sh LIGGGHTS_SRC [COMPILER]}" && pwd)
compiler=${2:-${MPICXX:-mpicxx}}
[ -f "$src/normal_model_base.h" ] || { echo "$src is not LIGGGHTS' src folder" >&2; exit 2; }
lists=$(mktemp -d)
trap 'rm -rf "$lists"' EXIT

# The lists of models LIGGGHTS' own build makes, with this law in them.
for kind in surface normal tangential cohesion rolling; do
    upper=$(echo "$kind" | tr '[:lower:]' '[:upper:]')
    for header in $(cd "$src" && grep -l "^ *${upper}_MODEL(" "${kind}_model_"*.h); do
        echo "#include \"$header\""
    done >"$lists/style_${kind}_model.h"
done
echo '#include "normal_model_@NAME@.h"' >>"$lists/style_normal_model.h"
echo '#include "tangential_model_@NAME@.h"' >>"$lists/style_tangential_model.h"
: >"$lists/style_contact_model.h"

# C++98: later standards find fault with a line of LIGGGHTS' utils.h.
exec "$compiler" -std=gnu++98 -O2 -fPIC -shared -w \
    -I"$lists" -I"$here" -I"$src" "$here/law_liggghts.cpp" -o "$here/liblaw_liggghts.so"
