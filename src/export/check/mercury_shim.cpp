// Stand-in for the kernel of MercuryDPM around an interaction: the members it uses, as the code documents them. It proves
// that the text compiles and computes; it is not MercuryDPM.
// Arguments: radius of P, radius of I (0: wall), mass, relative speed, time step, steps.
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <type_traits>
#include "Species/NormalForceSpecies/@CLASS@NormalSpecies.h"

static_assert(std::is_same<@CLASS@NormalSpecies::InteractionType, @CLASS@Interaction>::value, "species and interaction");

struct Trial : @CLASS@Interaction {
    Trial(BaseInteractable *p, BaseInteractable *i) : BaseInteraction(p, i, 0), @CLASS@Interaction(p, i, 0) {}
    BaseInteraction *copy() const { return new Trial(*this); }
};

int main(int argc, char **argv)
{
    if (argc != 7)
        return 2;
    BaseParticle first, second;
    BaseWall wall;
    first.radius = atof(argv[1]);
    second.radius = atof(argv[2]);
    const double mass = atof(argv[3]), dt = atof(argv[5]);
    BaseInteractable *other = second.radius > 0.0 ? static_cast<BaseInteractable *>(&second) : &wall;
    const int steps = atoi(argv[6]);
    double x = 0.0, v = atof(argv[4]), force = 0.0;
    Trial *trial = new Trial(&first, other);
    for (int step = 1; step <= steps; step++) {
        v -= 0.5 * dt / mass * force;
        x += dt * v;
        if (step == steps - steps / 6) { // a restart in unloading
            std::stringstream file;
            file.precision(17);
            trial->write(file);
            delete trial;
            trial = new Trial(&first, other);
            trial->read(file);
        }
        trial->overlap = x;
        trial->normal = Vec3D(1.0, 0.0, 0.0);
        trial->computeNormalForce();
        force = trial->force.X;
        v -= 0.5 * dt / mass * force;
        printf("%d %.17g %.17g %.17g\n", step, x, v, force);
    }
    delete trial;
    return @CLASS@NormalSpecies().getBaseName() == "@CLASS@" ? 0 : 1;
}
