@HEADER@
// Histories of pairs that follow the grains; see law_lammps.h.
#include "law_lammps.h"

#include <cstring>
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "neigh_list.h"

using namespace LAMMPS_NS;
using namespace FixConst;

Fix@CLASS@History::Fix@CLASS@History(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), pair(nullptr), listed(0)
{
  restart_peratom = 1;
  restart_global = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 1;
  comm_reverse = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

Fix@CLASS@History::~Fix@CLASS@History()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int Fix@CLASS@History::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_RUN;
}

// From the rows of the present list to the grains, before they may change their processor.
void Fix@CLASS@History::pre_exchange()
{
  NeighList *list = pair ? pair->list : nullptr;
  if (!list || first.empty()) return;
  const tagint *tag = atom->tag;
  const bool newton = force->newton_pair;
  const int all = atom->nlocal + atom->nghost;
  if ((int) partners.size() < all) partners.resize(all);
  for (auto &of_one : partners) of_one.clear();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      if (!touching(i, jj)) continue;
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      Partner partner;
      memcpy(partner.history, row(i, jj), sizeof partner.history);
      partner.tag = tag[j];
      partners[i].push_back(partner);
      // Without newton the owner of a ghost has this pair in its own list; with it, it must be told.
      if (j >= listed && !newton) continue;
      partner.tag = tag[i];
      partners[j].push_back(partner);
    }
  }
  if (newton) comm->reverse_comm_variable(this);
  size_t most = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (partners[i].size() > most) most = partners[i].size();
  maxexchange = (int) most * (law_rows::PAIR_SIZE + 1) + 1;
}

// From the grains to the rows of the new list.
void Fix@CLASS@History::post_neighbor()
{
  NeighList *list = pair->list;
  const tagint *tag = atom->tag;
  listed = atom->nlocal;
  first.assign(atom->nmax, 0);
  size_t total = 0;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    first[i] = total;
    total += list->numneigh[i];
  }
  rows.assign(total * law_rows::PAIR_SIZE, 0.0);
  touches.assign(total, 0);
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    if (partners[i].empty()) continue;
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const tagint other = tag[list->firstneigh[i][jj] & NEIGHMASK];
      for (const Partner &partner : partners[i]) {
        if (partner.tag != other) continue;
        memcpy(row(i, jj), partner.history, sizeof partner.history);
        touching(i, jj) = 1;
        break;
      }
    }
  }
}

void Fix@CLASS@History::write_restart(FILE *file)
{
  pre_exchange();
  if (comm->me == 0) {
    const int size = 0;
    fwrite(&size, sizeof(int), 1, file);
  }
}

double Fix@CLASS@History::memory_usage()
{
  double bytes = rows.capacity() * sizeof(double) + touches.capacity() + first.capacity() * sizeof(size_t);
  for (const auto &of_one : partners) bytes += sizeof of_one + of_one.capacity() * sizeof(Partner);
  return bytes;
}

void Fix@CLASS@History::grow_arrays(int nmax)
{
  if ((int) partners.size() < nmax) partners.resize(nmax);
}

void Fix@CLASS@History::copy_arrays(int i, int j, int)
{
  partners[j] = partners[i];
}

void Fix@CLASS@History::set_arrays(int i)
{
  partners[i].clear();
}

int Fix@CLASS@History::pack(const std::vector<Partner> &of_one, double *buf) const
{
  int m = 0;
  buf[m++] = (double) of_one.size();
  for (const Partner &partner : of_one) {
    buf[m++] = ubuf(partner.tag).d;
    memcpy(buf + m, partner.history, sizeof partner.history);
    m += law_rows::PAIR_SIZE;
  }
  return m;
}

int Fix@CLASS@History::unpack(std::vector<Partner> &of_one, const double *buf) const
{
  int m = 0;
  const int count = (int) buf[m++];
  for (int k = 0; k < count; k++) {
    Partner partner;
    partner.tag = (tagint) ubuf(buf[m++]).i;
    memcpy(partner.history, buf + m, sizeof partner.history);
    m += law_rows::PAIR_SIZE;
    of_one.push_back(partner);
  }
  return m;
}

int Fix@CLASS@History::pack_exchange(int i, double *buf)
{
  return pack(partners[i], buf);
}

int Fix@CLASS@History::unpack_exchange(int i, double *buf)
{
  partners[i].clear();
  return unpack(partners[i], buf);
}

int Fix@CLASS@History::pack_restart(int i, double *buf)
{
  const int m = pack(partners[i], buf + 1) + 1;
  buf[0] = m;
  return m;
}

void Fix@CLASS@History::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; k++) m += (int) extra[m];
  partners[i].clear();
  unpack(partners[i], extra + m + 1);
}

int Fix@CLASS@History::size_restart(int i)
{
  return (int) partners[i].size() * (law_rows::PAIR_SIZE + 1) + 2;
}

int Fix@CLASS@History::maxsize_restart()
{
  int most = 0, most_of_all;
  for (int i = 0; i < atom->nlocal; i++)
    if ((int) partners[i].size() > most) most = (int) partners[i].size();
  MPI_Allreduce(&most, &most_of_all, 1, MPI_INT, MPI_MAX, world);
  return most_of_all * (law_rows::PAIR_SIZE + 1) + 2;
}

int Fix@CLASS@History::pack_reverse_comm_size(int n, int first_ghost)
{
  int m = 0;
  for (int i = first_ghost; i < first_ghost + n; i++) m += 1 + (int) partners[i].size() * (law_rows::PAIR_SIZE + 1);
  return m;
}

int Fix@CLASS@History::pack_reverse_comm(int n, int first_ghost, double *buf)
{
  int m = 0;
  for (int i = first_ghost; i < first_ghost + n; i++) m += pack(partners[i], buf + m);
  return m;
}

void Fix@CLASS@History::unpack_reverse_comm(int n, int *atoms, double *buf)
{
  int m = 0;
  for (int k = 0; k < n; k++) m += unpack(partners[atoms[k]], buf + m);
}
