/* Presses a contact of the two bodies of a pair along overlaps read from standard input and prints what the exported law says. First
   line: radii (m; second 0: flat); then one overlap (m) a line, history forgotten at 0. */
#include <stdio.h>
#include "@FILE@"

int main(void)
{
    double radii[2], overlap, energy;
    law_side side;
    law_forget(&side);
    if (scanf("%lf %lf", &radii[0], &radii[1]) != 2)
        return 2;
    while (scanf("%lf", &overlap) == 1) {
        law_pressed p;
        if (!(overlap > 0.0))
            law_forget(&side);
        p = law_press(overlap, radii[0], radii[1], &side);
        energy = overlap > 0.0 ? law_press_elastic_energy(overlap, radii[0], radii[1], &side) : 0.0;
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", p.force, p.stiffness, p.contact_radius, p.flattening[0],
               p.flattening[1], p.depth, energy);
    }
    return 0;
}
