// Shim of what a normal sub-model of LAMMPS' GRANULAR package sees, written from its interface: names, not code.
#ifndef SHIM_GRAN_SUB_MOD_NORMAL_H
#define SHIM_GRAN_SUB_MOD_NORMAL_H
#include "granular_model.h"

namespace LAMMPS_NS {
namespace Granular_NS {

class GranSubMod : protected Pointers {
 public:
  GranSubMod(GranularModel *model, LAMMPS *lmp) : Pointers(lmp), gm(model) {}
  virtual ~GranSubMod() { delete[] transfer_history_factor; }
  virtual void coeffs_to_local() {}
  int num_coeffs = 0;
  double *coeffs = nullptr;
  int size_history = 0, nondefault_history_transfer = 0, history_index = 0, contact_radius_flag = 0;
  double *transfer_history_factor = nullptr;
  GranularModel *gm;
};

class GranSubModNormal : public GranSubMod {
 public:
  GranSubModNormal(GranularModel *model, LAMMPS *lmp) : GranSubMod(model, lmp) {}
  virtual double calculate_forces() = 0;
  double damp = 0.0, Emod = 0.0, poiss = 0.0;
  int material_properties = 0, cohesive_flag = 0;
};

}
}
#endif
