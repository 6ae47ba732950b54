/* History of one side of a contact; all zero is a virgin contact. x_max is the history proper; the rest follows from it. */
typedef struct {
    double x_max;   /* largest flattening over radius so far */
    double phi_max; /* reduced force F/R^2 at it, Pa */
    double x_res;   /* flattening over radius at which the unloading branch loses contact */
    double n;       /* exponent of that branch; 0: branch not worked out yet */
} law_side;

/* A pressed contact, SI units. */
typedef struct {
    double force;          /* normal force, N, repulsive and never tensile */
    double stiffness;      /* tangent stiffness dF/d(overlap) of the present branch, N/m */
    double contact_radius; /* sqrt(R times flattening of the first body), m */
    double flattening[2];  /* of the first and of the second body, m; their sum is the overlap */
    double depth;          /* overlap since the force was zero on the present branch, m: the overlap on first loading */
} law_pressed;

/* Reset: call it when two bodies, or a body and a wall, no longer overlap (overlap <= 0). A contact whose force is zero
   but whose bodies still overlap (an impression that has sprung back less than it was made) keeps its history. */
LAW_FUNCTION void law_forget(law_side *side)
{
    side->x_max = 0.0;
    side->phi_max = 0.0;
    side->x_res = 0.0;
    side->n = 0.0;
}

/* Flattening (m) of a side pressed by `flattening`, history up to date, since its force was zero on the present branch. */
LAW_FUNCTION double law_depth(double flattening, double radius, const law_side *side)
{
    double past = flattening / radius - side->x_res;
    if (flattening / radius >= side->x_max)
        return flattening;
    return past > 0.0 ? radius * past : 0.0;
}
