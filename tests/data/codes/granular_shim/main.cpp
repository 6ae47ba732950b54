// Impact of two spheres, or of one on a wall (r2 = 0), under the sub-model @NAME@: prints e, F* and delta*.
//     main r1 r2 effective_mass speed dt
#include "gran_sub_mod_@NAME@.h"
#include <cstring>

using namespace LAMMPS_NS;
using namespace Granular_NS;

template<class T> static GranSubModNormal *creator(GranularModel *model, LAMMPS *lmp) { return new T(model, lmp); }

struct Row {
  const char *name;
  GranSubModNormal *(*create)(GranularModel *, LAMMPS *);
  SubModelType type;
};

// The row of the development version, and what the macro of releases makes.
static const Row table[] = {
#include "row.inc"
};
#define GranSubMod_CLASS
#define GranSubModStyle(key, Class, Type) static const Row macro = {#key, &creator<Class>, Type}
#include "gran_sub_mod_@NAME@.h"

int main(int argc, char **argv)
{
  if (argc != 6 || strcmp(table[0].name, macro.name) || table[0].create != macro.create) return 1;
  double history[16] = {0}, coefficient = 0.0, v = atof(argv[4]), f_max = 0.0, delta_max = 0.0;
  const double mass = atof(argv[3]), speed = v, dt = atof(argv[5]);
  LAMMPS lmp;
  // the second atom has the lower number, as happens half of the time
  lmp.atom.tag[0] = 2;
  lmp.atom.tag[1] = 1;
  GranularModel model = {atof(argv[2]) > 0.0 ? PAIR : WALL, 0, 1, 1, history, atof(argv[1]), atof(argv[2]), 0.0};
  GranSubModNormal *law = table[0].create(&model, &lmp);
  law->history_index = 3;
  law->coeffs = &coefficient;
  law->coeffs_to_local();
  double force = 0.0;
  do {
    v -= 0.5 * dt * force / mass;
    model.delta += dt * v;
    force = model.delta > 0.0 ? law->calculate_forces() : 0.0;
    v -= 0.5 * dt * force / mass;
    if (force > f_max) f_max = force;
    if (model.delta > delta_max) delta_max = model.delta;
  } while (model.delta > 0.0);
  printf("%.17g %.17g %.17g\n", -v / speed, f_max, delta_max);
  return law->size_history == 9 && law->nondefault_history_transfer ? 0 : 1;
}
