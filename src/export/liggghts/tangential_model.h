@HEADER@
/* Tangential model `@NAME@` of LIGGGHTS, to go with the normal model of the same name:
 *     pair_style gran model @NAME@ tangential @NAME@
 * Mindlin's spring with Coulomb's limit whose load falls with the stiffness of the contact (see law_contact.h), where
 * LIGGGHTS' own model `history` keeps the stretch. Needs coefficientFriction.
 */
#ifdef TANGENTIAL_MODEL
TANGENTIAL_MODEL(LAW_TANGENTIAL,@NAME@,@ID@)
#else
#ifndef LAW_TANGENTIAL_MODEL_H
#define LAW_TANGENTIAL_MODEL_H
#include <string.h>
#include "atom.h"
#include "contact_models.h"
#include "global_properties.h"
#include "tangential_model_base.h"
#include "update.h"
#include "law_contact.h"

namespace LIGGGHTS {
namespace ContactModels
{
  template<>
  class TangentialModel<LAW_TANGENTIAL> : public TangentialModelBase
  {
  public:
    TangentialModel(LAMMPS *lmp, IContactHistorySetup *hsetup, class ContactModelBase *c) :
      TangentialModelBase(lmp, hsetup, c),
      friction(NULL)
    {
      history_offset = hsetup->add_history_value("loadx", "1"); // on the first grain: turns its sign with the order
      hsetup->add_history_value("loady", "1");
      hsetup->add_history_value("loadz", "1");
      hsetup->add_history_value("loadStiffness", "0");
    }

    void registerSettings(Settings &) {}
    inline void postSettings(IContactHistorySetup *, ContactModelBase *) {}

    void connectToProperties(PropertyRegistry &registry)
    {
      registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
      registry.connect("coeffFrict", friction, "tangential_model @NAME@");
    }

    void surfacesIntersect(const SurfacesIntersectData &sidata, ForceData &i_forces, ForceData &j_forces)
    {
      if (sidata.contact_flags) *sidata.contact_flags |= CONTACT_TANGENTIAL_MODEL;
      double *const history = &sidata.contact_history[history_offset];
      law_slider spring = {{history[0], history[1], history[2]}, history[3]};
      const law_effects effects = {friction[sidata.itype][sidata.jtype], 0.0, 0.0};
      law_meeting m;
      memcpy(m.normal, sidata.en, sizeof m.normal);
      m.mass = sidata.meff;
      m.dt = update->dt;

      // The slip at the point of contact of this law; LIGGGHTS' own lies half the overlap inside a wall.
      const double arms[2] = {sidata.cri, sidata.is_wall ? 0.0 : sidata.crj};
      double middle[3], slip[3];
      m.radii[0] = sidata.radi;
      m.radii[1] = sidata.is_wall ? 0.0 : sidata.radj;
      for (int k = 0; k < 3; k++) {
        m.velocity[k] = sidata.v_i[k] - sidata.v_j[k];
        m.spins[0][k] = sidata.omega_i[k];
        m.spins[1][k] = sidata.is_wall ? 0.0 : sidata.omega_j[k];
      }
      law_middle(&m, arms, middle);
      law_slip(&m, arms, middle, slip);
      law_lay_across(slip, m.normal);
      const double stiffness = sidata.Fn > 0.0 ? sidata.kt : 0.0;
      const double limit = effects.friction * sidata.Fn;
      double pull[3], couple[3];
      law_rub(&effects, &m, middle, slip, stiffness, sidata.Fn, &spring, pull);
      for (int k = 0; k < 3; k++) pull[k] = spring.load[k] - (stiffness > 0.0 ? sidata.gammat * slip[k] : 0.0);
      const double size = law_dot(pull, pull);
      if (size > limit * limit)
        for (int k = 0; k < 3; k++) pull[k] *= limit / sqrt(size);
      law_cross(pull, sidata.en, couple);

      const double share = sidata.is_wall ? sidata.area_ratio : 1.0;
      for (int k = 0; k < 3; k++) {
        i_forces.delta_F[k] += share * pull[k];
        i_forces.delta_torque[k] += share * sidata.cri * couple[k];
        if (sidata.is_wall) continue;
        j_forces.delta_F[k] -= pull[k];
        j_forces.delta_torque[k] += sidata.crj * couple[k];
      }
      if (sidata.computeflag && sidata.shearupdate) {
        memcpy(history, spring.load, sizeof spring.load);
        history[3] = spring.stiffness;
      }
    }

    void surfacesClose(SurfacesCloseData &scdata, ForceData &, ForceData &)
    {
      if (scdata.contact_flags) *scdata.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
      if (scdata.contact_history) memset(&scdata.contact_history[history_offset], 0, 4 * sizeof(double));
    }

    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}

  private:
    double **friction;
    int history_offset;
  };
}
}
#endif
#endif
