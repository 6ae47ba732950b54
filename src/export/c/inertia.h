/* Inertia of a fast first loading, N: what the wall carries beside the force above while the flattening grows at the
   rate v (m/s) for the first time, F_i = R^2 kappa rho v^2 sqrt((delta - delta_1)/R). Call it after law_wall or law_pair,
   with a side's flattening (m), its own rate of flattening (half the rate of approach for two equal bodies) and its
   history; add the result to the force. For two bodies the radius is that of law_side_radius. Leave it out in beds of small relative speeds. */
LAW_FUNCTION double law_inertia(double flattening, double rate, double radius, const law_side *side)
{
    double x = flattening / radius, past = x - LAW_INERTIA_START;
    if (!(rate > 0.0) || x < side->x_max || !(past > 0.0))
        return 0.0;
    return radius * radius * (LAW_INERTIA * LAW_DENSITY * (rate * rate) * sqrt(past));
}
