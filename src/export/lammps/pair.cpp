@HEADER@
// Pair style `@NAME@`; see law_lammps.h.
#include "law_lammps.h"

#include <cmath>
#include <cstring>
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

using namespace LAMMPS_NS;

int law_rows::effect(LAMMPS *lmp, const char *style, int iarg, int narg, char **arg, law_effects &effects)
{
  const std::string key = arg[iarg];
  if (key != "friction" && key != "rolling" && key != "restitution") return 0;
  if (iarg + 2 > narg) lmp->error->all(FLERR, "{}: {} needs a value", style, key);
  const double value = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
  if (key == "restitution") {
    if (!(value > 0.0 && value <= 1.0)) lmp->error->all(FLERR, "{}: restitution {} must lie in (0, 1]", style, value);
    effects.damping = law_damping_ratio(value);
  } else {
    if (!(value >= 0.0)) lmp->error->all(FLERR, "{}: {} {} must not be negative", style, key, value);
    (key == "friction" ? effects.friction : effects.rolling) = value;
  }
  return 2;
}

Pair@CLASS@::Pair@CLASS@(LAMMPS *lmp) : Pair(lmp), effects{0.0, 0.0, 0.0}, largest(0.0), history(nullptr)
{
  single_enable = 0;
  restartinfo = 0;
  one_coeff = 1;
  finitecutflag = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  nextra = 1;
  pvector = new double[1];
}

Pair@CLASS@::~Pair@CLASS@()
{
  if (copymode) return;
  delete[] pvector;
  if (history) modify->delete_fix("law_history");
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

void Pair@CLASS@::settings(int narg, char **arg)
{
  int iarg = 0;
  while (iarg < narg) {
    const int taken = law_rows::effect(lmp, "pair_style @NAME@", iarg, narg, arg, effects);
    if (!taken)
      error->all(FLERR, "pair_style @NAME@: found {}, allowed are friction, rolling, restitution", arg[iarg]);
    iarg += taken;
  }
}

void Pair@CLASS@::coeff(int narg, char **)
{
  if (narg != 2) error->all(FLERR, "pair_coeff of @NAME@ takes types only (* *): the law has its constants in it");
  const int n = atom->ntypes;
  if (!allocated) {
    memory->create(setflag, n + 1, n + 1, "pair:setflag");
    memory->create(cutsq, n + 1, n + 1, "pair:cutsq");
    allocated = 1;
  }
  for (int i = 1; i <= n; i++)
    for (int j = 1; j <= n; j++) setflag[i][j] = 1;
}

void Pair@CLASS@::init_style()
{
  if (strcmp(update->unit_style, "si") != 0) error->all(FLERR, "pair_style @NAME@ is a law in SI units: use 'units si'");
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag || !atom->tag_enable)
    error->all(FLERR, "pair_style @NAME@ needs grains with radius, mass and spin: atom_style sphere");
  if (comm->ghost_velocity == 0) error->all(FLERR, "pair_style @NAME@ needs 'comm_modify vel yes'");
  neighbor->add_request(this, NeighConst::REQ_SIZE);
  if (!history) {
    history = dynamic_cast<Fix@CLASS@History *>(modify->add_fix("law_history all @NAME@/history"));
    if (!history) error->all(FLERR, "pair_style @NAME@ could not make its history");
    history->pair = this;
  }
  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->radius[i] > mine) mine = atom->radius[i];
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (largest <= 0.0) error->all(FLERR, "pair_style @NAME@: no grain has a radius yet");
}

double Pair@CLASS@::init_one(int, int)
{
  return 2.0 * largest;
}

// The contact of two overlapping grains, the one of the lower number first, so that no history has to change its sign.
law_push Pair@CLASS@::meet(int a, int b, double distance, double *row) const
{
  double *const *const x = atom->x, *const *const v = atom->v, *const *const w = atom->omega;
  law_meeting m;
  for (int k = 0; k < 3; k++) {
    m.normal[k] = (x[a][k] - x[b][k]) / distance;
    m.velocity[k] = v[a][k] - v[b][k];
    m.spins[0][k] = w[a][k];
    m.spins[1][k] = w[b][k];
  }
  m.radii[0] = atom->radius[a];
  m.radii[1] = atom->radius[b];
  m.mass = atom->rmass[a] * atom->rmass[b] / (atom->rmass[a] + atom->rmass[b]);
  m.dt = update->dt;
  law_side first = law_rows::side(row + law_rows::SIDE_1), second = law_rows::side(row + law_rows::SIDE_2);
  law_dashpot dashpot = law_rows::dashpot(row + law_rows::DASHPOT);
  law_slider spring = law_rows::slider(row + law_rows::SPRING), roller = law_rows::slider(row + law_rows::ROLLER);
  double share = row[law_rows::SHARE];
  const double overlap = m.radii[0] + m.radii[1] - distance;
  const law_pressed p = law_pair(overlap, m.radii[0], m.radii[1], &first, &second, &share);
  const law_push push = law_meet(&effects, &m, &p, &dashpot, &spring, &roller);
  if (!update->setupflag) {
    law_rows::keep(row + law_rows::SIDE_1, first);
    law_rows::keep(row + law_rows::SIDE_2, second);
    row[law_rows::SHARE] = share;
    law_rows::keep(row + law_rows::SPRING, spring);
    law_rows::keep(row + law_rows::ROLLER, roller);
    law_rows::keep(row + law_rows::DASHPOT, dashpot);
  }
  return push;
}

void Pair@CLASS@::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  double **x = atom->x, **f = atom->f, **torque = atom->torque;
  const double *radius = atom->radius;
  const int nlocal = atom->nlocal, newton_pair = force->newton_pair;
  pvector[0] = 0.0;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const double del[3] = {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
      const double square = law_dot(del, del), reach = radius[i] + radius[j];
      char &touching = history->touching(i, jj);
      double *row = history->row(i, jj);
      if (square >= reach * reach) {
        if (touching) memset(row, 0, law_rows::PAIR_SIZE * sizeof(double));
        touching = 0;
        continue;
      }
      touching = 1;
      const bool i_first = atom->tag[i] < atom->tag[j];
      const law_push push = meet(i_first ? i : j, i_first ? j : i, sqrt(square), row);
      // A pair across processors is seen by both of them without newton.
      if (push.normal_force > 0.0) pvector[0] += newton_pair || j < nlocal ? 1.0 : 0.5;
      const double sign = i_first ? 1.0 : -1.0;
      const double *on_i = push.torque[i_first ? 0 : 1], *on_j = push.torque[i_first ? 1 : 0];
      for (int k = 0; k < 3; k++) {
        f[i][k] += sign * push.force[k];
        torque[i][k] += on_i[k];
      }
      if (newton_pair || j < nlocal)
        for (int k = 0; k < 3; k++) {
          f[j][k] -= sign * push.force[k];
          torque[j][k] += on_j[k];
        }
      if (evflag)
        ev_tally_xyz(i, j, nlocal, newton_pair, 0.0, 0.0, sign * push.force[0], sign * push.force[1],
                     sign * push.force[2], del[0], del[1], del[2]);
    }
  }
}
