@HEADER@
// Fix `@NAME@/wall`: plane walls, fixed or moving; see law_lammps.h.
#include "law_lammps.h"

#include <cstring>
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"
#include "utils.h"

using namespace LAMMPS_NS;
using namespace FixConst;

Fix@CLASS@Wall::Fix@CLASS@Wall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), effects{0.0, 0.0, 0.0}, sums{0.0, 0.0, 0.0, 0.0}, summed_plane(-1), summed_step(-1)
{
  static const char *const names[6] = {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};
  int iarg = 3;
  while (iarg < narg) {
    int taken = law_rows::effect(lmp, "fix @NAME@/wall", iarg, narg, arg, effects);
    for (int k = 0; k < 6 && !taken; k++) {
      if (strcmp(arg[iarg], names[k]) != 0) continue;
      if (iarg + 2 > narg) error->all(FLERR, "fix @NAME@/wall: {} needs a position", arg[iarg]);
      const double at = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      planes.push_back({names[k], k / 2, k % 2 ? -1.0 : 1.0, at, {0.0, 0.0, 0.0}, update->ntimestep, {0.0, 0.0, 0.0}});
      taken = 2;
    }
    if (!taken && strcmp(arg[iarg], "velocity") == 0) taken = velocity(iarg, narg, arg);
    if (!taken)
      error->all(FLERR, "fix @NAME@/wall: found {}, allowed are xlo, xhi, ylo, yhi, zlo, zhi, velocity, friction, "
                 "rolling, restitution", arg[iarg]);
    iarg += taken;
  }
  if (planes.empty()) error->all(FLERR, "fix @NAME@/wall needs at least one plane, e.g. zlo 0.0");
  array_flag = 1;
  size_array_rows = (int) planes.size();
  size_array_cols = 4;
  global_freq = 1;
  extarray = 0;
  restart_peratom = 1;
  restart_global = 1;
  create_attribute = 1;
  maxexchange = (int) width();
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

Fix@CLASS@Wall::~Fix@CLASS@Wall()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int Fix@CLASS@Wall::setmask()
{
  return POST_FORCE;
}

void Fix@CLASS@Wall::init()
{
  if (strcmp(update->unit_style, "si") != 0) error->all(FLERR, "fix @NAME@/wall is a law in SI units: use 'units si'");
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "fix @NAME@/wall needs grains with radius, mass and spin: atom_style sphere");
}

void Fix@CLASS@Wall::setup(int vflag)
{
  post_force(vflag);
}

// Reads `velocity PLANE VX VY VZ` at arg[iarg]: from now on the plane moves so.
int Fix@CLASS@Wall::velocity(int iarg, int narg, char **arg)
{
  if (iarg + 5 > narg) error->all(FLERR, "fix @NAME@/wall: velocity needs a plane and three components");
  for (Plane &plane : planes) {
    if (plane.name != arg[iarg + 1]) continue;
    plane.start = position(plane);
    plane.since = update->ntimestep;
    for (int k = 0; k < 3; k++) plane.velocity[k] = utils::numeric(FLERR, arg[iarg + 2 + k], false, lmp);
    return 5;
  }
  error->all(FLERR, "fix @NAME@/wall: velocity of {}, which is not one of its planes", arg[iarg + 1]);
  return 0;
}

int Fix@CLASS@Wall::modify_param(int narg, char **arg)
{
  return strcmp(arg[0], "velocity") == 0 ? velocity(0, narg, arg) : 0;
}

double Fix@CLASS@Wall::position(const Plane &plane) const
{
  return plane.start + plane.velocity[plane.axis] * update->dt * (double) (update->ntimestep - plane.since);
}

// One grain that overlaps a plane.
void Fix@CLASS@Wall::press(int i, Plane &plane, double *row)
{
  law_meeting m;
  for (int k = 0; k < 3; k++) {
    m.normal[k] = k == plane.axis ? plane.inward : 0.0;
    m.velocity[k] = atom->v[i][k] - plane.velocity[k];
    m.spins[0][k] = atom->omega[i][k];
    m.spins[1][k] = 0.0;
  }
  m.radii[0] = atom->radius[i];
  m.radii[1] = 0.0;
  m.mass = atom->rmass[i];
  m.dt = update->dt;
  law_side side = law_rows::side(row + SIDE);
  law_dashpot dashpot = law_rows::dashpot(row + DASHPOT);
  law_slider spring = law_rows::slider(row + SPRING), roller = law_rows::slider(row + ROLLER);
  const double overlap = m.radii[0] - plane.inward * (atom->x[i][plane.axis] - position(plane));
  const law_pressed p = law_wall(overlap, m.radii[0], &side);
  const law_push push = law_meet(&effects, &m, &p, &dashpot, &spring, &roller);
  for (int k = 0; k < 3; k++) {
    atom->f[i][k] += push.force[k];
    atom->torque[i][k] += push.torque[0][k];
    plane.force[k] -= push.force[k];
  }
  if (update->setupflag) return;
  law_rows::keep(row + SIDE, side);
  law_rows::keep(row + SPRING, spring);
  law_rows::keep(row + ROLLER, roller);
  law_rows::keep(row + DASHPOT, dashpot);
}

void Fix@CLASS@Wall::post_force(int)
{
  summed_plane = -1;
  for (size_t k = 0; k < planes.size(); k++) {
    Plane &plane = planes[k];
    const double at = position(plane);
    plane.force[0] = plane.force[1] = plane.force[2] = 0.0;
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      double *row = &rows[i * width() + k * SIZE];
      if (plane.inward * (atom->x[i][plane.axis] - at) < atom->radius[i])
        press(i, plane, row);
      else if (row[DASHPOT + 1] > 0.0)
        memset(row, 0, SIZE * sizeof(double));
    }
  }
}

double Fix@CLASS@Wall::compute_array(int plane, int column)
{
  if (column == 3) return position(planes[plane]);
  if (summed_plane != plane || summed_step != update->ntimestep) {
    MPI_Allreduce(planes[plane].force, sums, 3, MPI_DOUBLE, MPI_SUM, world);
    summed_plane = plane;
    summed_step = update->ntimestep;
  }
  return sums[column];
}

void Fix@CLASS@Wall::write_restart(FILE *file)
{
  if (comm->me != 0) return;
  std::vector<double> positions;
  for (const Plane &plane : planes) positions.push_back(position(plane));
  const int size = (int) (positions.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, file);
  fwrite(positions.data(), sizeof(double), positions.size(), file);
}

void Fix@CLASS@Wall::restart(char *buf)
{
  const double *positions = (const double *) buf;
  for (size_t k = 0; k < planes.size(); k++) planes[k].start = positions[k];
}

double Fix@CLASS@Wall::memory_usage()
{
  return (double) (rows.capacity() * sizeof(double));
}

void Fix@CLASS@Wall::grow_arrays(int nmax)
{
  rows.resize(nmax * width(), 0.0);
}

void Fix@CLASS@Wall::copy_arrays(int i, int j, int)
{
  memcpy(&rows[j * width()], &rows[i * width()], width() * sizeof(double));
}

void Fix@CLASS@Wall::set_arrays(int i)
{
  memset(&rows[i * width()], 0, width() * sizeof(double));
}

int Fix@CLASS@Wall::pack_exchange(int i, double *buf)
{
  memcpy(buf, &rows[i * width()], width() * sizeof(double));
  return (int) width();
}

int Fix@CLASS@Wall::unpack_exchange(int i, double *buf)
{
  memcpy(&rows[i * width()], buf, width() * sizeof(double));
  return (int) width();
}

int Fix@CLASS@Wall::pack_restart(int i, double *buf)
{
  buf[0] = (double) (width() + 1);
  memcpy(buf + 1, &rows[i * width()], width() * sizeof(double));
  return (int) width() + 1;
}

void Fix@CLASS@Wall::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; k++) m += (int) extra[m];
  memcpy(&rows[i * width()], extra + m + 1, width() * sizeof(double));
}

int Fix@CLASS@Wall::size_restart(int)
{
  return (int) width() + 1;
}

int Fix@CLASS@Wall::maxsize_restart()
{
  return (int) width() + 1;
}
