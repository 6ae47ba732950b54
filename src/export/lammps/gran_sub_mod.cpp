@HEADER@
// Granular sub-model `@NAME@`; see gran_sub_mod_@NAME@.h.
#include "gran_sub_mod_@NAME@.h"

#include "atom.h"
#include "error.h"
#include "granular_model.h"
#include "@NAME@.h"

using namespace LAMMPS_NS;
using namespace Granular_NS;

// Rows of the history: largest flattening, its force, residual, exponent of each side in the order of the grains'
// numbers, and the first one's share of the overlap.
enum { SIDE = 4, SHARE = 8, SIZE = 9 };

GranSubModNormal@CLASS@::GranSubModNormal@CLASS@(GranularModel *gm, LAMMPS *lmp) : GranSubModNormal(gm, lmp)
{
  num_coeffs = 1;
  material_properties = 1;
  cohesive_flag = 0;
  contact_radius_flag = 1;
  size_history = SIZE;
  // Nothing of this changes its sign with the order of the grains.
  nondefault_history_transfer = 1;
  transfer_history_factor = new double[SIZE];
  for (int k = 0; k < SIZE; k++) transfer_history_factor[k] = 1.0;
}

void GranSubModNormal@CLASS@::coeffs_to_local()
{
  Emod = @YOUNG@;
  poiss = @POISSON@;
  damp = coeffs[0];
  if (damp < 0.0) error->all(FLERR, "granular model @NAME@: the damping coefficient must not be negative");
}

double GranSubModNormal@CLASS@::calculate_forces()
{
  double *const history = &gm->history[history_index];
  law_side first = {history[0], history[1], history[2], history[3]};
  law_side second = {history[SIDE], history[SIDE + 1], history[SIDE + 2], history[SIDE + 3]};
  double share = history[SHARE];
  law_pressed p;
  if (gm->contact_type == PAIR) {
    const bool in_order = atom->tag[gm->i] < atom->tag[gm->j];
    p = law_pair(gm->delta, in_order ? gm->radi : gm->radj, in_order ? gm->radj : gm->radi, &first, &second, &share);
  } else {
    p = law_wall(gm->delta, gm->radi, &first);
  }
  if (gm->history_update) {
    const law_side sides[2] = {first, second};
    for (int k = 0; k < 2; k++) {
      history[k * SIDE] = sides[k].x_max;
      history[k * SIDE + 1] = sides[k].phi_max;
      history[k * SIDE + 2] = sides[k].x_res;
      history[k * SIDE + 3] = sides[k].n;
    }
    history[SHARE] = share;
  }
  return p.force;
}
