/* What a contact of the two materials remembers; all zero is a virgin contact. */
typedef struct {
    first_side first;
    second_side second;
    double share; /* part of the overlap the first body took last; 0: none yet */
} law_sides;

/* Contact moduli E* = E/(1 - nu^2) of the materials, Pa. */
#define LAW_MODULUS_1 @MODULUS_1@
#define LAW_MODULUS_2 @MODULUS_2@
/* Relative mismatch of the two forces at which the search for the share ends; what is left of it enters the force squared. */
#define LAW_MISMATCH 1e-9
/* Newton step over the overlap at which it ends where one side carries nothing: the bodies have lost contact. */
#define LAW_SLIGHT 1e-13
/* Most steps of the search: in each the mismatch or the bracket is halved. */
#define LAW_MOST_STEPS 128

/* Reset: call it when the bodies no longer overlap (overlap <= 0). */
FIRST_FUNCTION void law_forget(law_sides *sides)
{
    first_forget(&sides->first);
    second_forget(&sides->second);
    sides->share = 0.0;
}

/* Radii of the spheres that flatten on a plane as the bodies do on each other: R_e (1 + E*_i/E*_j), 1/R_e = 1/R_1 + 1/R_2.
   radius_2 0: a flat surface of the second material. */
FIRST_FUNCTION void law_side_radii(double radius_1, double radius_2, double *radii)
{
    double effective = radius_2 > 0.0 ? 1.0 / (1.0 / radius_1 + 1.0 / radius_2) : radius_1;
    radii[0] = effective * (1.0 + LAW_MODULUS_1 / LAW_MODULUS_2);
    radii[1] = effective * (1.0 + LAW_MODULUS_2 / LAW_MODULUS_1);
}

/* Force (N) and stiffness (N/m) of each side where the first takes `taken` of the overlap; nothing is remembered. */
FIRST_FUNCTION void law_trial(double taken, double overlap, const double *radii, const law_sides *sides, double *force,
                              double *stiffness)
{
    first_side first = sides->first;
    second_side second = sides->second;
    force[0] = radii[0] * radii[0] * first_reduced(taken / radii[0], &first, &stiffness[0]);
    force[1] = radii[1] * radii[1] * second_reduced((overlap - taken) / radii[1], &second, &stiffness[1]);
    stiffness[0] *= radii[0];
    stiffness[1] *= radii[1];
}

/* What the first side takes of the overlap when both carry one force: Newton from the share of before, kept inside a
   bracket that bisection can finish; with force and stiffness of both sides there. */
FIRST_FUNCTION double law_balance(double overlap, const double *radii, const law_sides *sides, double *force,
                                  double *stiffness)
{
    /* a virgin contact begins with Hertz's share */
    double share = sides->share > 0.0 ? sides->share : 1.0 / (1.0 + LAW_MODULUS_1 / LAW_MODULUS_2);
    double taken = share * overlap, low = 0.0, high = overlap, before = HUGE_VAL;
    int step;
    law_trial(taken, overlap, radii, sides, force, stiffness);
    for (step = 0; step < LAW_MOST_STEPS; step++) {
        double excess = force[0] - force[1], newton, next;
        if (fabs(excess) <= LAW_MISMATCH * (force[0] > force[1] ? force[0] : force[1]))
            break;
        if (excess > 0.0)
            high = taken;
        else
            low = taken;
        newton = excess / (stiffness[0] + stiffness[1]);
        if ((force[0] == 0.0 || force[1] == 0.0) && fabs(newton) <= LAW_SLIGHT * overlap)
            break;
        next = taken - newton;
        /* at a kink Newton can creep on inside the bracket for ever */
        if (!(next > low && next < high) || fabs(excess) > 0.5 * before)
            next = 0.5 * (low + high);
        before = fabs(excess);
        if (next == taken)
            break;
        taken = next;
        law_trial(taken, overlap, radii, sides, force, stiffness);
    }
    return taken;
}

/* A body of the first material against one of the second, overlap > 0 in contact: two flattening laws in series, one force
   through both, their flattenings adding up to the overlap. radius_2 0: a flat surface of the second material. */
FIRST_FUNCTION first_pressed law_press(double overlap, double radius_1, double radius_2, law_sides *sides)
{
    first_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}, 0.0};
    double radii[2], force[2], stiffness[2], both, slope;
    if (!(overlap > 0.0))
        return p;
    law_side_radii(radius_1, radius_2, radii);
    p.flattening[0] = law_balance(overlap, radii, sides, force, stiffness);
    sides->share = p.flattening[0] / overlap;
    p.flattening[0] = sides->share * overlap;
    p.flattening[1] = overlap - p.flattening[0];
    law_trial(p.flattening[0], overlap, radii, sides, force, stiffness);
    first_reduced(p.flattening[0] / radii[0], &sides->first, &slope);
    second_reduced(p.flattening[1] / radii[1], &sides->second, &slope);
    /* force and stiffness to second order in what is left of the mismatch */
    both = stiffness[0] + stiffness[1];
    if (both > 0.0) {
        p.force = (force[0] * stiffness[1] + force[1] * stiffness[0]) / both;
        p.stiffness = stiffness[0] * stiffness[1] / both;
    } else {
        p.force = 0.5 * (force[0] + force[1]);
    }
    p.depth = first_depth(p.flattening[0], radii[0], &sides->first) + second_depth(p.flattening[1], radii[1], &sides->second);
    p.contact_radius = 0.5 * (sqrt(radii[0] * p.flattening[0]) + sqrt(radii[1] * p.flattening[1]));
    return p;
}

/* Recoverable energy (J) of the two bodies at an overlap (m) that law_press was last called with. */
FIRST_FUNCTION double law_elastic_energy(double overlap, double radius_1, double radius_2, const law_sides *sides)
{
    double radii[2], force[2], stiffness[2], taken = sides->share * overlap;
    law_side_radii(radius_1, radius_2, radii);
    law_trial(taken, overlap, radii, sides, force, stiffness);
    if (!(force[0] > 0.0 && force[1] > 0.0)) /* what carries no force holds no energy */
        return 0.0;
    return first_elastic_energy(taken, radii[0], &sides->first) +
           second_elastic_energy(overlap - taken, radii[1], &sides->second);
}
