#ifdef LAW_SELF_TEST
/* Impacts below, integrated with the velocity Verlet method and compared with figures that impactlaw integrated in another
   way (quadrature over the branches). Prints one line an impact; the program returns the number of figures that miss.
       cc -std=c99 -O2 -DLAW_SELF_TEST -x c @FILE@ -lm -o self_test && ./self_test */
#include <stdio.h>

typedef struct {
    double radius_1, radius_2; /* m; radius_2 0: rigid wall */
    double mass, velocity;     /* effective mass, kg; relative speed, m/s */
    double restitution, max_force, max_overlap, residual_overlap, contact_time;
} law_impact;

static const law_impact law_impacts[] = {
LAW_IMPACT_ROWS
};

/* Time (s) and flattening of each body (m) in the first two impacts. */
static const double law_trajectory[][2] = {
LAW_TRAJECTORY_ROWS
};

static double law_deviation(const char *name, double found, double expected, double scale, double allowed, int *misses)
{
    double deviation = fabs(found - expected) / scale;
    int miss = !(deviation <= allowed);
    *misses += miss;
    printf(" %s %.2e%s", name, deviation, miss ? " MISS" : "");
    return deviation;
}

static int law_run_impact(int number)
{
    const law_impact *hit = &law_impacts[number];
    const int steps = 200000; /* of the contact time */
    const double dt = hit->contact_time / steps, sides = @SIDES@;
    law_side side_1, side_2;
    law_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}, 0.0};
    double x = 0.0, v = hit->velocity, @SHARE@most = 0.0, strongest = 0.0, last = 0.0, worst = 0.0;
    size_t next = 0, points = number < @ALIKE@ ? sizeof law_trajectory / sizeof law_trajectory[0] : 0;
    int step, misses = 0;
    law_forget(&side_1);
    law_forget(&side_2);
    for (step = 1; step <= 2 * steps; step++) {
        double x_0 = x, v_0 = v, force = p.force;
        v -= 0.5 * dt / hit->mass * force;
        x += dt * v;
@PRESS@
        v -= 0.5 * dt / hit->mass * p.force;
        if (p.force > strongest)
            strongest = p.force;
        if (x > most)
            most = x;
        while (next < points && law_trajectory[next][0] <= step * dt) { /* cubic within the step */
            double s = law_trajectory[next][0] / dt - (step - 1), r = 1.0 - s;
            double at = r * r * ((1.0 + 2.0 * s) * x_0 + s * dt * v_0) + s * s * ((1.0 + 2.0 * r) * x - r * dt * v);
            double off = fabs(at - law_trajectory[next][1] * sides) / hit->max_overlap;
            if (off > worst)
                worst = off;
            next++;
        }
        if (p.force > 0.0)
            last = step * dt;
        else if (v < 0.0)
            break;
    }
    printf("%s at %g m/s:", hit->radius_2 > 0.0 ? (hit->radius_1 == hit->radius_2 ? "equal spheres" : "unequal spheres")
                                                : "sphere on wall", hit->velocity);
    law_deviation("restitution", -v / hit->velocity, hit->restitution, hit->restitution, 1e-6, &misses);
    law_deviation("max force", strongest, hit->max_force, hit->max_force, 1e-6, &misses);
    law_deviation("max overlap", most, hit->max_overlap, hit->max_overlap, 1e-6, &misses);
    law_deviation("residual overlap", x, hit->residual_overlap, hit->max_overlap, 2e-5, &misses);
    law_deviation("contact time", last, hit->contact_time, hit->contact_time, 2e-5, &misses);
    if (points > 0)
        law_deviation("trajectory", worst, 0.0, 1.0, 1e-6, &misses);
    printf("\n");
    return misses;
}

int main(void)
{
    int number, misses = 0;
    for (number = 0; number < (int)(sizeof law_impacts / sizeof law_impacts[0]); number++)
        misses += law_run_impact(number);
    return misses;
}
#endif
