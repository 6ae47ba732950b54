/* Presses a contact along overlaps and rates read from standard input and prints what the library says of it.
   Arguments: law file, radii (m; second 0: wall). */
#include <stdio.h>
#include <stdlib.h>
#include "impactlaw.h"

int main(int argc, char **argv)
{
    char message[512];
    double radii[2], overlap, rate;
    impactlaw_law *law, *none;
    impactlaw_contact *contact;
    if (argc != 4)
        return 2;
    none = impactlaw_law_read("no such file", message, 12);
    printf("%s|%s\n", none ? "a law" : "no law", message);
    law = impactlaw_law_read(argv[1], message, sizeof message);
    if (!law) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    radii[0] = atof(argv[2]);
    radii[1] = atof(argv[3]);
    printf("%.17g %.17g\n", impactlaw_law_valid_to(law), impactlaw_law_time_step(law, radii[0]));
    contact = impactlaw_contact_new(law);
    impactlaw_law_free(law);
    while (scanf("%lf %lf", &overlap, &rate) == 2) {
        impactlaw_pressed p;
        if (!(overlap > 0.0))
            impactlaw_contact_forget(contact);
        p = impactlaw_contact_press(contact, overlap, radii[0], radii[1], rate);
        printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", p.force, p.stiffness, p.contact_radius, p.flattening[0],
               p.flattening[1], p.elastic_energy);
    }
    impactlaw_contact_free(contact);
    impactlaw_contact_free(NULL);
    impactlaw_law_free(NULL);
    return 0;
}
