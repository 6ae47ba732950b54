/* Presses a contact along overlaps read from standard input and prints what the exported law says; with an argument it
   times that many passes of the first body on a wall instead: seconds of all of them and a sum. First line: radii (m;
   second 0: wall); then one overlap (m) a line, history forgotten at 0. */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "@FILE@"

static law_pressed press(double overlap, const double *radii, law_side *sides, double *share)
{
    if (!(overlap > 0.0)) {
        law_forget(&sides[0]);
        law_forget(&sides[1]);
        *share = 0.0;
    }
    return radii[1] > 0.0 ? law_pair(overlap, radii[0], radii[1], &sides[0], &sides[1], share)
                          : law_wall(overlap, radii[0], &sides[0]);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Sum of force and stiffness along a path of a body on a wall: a loop to be timed, in which both are worked out. */
static double passed(double radius, const double *overlaps, int count)
{
    law_side side;
    double sum = 0.0;
    int i;
    law_forget(&side);
    for (i = 0; i < count; i++) {
        if (!(overlaps[i] > 0.0)) {
            law_forget(&side);
        } else {
            law_pressed p = law_wall(overlaps[i], radius, &side);
            sum += p.force + p.stiffness;
        }
    }
    return sum;
}

int main(int argc, char **argv)
{
    static double overlaps[1 << 20];
    double radii[2], share = 0.0, sum = 0.0, start;
    law_side sides[2];
    int count = 0, i, round, rounds = argc > 1 ? atoi(argv[1]) : 0;
    law_forget(&sides[0]);
    law_forget(&sides[1]);
    if (scanf("%lf %lf", &radii[0], &radii[1]) != 2)
        return 2;
    while (count < (1 << 20) && scanf("%lf", &overlaps[count]) == 1)
        count++;
    for (i = 0; rounds == 0 && i < count; i++) {
        law_pressed p = press(overlaps[i], radii, sides, &share);
        double energy = radii[1] > 0.0 ? law_pair_elastic_energy(overlaps[i], radii[0], radii[1], &sides[0])
                                       : law_elastic_energy(overlaps[i], radii[0], &sides[0]);
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", p.force, p.stiffness, p.contact_radius, p.flattening[0],
               p.flattening[1], p.depth, energy);
    }
    start = seconds();
    for (round = 0; round < rounds; round++)
        sum += passed(radii[0], overlaps, count);
    if (rounds > 0)
        printf("%.17g %.17g\n", seconds() - start, sum);
    return 0;
}
