@HEADER@
/* Granular sub-model `@NAME@` for those who build LAMMPS themselves: the normal law in pair_style granular and fix wall/gran,
 *     pair_coeff * * @NAME@ 0.0 tangential mindlin NULL 1.0 0.5 damping none
 * whose one coefficient goes to the damping model (0.0 with `damping none`; what it means is said there). Copy this file, its
 * .cpp, @NAME@.h into src/GRANULAR and build. Releases up to July 2025 find the class by the macro below; the development
 * version wants an #include of this file and this row in gran_sub_mod_register.cpp:
 *     { "@NAME@", &creator<GranSubModNormal@CLASS@>, NORMAL },
 * Not run inside LAMMPS here: compiled and run against a shim of its interface. The plugin beside it is run inside LAMMPS.
 */
#ifdef GranSubMod_CLASS
// clang-format off
GranSubModStyle(@NAME@,GranSubModNormal@CLASS@,NORMAL);
// clang-format on
#else

#ifndef LMP_GRAN_SUB_MOD_LAW_H
#define LMP_GRAN_SUB_MOD_LAW_H

#include "gran_sub_mod_normal.h"

namespace LAMMPS_NS {
namespace Granular_NS {

  class GranSubModNormal@CLASS@ : public GranSubModNormal {
   public:
    GranSubModNormal@CLASS@(class GranularModel *, class LAMMPS *);
    void coeffs_to_local() override;
    double calculate_forces() override;
  };

}
}

#endif
#endif
