/* Constants of the unloading branch that leaves the loading curve at side->x_max; worked out when unloading begins:
   rho = x_res/x_max = 1 - (1 + (w_max - w_1)/c)^(-k),  n = 1.5 + n_1 rho + n_2 (x_max - x_1),
   c LAW_RESIDUAL_SCALE, k LAW_RESIDUAL_POWER, n_1 LAW_EXPONENT_RESIDUAL, n_2 LAW_EXPONENT_STRAIN. */
LAW_FUNCTION void law_unload(law_side *side)
{
    double past = side->x_max / LAW_YIELD_FLATTENING - LAW_DEPARTURE, rho;
    if (past < 0.0)
        past = 0.0;
    rho = 1.0 - pow(1.0 + past / LAW_RESIDUAL_SCALE, -LAW_RESIDUAL_POWER);
    side->x_res = rho * side->x_max;
    side->n = 1.5 + LAW_EXPONENT_RESIDUAL * rho + LAW_EXPONENT_STRAIN * (past * LAW_YIELD_FLATTENING);
}

/* Reduced force F/R^2 (Pa) of one side at flattening x = delta/R, and its slope; updates the history.
   x >= x_max: loading curve. Below: phi_max ((x - x_res)/(x_max - x_res))^n, 0 up to x_res; reloading goes back up the
   same branch. A function of x and x_max alone: it does not depend on the steps taken. */
LAW_FUNCTION double law_reduced(double x, law_side *side, double *slope)
{
    double past, inverse_span, z, secant;
    if (x >= side->x_max) {
        double f;
        if (!(x > 0.0)) {
            *slope = 0.0;
            return 0.0;
        }
        f = law_loading(x / LAW_YIELD_FLATTENING, slope);
        *slope *= LAW_YIELD_FORCE / LAW_YIELD_FLATTENING;
        if (x > side->x_max) {
            side->x_max = x;
            side->phi_max = LAW_YIELD_FORCE * f;
            side->x_res = 0.0;
            side->n = 0.0;
        }
        return side->phi_max;
    }
    if (side->n == 0.0)
        law_unload(side);
    past = x - side->x_res;
    if (past <= 0.0) {
        *slope = 0.0;
        return 0.0;
    }
    inverse_span = 1.0 / (side->x_max - side->x_res);
    z = past * inverse_span;
    /* not yet yielded: Hertz, x_res = 0 and n = 3/2 */
    secant = side->phi_max * inverse_span * (side->n == 1.5 ? sqrt(z) : pow(z, side->n - 1.0));
    *slope = secant * side->n;
    return secant * past;
}

/* Recoverable energy (J) of one body on a wall at a flattening (m): the area under its unloading branch. */
LAW_FUNCTION double law_elastic_energy(double flattening, double radius, const law_side *side)
{
    law_side branch = *side;
    double x = flattening / radius, slope, phi = law_reduced(x, &branch, &slope);
    if (!(phi > 0.0))
        return 0.0;
    if (branch.n == 0.0)
        law_unload(&branch);
    return radius * radius * radius * (phi * (x - branch.x_res) / (branch.n + 1.0));
}
