/* Presses a contact of two materials along overlaps read from standard input and prints what the exported laws say. First
   line: radii (m; second 0: a flat surface of the second material); then one overlap (m) a line, history forgotten at 0. */
#include <stdio.h>
#include "law.h"

int main(void)
{
    double radii[2], overlap, energy;
    law_sides sides;
    law_forget(&sides);
    if (scanf("%lf %lf", &radii[0], &radii[1]) != 2)
        return 2;
    while (scanf("%lf", &overlap) == 1) {
        first_pressed p;
        if (!(overlap > 0.0))
            law_forget(&sides);
        p = law_press(overlap, radii[0], radii[1], &sides);
        energy = overlap > 0.0 ? law_elastic_energy(overlap, radii[0], radii[1], &sides) : 0.0;
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", p.force, p.stiffness, p.contact_radius, p.flattening[0],
               p.flattening[1], p.depth, energy);
    }
    return 0;
}
