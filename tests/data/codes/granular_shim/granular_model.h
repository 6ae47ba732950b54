// Shim: the state of one contact as LAMMPS' granular model holds it.
#ifndef SHIM_GRANULAR_MODEL_H
#define SHIM_GRANULAR_MODEL_H
#include <cstdio>
#include <cstdlib>
#define FLERR __FILE__, __LINE__

namespace LAMMPS_NS {

struct Atom {
  int tag[2];
};

struct Error {
  void all(const char *file, int line, const char *text)
  {
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
    exit(1);
  }
};

struct LAMMPS {
  Atom atom;
  Error error;
};

struct Pointers {
  Pointers(LAMMPS *lmp) : atom(&lmp->atom), error(&lmp->error) {}
  Atom *atom;
  Error *error;
};

namespace Granular_NS {
enum SubModelType { NORMAL };
enum ContactType { PAIR, WALL };

struct GranularModel {
  ContactType contact_type;
  int i, j, history_update;
  double *history;
  double radi, radj, delta;
};
}
}
#endif
