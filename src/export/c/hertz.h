/* Reduced force F/R^2 (Pa) of one side at flattening x = delta/R, and its slope; elastic: the history plays no part. */
LAW_FUNCTION double law_reduced(double x, law_side *side, double *slope)
{
    double root = x > 0.0 ? sqrt(x) : 0.0;
    (void)side;
    *slope = 1.5 * LAW_PREFACTOR * root;
    return x > 0.0 ? LAW_PREFACTOR * x * root : 0.0;
}

/* Recoverable energy (J) of one body on a wall at a flattening (m). */
LAW_FUNCTION double law_elastic_energy(double flattening, double radius, const law_side *side)
{
    law_side branch = *side;
    double x = flattening / radius, slope;
    return 0.4 * (radius * radius * radius) * law_reduced(x, &branch, &slope) * (x > 0.0 ? x : 0.0);
}
