/* A body of the given radius on a rigid surface, overlap > 0 in contact. All flattening is the body's. */
LAW_FUNCTION law_pressed law_wall(double overlap, double radius, law_side *side)
{
    law_pressed p = {0.0, 0.0, 0.0, {0.0, 0.0}, 0.0};
    double x = overlap / radius, slope;
    if (!(overlap > 0.0))
        return p;
    p.force = radius * radius * law_reduced(x, side, &slope);
    p.stiffness = radius * slope;
    p.contact_radius = radius * sqrt(x);
    p.flattening[0] = overlap;
    p.depth = law_depth(overlap, radius, side);
    return p;
}

/* Radius of the sphere that flattens on a plane as each of two bodies of this material does on the other. */
LAW_FUNCTION double law_side_radius(double radius_1, double radius_2)
{
    return radius_1 == radius_2 ? radius_1 : 2.0 * radius_1 * radius_2 / (radius_1 + radius_2);
}

/* Two bodies of this material: each side takes half the overlap, like a sphere of radius 2 R_1 R_2/(R_1 + R_2) on a plane;
   elastic, that is Hertz's pair for any radii. One history serves both sides, so side_2 is given that of side_1; *share is
   the first body's part of the overlap. (Sides and share stay apart for pairs of two materials.) */
LAW_FUNCTION law_pressed law_pair(double overlap, double radius_1, double radius_2, law_side *side_1, law_side *side_2,
                                  double *share)
{
    law_pressed p = law_wall(0.5 * overlap, law_side_radius(radius_1, radius_2), side_1);
    p.stiffness *= 0.5;
    p.flattening[1] = p.flattening[0];
    p.depth *= 2.0;
    *side_2 = *side_1;
    *share = overlap > 0.0 ? 0.5 : 0.0;
    return p;
}

/* Recoverable energy (J) of two bodies of this material. */
LAW_FUNCTION double law_pair_elastic_energy(double overlap, double radius_1, double radius_2, const law_side *side_1)
{
    return 2.0 * law_elastic_energy(0.5 * overlap, law_side_radius(radius_1, radius_2), side_1);
}

/* The history of a side whose largest flattening over radius was x_max, for codes that keep this one number. */
LAW_FUNCTION law_side law_recall(double x_max)
{
    law_side side = {0.0, 0.0, 0.0, 0.0};
    double slope;
    if (x_max > 0.0)
        law_reduced(x_max, &side, &slope);
    return side;
}
