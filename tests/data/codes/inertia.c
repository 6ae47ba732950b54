/* A body hits a wall, inertia included: midpoint steps, the largest force among their ends.
   Arguments: radius (m), mass (kg), velocity (m/s), time step (s). Prints restitution, largest force, largest flattening. */
#include <stdio.h>
#include <stdlib.h>
#include "@FILE@"

/* Force at a trial state; the history is that of `side` unless kept. */
static double force(double x, double v, double radius, law_side *side)
{
    double rest = law_wall(x, radius, side).force;
    return rest + law_inertia(x, v, radius, side);
}

int main(int argc, char **argv)
{
    double radius, mass, v_0, dt, x = 0.0, v, most = 0.0, strongest = 0.0;
    law_side side;
    if (argc != 5)
        return 2;
    radius = atof(argv[1]);
    mass = atof(argv[2]);
    v = v_0 = atof(argv[3]);
    dt = atof(argv[4]);
    law_forget(&side);
    do {
        law_side trial = side;
        double f = force(x, v, radius, &trial), middle = x + 0.5 * dt * v, v_middle = v - 0.5 * dt / mass * f;
        if (f > strongest)
            strongest = f;
        f = force(middle, v_middle, radius, &trial);
        x += dt * v_middle;
        v -= dt / mass * f;
        if (x > most)
            most = x;
        law_wall(x, radius, &side);
    } while (v > 0.0 || law_wall(x, radius, &side).force > 0.0);
    printf("%.17g %.17g %.17g\n", -v / v_0, strongest, most);
    return 0;
}
