@HEADER@
/* Styles of the law `@NAME@` for LAMMPS, loaded into a released program:  plugin load ./law_lammps.so
 *
 *   pair_style @NAME@ [friction MU] [rolling MU_R] [restitution E]      pair_coeff * *
 *       compute ID all pair @NAME@: c_ID[1] is the number of pairs that carry force; pairs that have flattened and carry none
 *       still overlap, so that compute contact/atom counts more
 *   fix ID GROUP @NAME@/wall PLANES [velocity PLANE VX VY VZ] [friction MU] [rolling MU_R] [restitution E]
 *       PLANES: any of  xlo X  xhi X  ylo Y  yhi Y  zlo Z  zhi Z ; the grains are on the inner side
 *       f_ID[k][1..3]: force on plane k in the order given; f_ID[k][4]: its position
 *       fix_modify ID velocity PLANE VX VY VZ   changes the motion and keeps what the contacts remember
 *
 * Units si, atom_style sphere, comm_modify vel yes; newton on or off. One material: that of the law. Effects that are
 * not named do not exist. What contacts remember goes with the grains from processor to processor and through restart
 * files (give pair_style and the wall fixes again, with the same IDs, after read_restart).
 */
#ifndef LAW_LAMMPS_H
#define LAW_LAMMPS_H

#include <string>
#include <vector>
#include "fix.h"
#include "pair.h"
#include "law_contact.h"

namespace LAMMPS_NS {

// What a contact remembers, as a row of numbers: law of both sides, share, tangential spring, rolling spring, dashpot.
namespace law_rows {
enum { SIDE_1 = 0, SIDE_2 = 4, SHARE = 8, SPRING = 9, ROLLER = 13, DASHPOT = 17, PAIR_SIZE = 19 };

inline law_side side(const double *h) { return {h[0], h[1], h[2], h[3]}; }
inline law_slider slider(const double *h) { return {{h[0], h[1], h[2]}, h[3]}; }
inline law_dashpot dashpot(const double *h) { return {h[0], h[1]}; }
inline void keep(double *h, const law_dashpot &d) { h[0] = d.others; h[1] = d.touched; }
inline void keep(double *h, const law_side &s) { h[0] = s.x_max; h[1] = s.phi_max; h[2] = s.x_res; h[3] = s.n; }
inline void keep(double *h, const law_slider &s) { h[0] = s.load[0]; h[1] = s.load[1]; h[2] = s.load[2]; h[3] = s.stiffness; }

// Reads `friction`, `rolling` or `restitution` and its value at arg[iarg] into `effects`; how many words that took.
int effect(LAMMPS *lmp, const char *style, int iarg, int narg, char **arg, law_effects &effects);
}

// Histories of pairs, between two lists of neighbours kept with the grains: both of a pair hold a copy under the number of
// the other one.
class Fix@CLASS@History : public Fix {
 public:
  Fix@CLASS@History(class LAMMPS *, int, char **);
  ~Fix@CLASS@History() override;
  int setmask() override;
  void pre_exchange() override;
  void min_pre_exchange() override { pre_exchange(); }
  void post_neighbor() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void min_post_neighbor() override { post_neighbor(); }
  void post_run() override { pre_exchange(); }
  void write_restart(FILE *) override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  int pack_reverse_comm_size(int, int) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

  class Pair *pair;

  // Row of the jj-th neighbour of atom i in the present list, and whether the two overlap.
  double *row(int i, int jj) { return &rows[(first[i] + jj) * (size_t) law_rows::PAIR_SIZE]; }
  char &touching(int i, int jj) { return touches[first[i] + jj]; }

 private:
  struct Partner {
    tagint tag;
    double history[law_rows::PAIR_SIZE];
  };
  std::vector<std::vector<Partner>> partners;
  std::vector<size_t> first;
  std::vector<double> rows;
  std::vector<char> touches;
  int listed;

  int pack(const std::vector<Partner> &, double *) const;
  int unpack(std::vector<Partner> &, const double *) const;
};

class Pair@CLASS@ : public Pair {
 public:
  Pair@CLASS@(class LAMMPS *);
  ~Pair@CLASS@() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;

 private:
  law_effects effects;
  double largest;
  Fix@CLASS@History *history;

  law_push meet(int first, int second, double distance, double *row) const;
};

class Fix@CLASS@Wall : public Fix {
 public:
  Fix@CLASS@Wall(class LAMMPS *, int, char **);
  ~Fix@CLASS@Wall() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_array(int, int) override;
  int modify_param(int, char **) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 private:
  enum { SIDE = 0, SPRING = 4, ROLLER = 8, DASHPOT = 12, SIZE = 14 };
  struct Plane {
    std::string name;
    int axis;
    double inward;         // +1: the grains are above the plane along its axis, -1: below
    double start;          // position at step `since`
    double velocity[3];
    bigint since;
    double force[3];       // on the plane, of this processor's grains
  };
  law_effects effects;
  std::vector<Plane> planes;
  std::vector<double> rows;    // SIZE numbers a plane, for each grain
  double sums[4];
  int summed_plane;
  bigint summed_step;

  double position(const Plane &) const;
  int velocity(int iarg, int narg, char **arg);
  void press(int grain, Plane &, double *row);
  size_t width() const { return planes.size() * (size_t) SIZE; }
};

}

#endif
