/* A body of the given radius on a rigid surface, overlap > 0 in contact. All flattening is the body's. */
LAW_FUNCTION law_pressed law_wall(double overlap, double radius, law_side *side)
{
    law_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}};
    double x = overlap / radius, slope;
    if (!(overlap > 0.0))
        return p;
    p.force = radius * radius * law_reduced(x, side, &slope);
    p.stiffness = radius * slope;
    p.contact_radius = radius * sqrt(x);
    p.flattening[0] = overlap;
    return p;
}

/* Two bodies of this material: two flattenings in series, delta_1 + delta_2 = overlap, F_1 = F_2, each side with its own
   history. Equal radii take half the overlap each, exactly. Otherwise the balance is found by Newton's method kept in a
   bracket; *share is the first body's part of the overlap, kept as the start of the next search (0: none yet). */
LAW_FUNCTION law_pressed law_pair(double overlap, double radius_1, double radius_2, law_side *side_1, law_side *side_2,
                                  double *share)
{
    law_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}};
    law_side trial_1, trial_2;
    double low = 0.0, high = overlap, first, force_1, force_2, slope_1, slope_2, excess, newton, next, both;
    int search;
    if (!(overlap > 0.0))
        return p;
    if (radius_1 == radius_2) {
        p = law_wall(0.5 * overlap, radius_1, side_1);
        p.stiffness *= 0.5;
        p.flattening[1] = p.flattening[0];
        *side_2 = *side_1;
        *share = 0.5;
        return p;
    }
    first = *share > 0.0 ? *share * overlap : 0.5 * overlap;
    for (search = 0;; search++) {
        trial_1 = *side_1;
        trial_2 = *side_2;
        force_1 = radius_1 * radius_1 * law_reduced(first / radius_1, &trial_1, &slope_1);
        force_2 = radius_2 * radius_2 * law_reduced((overlap - first) / radius_2, &trial_2, &slope_2);
        both = radius_1 * slope_1 + radius_2 * slope_2;
        excess = force_1 - force_2;
        if (search == 64 || fabs(excess) <= 1e-14 * fmax(force_1, force_2))
            break;
        if (excess > 0.0)
            high = first;
        else
            low = first;
        newton = first - excess / both;
        next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (next == first)
            break;
        first = next;
    }
    *side_1 = trial_1;
    *side_2 = trial_2;
    *share = first / overlap;
    p.force = 0.5 * (force_1 + force_2);
    p.stiffness = both > 0.0 ? radius_1 * slope_1 * (radius_2 * slope_2) / both : 0.0;
    p.contact_radius = radius_1 * sqrt(first / radius_1);
    p.flattening[0] = first;
    p.flattening[1] = overlap - first;
    return p;
}
