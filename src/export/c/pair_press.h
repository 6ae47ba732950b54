/* Effective radius of the two bodies, 1/R = 1/R_1 + 1/R_2; radius_2 0: the second body is flat. */
LAW_FUNCTION double law_effective_radius(double radius_1, double radius_2)
{
    return radius_2 > 0.0 ? 1.0 / (1.0 / radius_1 + 1.0 / radius_2) : radius_1;
}

/* A body of the first material against one of the second, overlap > 0 in contact. The law is of both, so one history serves them;
   contact_radius is sqrt(R times overlap), and the flattenings share the overlap as by Hertz, which places the point of contact. */
LAW_FUNCTION law_pressed law_press(double overlap, double radius_1, double radius_2, law_side *side)
{
    law_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}, 0.0};
    double radius = law_effective_radius(radius_1, radius_2), x = overlap / radius, slope;
    if (!(overlap > 0.0))
        return p;
    p.force = radius * radius * law_reduced(x, side, &slope);
    p.stiffness = radius * slope;
    p.contact_radius = radius * sqrt(x);
    p.flattening[0] = LAW_SHARE * overlap;
    p.flattening[1] = overlap - p.flattening[0];
    p.depth = law_depth(overlap, radius, side);
    return p;
}

/* Recoverable energy (J) of the two bodies at an overlap (m) that law_press was last called with. */
LAW_FUNCTION double law_press_elastic_energy(double overlap, double radius_1, double radius_2, const law_side *side)
{
    return law_elastic_energy(overlap, law_effective_radius(radius_1, radius_2), side);
}

/* The history of a contact whose largest overlap over the effective radius was x_max, for codes that keep this one number. */
LAW_FUNCTION law_side law_recall(double x_max)
{
    law_side side = {0.0, 0.0, 0.0, 0.0};
    double slope;
    if (x_max > 0.0)
        law_reduced(x_max, &side, &slope);
    return side;
}
