@HEADER@
/* Normal model `@NAME@` of LIGGGHTS:  pair_style gran model @NAME@ ...   fix wall/gran model @NAME@ ...
 *
 * Use it beside the tangential models off, no_history, history and `@NAME@` (Mindlin's spring that softens with the
 * contact, as the bed of impactlaw has it) and the rolling models off, cdt, epsd, epsd2, epsd3. Those get from here
 *   kn      secant stiffness F/overlap,
 *   kt      8 G/(2 - nu)/s times the contact radius (s = 1 on a wall, 2 between grains),
 *   gammat  viscous coefficient of the tangential spring.
 * Settings:  damping on|off (off)   viscous part with the restitution of coefficientRestitution
 *            tangential_damping on|off (on)   the same on the tangential spring
 * History:   per side x_max, phi_max, x_res, n of the law (see @NAME@.h), sides in the order of the grains' numbers; forgotten
 *            when the undeformed spheres part. Then what the damping has learned: others, touched.
 */
#ifdef NORMAL_MODEL
NORMAL_MODEL(LAW_NORMAL,@NAME@,@ID@)
#else
#ifndef LAW_NORMAL_MODEL_H
#define LAW_NORMAL_MODEL_H
#include <string.h>
#include "atom.h"
#include "comm.h"
#include "contact_models.h"
#include "global_properties.h"
#include "neighbor.h"
#include "normal_model_base.h"
#include "update.h"
#include "law_contact.h"

namespace LIGGGHTS {
namespace ContactModels
{
  template<>
  class NormalModel<LAW_NORMAL> : public NormalModelBase
  {
  public:
    NormalModel(LAMMPS *lmp, IContactHistorySetup *hsetup, class ContactModelBase *c) :
      NormalModelBase(lmp, hsetup, c),
      beta(NULL),
      last_beta(0.0),
      last_ratio(0.0),
      damping(false),
      tangential_damping(true)
    {
      // The numbers of the law are kept between steps: largest flattening, its force, residual, exponent. None of them
      // has a sign that turns with the order of the grains.
      history_offset = hsetup->add_history_value("xMax1", "0");
      hsetup->add_history_value("phiMax1", "0");
      hsetup->add_history_value("xRes1", "0");
      hsetup->add_history_value("exponent1", "0");
      if (!c->is_wall()) {
        hsetup->add_history_value("xMax2", "0");
        hsetup->add_history_value("phiMax2", "0");
        hsetup->add_history_value("xRes2", "0");
        hsetup->add_history_value("exponent2", "0");
        hsetup->add_history_value("share", "0");
      }
      hsetup->add_history_value("others", "0");
      hsetup->add_history_value("touched", "0");
      history_size = c->is_wall() ? 6 : 11;
    }

    void registerSettings(Settings &settings)
    {
      settings.registerOnOff("damping", damping, false);
      settings.registerOnOff("tangential_damping", tangential_damping, true);
    }

    inline void postSettings(IContactHistorySetup *, ContactModelBase *) {}

    void connectToProperties(PropertyRegistry &registry)
    {
      if (strcmp(update->unit_style, "si") != 0)
        error->all(FLERR, "model @NAME@ is a law in SI units: use 'units si'");
      if (force->cg_active())
        error->cg(FLERR, "model @NAME@");
      if (damping) {
        registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff, "model @NAME@");
        registry.connect("betaeff", beta, "model @NAME@");
      }
      // Pairs that have just parted are visited once more only within this factor; without it they would remember.
      neighbor->register_contact_dist_factor(1.01);
    }

    inline double stressStrainExponent() { return 1.5; }

    void surfacesIntersect(SurfacesIntersectData &sidata, ForceData &i_forces, ForceData &j_forces)
    {
      if (sidata.contact_flags) *sidata.contact_flags |= CONTACT_NORMAL_MODEL;
      const law_pressed p = press(sidata);
      law_effects effects = {0.0, 0.0, 0.0};
      if (damping) effects.damping = ratio(beta[sidata.itype][sidata.jtype]);
      double *const kept = &sidata.contact_history[history_offset + history_size - 2];
      law_dashpot dashpot = {kept[0], kept[1]};
      const double Fn = law_damped(&effects, &p, approach(sidata, p), sidata.meff, update->dt, &dashpot);
      if (sidata.computeflag && sidata.shearupdate) {
        kept[0] = dashpot.others;
        kept[1] = dashpot.touched;
      }

      // Lever arms to the point of contact; a wall does not flatten.
      sidata.cri = sidata.radi - p.flattening[0];
      if (!sidata.is_wall) sidata.crj = sidata.radj - p.flattening[1];
      sidata.Fn = Fn;
      sidata.kn = p.force / sidata.deltan;
      sidata.kt = law_shear(&p, p.force, sidata.is_wall);
      sidata.gamman = p.force > 0.0 ? law_viscosity(effects.damping, &p, sidata.meff) : 0.0;
      sidata.gammat = tangential_damping ? law_rubbing_viscosity(effects.damping, sidata.kt, sidata.meff) : 0.0;

      const double share = sidata.is_wall ? sidata.area_ratio : 1.0;
      for (int k = 0; k < 3; k++) {
        i_forces.delta_F[k] += share * Fn * sidata.en[k];
        if (!sidata.is_wall) j_forces.delta_F[k] -= Fn * sidata.en[k];
      }
    }

    void surfacesClose(SurfacesCloseData &scdata, ForceData &, ForceData &)
    {
      if (scdata.contact_flags) *scdata.contact_flags &= ~CONTACT_NORMAL_MODEL;
      if (scdata.contact_history)
        memset(&scdata.contact_history[history_offset], 0, history_size * sizeof(double));
    }

    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}

  private:
    // The damping ratio of a pair of types: LIGGGHTS tells beta = ln e/sqrt(pi^2 + ln^2 e); solved for where it changes.
    double ratio(double beta)
    {
      if (beta != last_beta) {
        last_beta = beta;
        last_ratio = law_damping_ratio(exp(M_PI * beta / sqrt(1.0 - beta * beta)));
      }
      return last_ratio;
    }

    // Rate of approach along the normal of the velocities' time.
    double approach(const SurfacesIntersectData &sidata, const law_pressed &p) const
    {
      const double arms[2] = {sidata.radi - p.flattening[0], sidata.is_wall ? 0.0 : sidata.radj - p.flattening[1]};
      law_meeting m;
      double middle[3];
      for (int k = 0; k < 3; k++) {
        m.normal[k] = sidata.en[k];
        m.velocity[k] = sidata.v_i[k] - sidata.v_j[k];
      }
      m.radii[0] = sidata.radi;
      m.radii[1] = sidata.is_wall ? 0.0 : sidata.radj;
      m.dt = update->dt;
      law_middle(&m, arms, middle);
      return law_approach(&m, middle);
    }

    double **beta;
    double last_beta, last_ratio;
    bool damping, tangential_damping;
    int history_offset, history_size;

    // The pressed law; the history is kept where LIGGGHTS says that this evaluation counts.
    law_pressed press(const SurfacesIntersectData &sidata) const
    {
      double kept[11];
      double *const history = &sidata.contact_history[history_offset];
      memcpy(kept, history, history_size * sizeof(double));
      law_pressed p;
      if (sidata.is_wall) {
        law_side side = {kept[0], kept[1], kept[2], kept[3]};
        p = law_wall(sidata.deltan, sidata.radi, &side);
        store(side, kept);
      } else {
        const bool swapped = atom->tag[sidata.i] > atom->tag[sidata.j];
        law_side first = {kept[0], kept[1], kept[2], kept[3]}, second = {kept[4], kept[5], kept[6], kept[7]};
        p = law_pair(sidata.deltan, swapped ? sidata.radj : sidata.radi, swapped ? sidata.radi : sidata.radj,
                        &first, &second, &kept[8]);
        store(first, kept);
        store(second, kept + 4);
        if (swapped) {
          const double flattening = p.flattening[0];
          p.flattening[0] = p.flattening[1];
          p.flattening[1] = flattening;
        }
      }
      if (sidata.computeflag && sidata.shearupdate) memcpy(history, kept, history_size * sizeof(double));
      return p;
    }

    static void store(const law_side &side, double *kept)
    {
      kept[0] = side.x_max;
      kept[1] = side.phi_max;
      kept[2] = side.x_res;
      kept[3] = side.n;
    }
  };
}
}
#endif
#endif
