@HEADER@
// What LAMMPS reads when it loads the library: the styles of the law `@NAME@`; see law_lammps.h.
#include "law_lammps.h"

using namespace LAMMPS_NS;

extern "C" {

// The record LAMMPS expects (its header lammpsplugin.h, which the wheel leaves out).
typedef void *(pair_creator)(void *);
typedef void *(fix_creator)(void *, int, char **);
typedef struct {
  const char *version, *style, *name, *info, *author;
  union {
    pair_creator *v1;
    fix_creator *v2;
  } creator;
  void *handle;
} plugin_record;
typedef void (*plugin_registrar)(plugin_record *, void *);

void lammpsplugin_init(void *lmp, void *handle, void *registrar);
}

namespace {

void *new_pair(void *lmp) { return new Pair@CLASS@((LAMMPS *) lmp); }
void *new_history(void *lmp, int narg, char **arg) { return new Fix@CLASS@History((LAMMPS *) lmp, narg, arg); }
void *new_wall(void *lmp, int narg, char **arg) { return new Fix@CLASS@Wall((LAMMPS *) lmp, narg, arg); }

}

void lammpsplugin_init(void *lmp, void *handle, void *registrar)
{
  const plugin_registrar add = (plugin_registrar) registrar;
  plugin_record record;
  record.version = LAMMPS_RELEASE;
  record.author = "impactlaw";
  record.handle = handle;

  record.style = "pair";
  record.name = "@NAME@";
  record.info = "elastic-plastic contact law @NAME@";
  record.creator.v1 = &new_pair;
  add(&record, lmp);

  record.style = "fix";
  record.name = "@NAME@/history";
  record.info = "histories of the contacts of pair style @NAME@";
  record.creator.v2 = &new_history;
  add(&record, lmp);

  record.name = "@NAME@/wall";
  record.info = "plane walls under the contact law @NAME@";
  record.creator.v2 = &new_wall;
  add(&record, lmp);
}
