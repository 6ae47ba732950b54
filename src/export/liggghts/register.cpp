@HEADER@
/* Registration of the normal and the tangential model `@NAME@` in a LIGGGHTS that is already built: the library made of
 * this file puts them into LIGGGHTS' tables when it is loaded (LD_PRELOAD). See build.sh.
 */
// LIGGGHTS 3.8.0: a header read below names a class whose own header it leaves to others.
#include "fix_insert_stream.h"

#include "granular_styles.h"
#include <stdlib.h>

namespace {

using namespace LAMMPS_NS;
using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;

template<class Type> PairStyles::IGranularPairStyle *new_pair(LAMMPS *lmp, PairGran *parent, const int64_t hash)
{
  return new Type(lmp, parent, hash);
}

template<class Type> Walls::IGranularWall *new_wall(LAMMPS *lmp, FixWallGran *parent, const int64_t hash)
{
  return new Type(lmp, parent, hash);
}

template<int T, int R> void combination()
{
  typedef GranStyle<LAW_NORMAL, T, COHESION_OFF, R, SURFACE_DEFAULT> Style;
  typedef ContactModel<Style> Model;
  PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, &new_pair<PairStyles::Granular<Model> >);
  Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &new_wall<Walls::Granular<Model> >);
}

template<int T> void with_rolling_springs()
{
  combination<T, ROLLING_OFF>();
  combination<T, ROLLING_CDT>();
  combination<T, ROLLING_EPSD>();
  combination<T, ROLLING_EPSD2>();
  combination<T, ROLLING_EPSD3>();
}

struct Registration {
  Registration()
  {
    // Programs that LIGGGHTS starts (MPI's daemons) must not load this library: they know nothing of its tables.
    unsetenv("LD_PRELOAD");
    ContactModels::Factory::instance().addNormalModel("@NAME@", LAW_NORMAL);
    ContactModels::Factory::instance().addTangentialModel("@NAME@", LAW_TANGENTIAL);
    combination<TANGENTIAL_OFF, ROLLING_OFF>();
    combination<TANGENTIAL_NO_HISTORY, ROLLING_OFF>();
    combination<TANGENTIAL_NO_HISTORY, ROLLING_CDT>();
    with_rolling_springs<TANGENTIAL_HISTORY>();
    with_rolling_springs<LAW_TANGENTIAL>();
  }
} registration;

}
